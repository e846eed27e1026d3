// What Study I solved, and how to look things up in it.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/scenes/cases.h"

#include <Eigen/Core>

#include <string>
#include <utility>
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

// The competitor that stands for the paper: published law, 12 arcs, bend then twist.
inline const std::string fam12 = "fam_published_12";

// The pairs (a, b) whose difference a - b is recorded.
const std::vector<std::pair<std::string, std::string>>& study1_pairs();

// The tip of a case that the method solved, and the difference of two methods, or null.
const Study1Tip* tip(const Study1Data& data, const std::string& load_case, const std::string& frame,
                     const std::string& method);
const Study1Difference* difference(const Study1Data& data, const std::string& load_case, const std::string& frame,
                                   const std::string& a, const std::string& b);

// The record of a list that `matches`, or null.
template <class Record, class Predicate>
const Record* find(const std::vector<Record>& records, Predicate&& matches) {
  for (const Record& record : records) {
    if (matches(record)) return &record;
  }
  return nullptr;
}

}  // namespace studies
