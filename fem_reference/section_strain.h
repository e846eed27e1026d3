// Strains of a section from its interpolated quaternion p, and their derivatives by p.
//
// rho = |p|^2, R = R(p). All of them depend on p / |p| only, are unchanged when p is multiplied from the left by a
// unit quaternion (objective: a rigid rotation of the rod leaves them alone), and are linear in r'.
//   v = R^T r'                        (1 + stretch, shear y, shear z), section frame
//   u = 2 Im(conj(p) p') / rho        (torsion, bending y, bending z), section frame: R' = R [u]x
#pragma once

#include "fem_reference/rotation.h"

namespace fem_reference {

using Matrix34 = Eigen::Matrix<double, 3, 4>;

// Derivative of R(p) a by p, for fixed a.
Matrix34 rotated_by_p(const Quaternion& p, const Eigen::Vector3d& a);

// Derivative of R(p)^T a by p, for fixed a.
Matrix34 rotated_back_by_p(const Quaternion& p, const Eigen::Vector3d& a);

// Second derivative by p of a . R(p) b, for fixed a (base frame) and b (section frame).
Eigen::Matrix4d power_by_p_p(const Quaternion& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// u and its first derivatives.
struct Curvature {
  Eigen::Vector3d value;
  Matrix34 by_p;
  Matrix34 by_dp;
};
Curvature curvature(const Quaternion& p, const Quaternion& dp);

// Second derivatives of m . u for a fixed moment m in the section frame; the one by p' and p' is zero.
struct CurvaturePower {
  Eigen::Matrix4d by_p_p;
  Eigen::Matrix4d by_p_dp;
};
CurvaturePower curvature_power(const Quaternion& p, const Quaternion& dp, const Eigen::Vector3d& m);

}  // namespace fem_reference
