// Finite rotations as quaternions p = (w, x, y, z), first component real. A quaternion that is not of unit length
// stands for the rotation of p / |p|, so that sums of quaternions are rotations too.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace fem_reference {

using Quaternion = Eigen::Vector4d;

// Matrix of the cross product: skew(a) b = a x b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

inline Quaternion conjugate(const Quaternion& p) {
  return {p[0], -p[1], -p[2], -p[3]};
}

inline Quaternion product(const Quaternion& a, const Quaternion& b) {
  const Eigen::Vector3d x = a.tail<3>(), y = b.tail<3>();
  Quaternion result;
  result[0] = a[0] * b[0] - x.dot(y);
  result.tail<3>() = a[0] * y + b[0] * x + x.cross(y);
  return result;
}

// Unit quaternion of a rotation vector in rad; the half angle is not reduced, so that a full turn gives -1.
inline Quaternion exponential(const Eigen::Vector3d& rotation_rad) {
  const double half = 0.5 * rotation_rad.norm();
  const double sinc = half < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  Quaternion q;
  q[0] = std::cos(half);
  q.tail<3>() = 0.5 * sinc * rotation_rad;
  return q;
}

// Rotation vector in rad, on the branch that is continuous from the identity quaternion (+1): |.| up to 2 pi.
inline Eigen::Vector3d logarithm(const Quaternion& q) {
  const double sine = q.tail<3>().norm();
  const double factor = sine < 1e-8 ? 2.0 : 2.0 * std::atan2(sine, q[0]) / sine;
  return factor * q.tail<3>();
}

// R(p) a: components of a turned from the section frame to the base frame.
inline Eigen::Vector3d rotated(const Quaternion& p, const Eigen::Vector3d& a) {
  const double w = p[0];
  const Eigen::Vector3d x = p.tail<3>();
  return ((w * w - x.squaredNorm()) * a + 2 * x.dot(a) * x + 2 * w * x.cross(a)) / p.squaredNorm();
}

inline Eigen::Matrix3d rotation_matrix(const Quaternion& p) {
  Eigen::Matrix3d R;
  for (int column = 0; column < 3; ++column) R.col(column) = rotated(p, Eigen::Vector3d::Unit(column));
  return R;
}

}  // namespace fem_reference
