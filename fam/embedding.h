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

template <int D>
SectionPose in_base(const BasicPose<D>& pose, const Matrix3d& rotation_BP) {
  Matrix3d rotation = Matrix3d::Identity();
  rotation.topLeftCorner<D, D>() = pose.rotation_BS;
  return {rotation_BP * rotation * rotation_BP.transpose(), rotation_BP * embedded(pose.position_B_mm)};
}

}  // namespace fam
