// The finite element reference judged by the exact rod: order, locking, own error, load steps.
#pragma once

#include "studies/study.h"

namespace studies {

void fe_verification(const StudyOptions& options);

}  // namespace studies
