// Stability maps: where each method is right, where it says that it is not, and where it is wrong and silent.
#pragma once

#include "studies/study.h"

namespace studies {

void stability(const StudyOptions& options);

}  // namespace studies
