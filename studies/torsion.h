// The torsion sweep: a torque at the tip of spatial case S1, the paper's Table 3 and Figure 9.
#pragma once

#include "studies/study.h"

namespace studies {

void torsion(const StudyOptions& options);

}  // namespace studies
