// The kinds of load that act on a rod.
#pragma once

#include <Eigen/Core>

#include <variant>

namespace scene {

// A force and a moment.
struct Wrench {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nmm = Eigen::Vector3d::Zero();

  bool is_zero() const { return force_N.isZero(0) && moment_Nmm.isZero(0); }
};

// follower: components constant in the section frame S at the load's place, turning with it.
// fixed: components constant in the base frame B (a dead load; a fixed moment keeps its axis).
enum class Frame { follower, fixed };

// Acts at p + R r with r = (0, y, z), (y, z) = offset_mm in the section frame: a contact on the surface, a lever arm.
// So it also brings the moment (R r) x F about the centreline, which turns with the section.
struct Force {
  double at_mm = 0;  // arc length from the clamp
  Frame frame = Frame::follower;
  Eigen::Vector3d value_N = Eigen::Vector3d::Zero();
  Eigen::Vector2d offset_mm = Eigen::Vector2d::Zero();
};

struct Moment {
  double at_mm = 0;
  Frame frame = Frame::follower;
  Eigen::Vector3d value_Nmm = Eigen::Vector3d::Zero();
};

// Force per undeformed length on from_mm <= s <= to_mm.
struct DistributedForce {
  double from_mm = 0;
  double to_mm = 0;
  Frame frame = Frame::follower;
  Eigen::Vector3d value_N_per_mm = Eigen::Vector3d::Zero();
};

// Acts on every section that has a mass; components in the base frame.
struct Gravity {
  Eigen::Vector3d acceleration_m_per_s2 = Eigen::Vector3d::Zero();
};

// Frictionless tendon held in the section at r = (0, y, z), (y, z) = offset_mm, fixed at to_mm and running through the
// clamp with constant tension T. It pulls along its own tangent t = v + u x r (section frame; v, u the rod's strains):
// on 0 <= s <= to_mm the rod's own force and moment are the total's less T t/|t| and r x T t/|t| (Rucker and Webster,
// IEEE T-RO 27(6), 2011). Its energy is T times the length of its path.
struct Tendon {
  Eigen::Vector2d offset_mm = Eigen::Vector2d::Zero();
  double tension_N = 0;
  double to_mm = 0;
};

using Load = std::variant<Force, Moment, DistributedForce, Gravity, Tendon>;

}  // namespace scene
