// The segmentation sweep: what the number of arcs does to the answer, and why the printed trend is not ours.
#pragma once

#include "studies/study.h"

namespace studies {

void segmentation(const StudyOptions& options);

}  // namespace studies
