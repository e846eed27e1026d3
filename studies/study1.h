// Study I of the paper: 8 planar and 8 spatial load cases, the finite arc method beside finite elements.
#pragma once

#include "studies/study.h"

namespace studies {

void study1(const StudyOptions& options);

}  // namespace studies
