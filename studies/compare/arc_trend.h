// What the paper prints of its error over the number of arcs, asked of a curve of errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace studies {

// NaN is left out. No values are printed but the 3 mm; "near 12" is taken as 8 to 30, "rises" as twice the error of
// 500 arcs at 5000.
struct Trend {
  int minimum_arcs = 0;
  double minimum_mm = 0, at_12_mm = 0, at_500_mm = 0, at_5000_mm = 0, largest_12_to_500_mm = 0;

  bool minimum_near_12() const { return minimum_arcs >= 8 && minimum_arcs <= 30; }
  bool rises() const { return at_5000_mm > 2 * at_500_mm; }
  bool under_3_mm() const { return largest_12_to_500_mm < 3; }
};

struct ArcError {
  int arcs;
  double error_mm;
};

inline Trend trend(const std::vector<ArcError>& curve) {
  Trend result;
  result.minimum_mm = INFINITY;
  for (const auto& [arcs, value] : curve) {
    if (value < result.minimum_mm) result.minimum_mm = value, result.minimum_arcs = arcs;
    if (arcs >= 12 && arcs <= 500) result.largest_12_to_500_mm = std::max(result.largest_12_to_500_mm, value);
    if (arcs == 12) result.at_12_mm = value;
    if (arcs == 500) result.at_500_mm = value;
    if (arcs == 5000) result.at_5000_mm = value;
  }
  return result;
}

}  // namespace studies
