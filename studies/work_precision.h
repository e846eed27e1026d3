// Error over time of every method at every resolution: who reaches which accuracy first.
#pragma once

#include "studies/study.h"

namespace studies {

void work_precision(const StudyOptions& options);

}  // namespace studies
