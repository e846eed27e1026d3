// Tells by the determinants of the tangent along the load whether a step has left the branch of equilibria.
#pragma once

#include "fem_reference/beam_system.h"

namespace fem_reference {

class BranchWatch {
 public:
  // Whether the determinant has changed its sign since the last load.
  bool has_left(const Determinant& now) const;

  // The load at which the line through the last two determinants meets zero; infinite if ahead it does not. Beyond it
  // the sign may be the old one again, where two branches part or two roots lie together.
  double load_of_zero() const;

  // The branch goes on here.
  void keep(double load_factor, const Determinant& now);

 private:
  struct Point {
    double load_factor = 0;
    Determinant determinant;
  };
  Point last_, before_;
  int points_ = 0;
};

}  // namespace fem_reference
