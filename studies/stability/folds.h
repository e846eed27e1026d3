// How far behind a force that turns past the axis of a rod its answer stays: where two answers are stable.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace studies {

// Of a clamped rod, a fixed tip force turned from across it (90 degrees) against it and on, by paths: the angle at
// which the answer that it had stops being stable, and at which it folds.
struct FoldPoint {
  double load = 0;                                   // |F| L^2/EI
  std::optional<double> round_deg;                   // lost, of a round rod
  std::optional<double> strip_deg, strip_exact_deg;  // lost, of one 1000 times stiffer out of its plane
  std::optional<double> fold_deg;                    // of either, in the plane
};
std::vector<FoldPoint> fold_curves();

std::map<std::string, std::string> fold_files(const std::vector<FoldPoint>& points);

}  // namespace studies
