#include "fem_reference/branch_watch.h"

#include <cmath>
#include <limits>

namespace fem_reference {

bool BranchWatch::has_left(const Determinant& now) const {
  return points_ > 0 && now.negative != last_.determinant.negative;
}

double BranchWatch::load_of_zero() const {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (points_ < 2 || before_.determinant.negative != last_.determinant.negative) return never;
  const double fall = std::expm1(before_.determinant.log_size - last_.determinant.log_size);
  return fall > 0 ? last_.load_factor + (last_.load_factor - before_.load_factor) / fall : never;
}

void BranchWatch::keep(double load_factor, const Determinant& now) {
  before_ = last_;
  last_ = {load_factor, now};
  ++points_;
}

}  // namespace fem_reference
