// Study `sensing`: one load of unknown place between sensors of curvature, against estimates at fixed places.
#pragma once

#include "studies/report/progress.h"
#include "studies/report/table.h"

#include <filesystem>

namespace studies {

struct PlacedLoads {
  Table table;
  int trials = 0, no_answer = 0, unobservable = 0, not_lowest = 0, far_off = 0;
};

// Where a load passes such a sensor, chi-squared has a corner (of a moment a jump): between two there may be a minimum
// of its own.
PlacedLoads placed_loads(const std::filesystem::path& cases, Progress::Style progress);

}  // namespace studies
