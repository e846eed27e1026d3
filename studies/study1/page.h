// The tables, pictures and page of Study I, as pure functions of what was solved.
#pragma once

#include "studies/study1/data.h"

#include <map>

namespace studies {

// File name to content.
std::map<std::string, std::string> study1_files(const Study1Data& data);

}  // namespace studies
