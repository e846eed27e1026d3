// The tables, pictures and page of Study I, as pure functions of what was solved.
#pragma once

#include "studies/stopwatch.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace studies {

struct Study1Tip {
  std::string load_case, frame, method, status;
  Eigen::Vector3d position_mm;  // base frame; only where the status is "converged"
};

// Method a minus method b.
struct Study1Difference {
  std::string load_case, frame, a, b;
  Eigen::Vector3d tip_mm;
  double shape_largest_mm, shape_rms_mm;
};

struct Study1Shape {
  std::string load_case, frame, method;
  std::vector<Eigen::Vector3d> positions_mm;  // every millimetre from the clamp
};

struct Study1Time {
  std::string load_case, frame, method;
  Timing timing;
};

struct Study1Data {
  std::vector<Study1Tip> tips;
  std::vector<Study1Difference> differences;
  std::vector<Study1Shape> shapes;
  std::vector<Study1Time> times;
};

// P1..P8, S1..S8.
std::vector<std::string> study1_cases();

// The pairs (a, b) whose difference a - b is recorded.
const std::vector<std::pair<std::string, std::string>>& study1_pairs();

// File name to content.
std::map<std::string, std::string> study1_files(const Study1Data& data);

}  // namespace studies
