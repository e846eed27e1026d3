// Published benchmark cases: what others printed, the exact value, finite elements and the finite arc method.
#pragma once

#include "studies/study.h"

namespace studies {

void benchmarks(const StudyOptions& options);

}  // namespace studies
