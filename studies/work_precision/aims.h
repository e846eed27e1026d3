// FAM's kernels and plain shooting at equal error on single scenes, in one run: the project's aims in time.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/study.h"

#include <string>
#include <vector>

namespace studies {

struct AimRow {
  std::string scene;
  double target_mm = 0;  // true tip error, against the exact Kirchhoff rod
  double aim_us = 0;
  std::string method;  // key in the registry
  int resolution = 0;  // the fewest arcs or steps n such that n, n + 1 and 2 n are within the target; 0: none
  double error_mm = 0;
  Timing time;
};

std::vector<AimRow> measured_aims(const StudyOptions& options);

}  // namespace studies
