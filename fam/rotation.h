// Rotation matrices and their vectors, in space (3 x 3) and in the plane (2 x 2).
#pragma once

#include "fam/screw.h"

#include <Eigen/Geometry>

namespace fam {

// v with sin(angle) * axis of a rotation matrix; monotone up to a quarter turn.
template <class T>
Angular<T, 3> sine_vector(const Eigen::Matrix<T, 3, 3>& rotation) {
  return T(0.5) *
         Vector3<T>(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0), rotation(1, 0) - rotation(0, 1));
}
template <class T>
Angular<T, 2> sine_vector(const Eigen::Matrix<T, 2, 2>& rotation) {
  return Angular<T, 2>(T(0.5) * (rotation(1, 0) - rotation(0, 1)));
}

// Less than a quarter turn: half a turn has no sine either.
template <int D>
bool is_small(const Eigen::Matrix<double, D, D>& rotation) {
  return rotation.trace() > D - 2;
}

inline Vector3d rotation_vector(const Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}
inline Angular<double, 2> rotation_vector(const Eigen::Matrix2d& rotation) {
  return Angular<double, 2>(std::atan2(rotation(1, 0), rotation(0, 0)));
}

inline Matrix3d rotation_matrix(const Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix() : Matrix3d::Identity();
}
inline Eigen::Matrix2d rotation_matrix(const Angular<double, 2>& turn) {
  return Eigen::Rotation2Dd(turn[0]).toRotationMatrix();
}

// Turns a section by a small rotation given in its own frame: the base axes turn back.
template <class Matrix, class Vector>
Matrix turned(const Matrix& rotation_SB, const Vector& turn_S) {
  return rotation_matrix(turn_S).transpose() * rotation_SB;
}

}  // namespace fam
