// A rod in the x-y plane P, or in space, as one in space: its vectors, turns and poses in the base frame.
#pragma once

#include "fam/screw.h"

namespace fam {

inline Vector3d embedded(const Vector3d& v) {
  return v;
}
inline Vector3d embedded(const Eigen::Vector2d& v) {
  return {v[0], v[1], 0};
}
inline Vector3d embedded_angular(const Vector3d& v) {
  return v;
}
inline Vector3d embedded_angular(const Angular<double, 2>& turn) {
  return {0, 0, turn[0]};
}

// From the plane's frame; a rod in space is solved in the base frame.
inline Vector3d in_base(const Vector3d& v, const Matrix3d&) {
  return v;
}
inline Vector3d in_base(const Eigen::Vector2d& v, const Matrix3d& rotation_BP) {
  return rotation_BP.leftCols<2>() * v;
}
inline Vector3d angular_in_base(const Vector3d& v, const Matrix3d&) {
  return v;
}
inline Vector3d angular_in_base(const Angular<double, 2>& turn, const Matrix3d& rotation_BP) {
  return rotation_BP.col(2) * turn[0];
}
inline SectionPose in_base(const SectionPose& pose, const Matrix3d&) {
  return pose;
}
inline SectionPose in_base(const BasicPose<2>& pose, const Matrix3d& rotation_BP) {
  Matrix3d rotation = Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = pose.rotation_BS;
  return {rotation_BP * rotation * rotation_BP.transpose(), in_base(pose.position_B_mm, rotation_BP)};
}

}  // namespace fam
