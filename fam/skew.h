// The matrix of a cross product.
#pragma once

#include "fam/screw.h"

namespace fam {

// [a]: [a] b = a x b.
inline Matrix3d skew(const Vector3d& a) {
  Matrix3d matrix;
  matrix << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return matrix;
}

}  // namespace fam
