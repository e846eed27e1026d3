#include "scene/branch_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scene {
namespace {

constexpr double share_of_zero = 0.8;  // chosen, not measured

}  // namespace

double log_fall(const Determinant& from, const Determinant& to) {
  const double fall = from.log_size - to.log_size;
  return std::min(fall, fall - (from.log_growth - to.log_growth));
}

bool BranchWatch::has_left(const Determinant& now) const {
  return points_ > 0 && now.negative != last_.determinant.negative;
}

double BranchWatch::longest_step(double from_load_factor) const {
  constexpr double any = std::numeric_limits<double>::infinity();
  if (points_ < 2 || before_.determinant.negative != last_.determinant.negative) return any;
  const double fall =
      std::expm1(log_fall(before_.determinant, last_.determinant)) / (last_.load_factor - before_.load_factor);
  return fall > 0 ? share_of_zero / fall + share_of_zero * (last_.load_factor - from_load_factor) : any;
}

void BranchWatch::keep(double load_factor, const Determinant& now) {
  before_ = last_;
  last_ = {load_factor, now};
  ++points_;
}

}  // namespace scene
