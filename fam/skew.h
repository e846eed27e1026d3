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

// Two directions across a vector and each other; none where it vanishes.
inline Eigen::Matrix<double, 3, 2> two_across(const Vector3d& v) {
  int least;
  v.cwiseAbs().minCoeff(&least);
  Eigen::Matrix<double, 3, 2> result;
  const Vector3d first = Vector3d::Unit(least).cross(v).normalized();
  result << first, v.cross(first).normalized();
  return result;
}

}  // namespace fam
