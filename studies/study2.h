// Study II of the paper: a catheter with three lateral contact forces.
#pragma once

#include "studies/study.h"

namespace studies {

void study2(const StudyOptions& options);

}  // namespace studies
