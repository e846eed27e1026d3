// What Study I solves, and how to look things up in it.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/methods/registry.h"
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
  double length_mm = 0;
  std::vector<Study1Tip> tips;
  std::vector<Study1Difference> differences;
  std::vector<Study1Shape> shapes;
  std::vector<Study1Time> times;
};

// A competitor: its key in the CSV files, and how it is made.
struct Study1Method {
  std::string key, row;
  Request request;
};

// Methods, and the pairs (a, b) whose difference a - b is recorded. The CSV files hold one group after the other.
struct Study1Group {
  std::vector<Study1Method> methods;
  std::vector<std::pair<std::string, std::string>> pairs;
};
const std::vector<Study1Group>& study1_groups();
const Study1Method& study1_method(const std::string& key);
std::string study1_label(const std::string& key);  // as pages write it

// The competitor that stands for the paper, published law, 12 arcs, bend then twist; and our best of as many arcs.
inline const std::string fam12 = "fam_published_12", fam12_twist_first = fam12 + "_twist_bend",
                         sixth12 = "fam_sixth_order_12_reissner";

// The tip of a case that the method solved, and the difference of two methods, or null.
const Study1Tip* tip(const Study1Data& data, const std::string& load_case, const std::string& frame,
                     const std::string& method);
const Study1Difference* difference(const Study1Data& data, const std::string& load_case, const std::string& frame,
                                   const std::string& a, const std::string& b);

// Tip distances of a and b over the cases that both solved, mm.
std::vector<double> distances_mm(const Study1Data& data, const std::vector<std::string>& cases,
                                 const std::string& frame, const std::string& a, const std::string& b);
// Tip differences along each axis of a set (planar: x, y; spatial: x, y, z), follower loads, all in one list, mm.
std::vector<double> differences_mm(const Study1Data& data, bool planar, const std::string& a, const std::string& b);

// Medians of a method over the cases of a frame that it solved, µs.
std::vector<double> times_us(const Study1Data& data, const std::string& frame, const std::string& method);

}  // namespace studies
