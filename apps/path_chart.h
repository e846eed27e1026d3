// A path as a picture: the parameter against the tip's displacement, and three of its shapes.
#pragma once

#include "fam/path.h"

#include <string>

namespace apps {

std::string path_chart(const fam::Path& path, const std::string& title, const std::string& parameter);

}  // namespace apps
