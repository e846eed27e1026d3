#include "scene/equilibrium.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace scene {

const char* name(Status status) {
  switch (status) {
    case Status::converged: return "converged";
    case Status::unsupported: return "unsupported";
    case Status::arc_not_converged: return "arc_not_converged";
    case Status::tolerance_not_met: return "tolerance_not_met";
    case Status::load_step_too_small: return "load_step_too_small";
    case Status::not_converged: return "not_converged";
    case Status::not_finite: return "not_finite";
  }
  return "unknown";
}

double total_angle_rad(const std::vector<Station>& stations) {
  const double turn = 2 * std::numbers::pi;
  constexpr double no_rotation_rad = 1e-7;  // below it the axis of a rotation matrix is round-off
  Eigen::Vector3d followed = Eigen::Vector3d::Zero();
  for (const Station& station : stations) {
    const Eigen::AngleAxisd rotation(station.X_BS.rotation_BS);
    if (rotation.angle() < no_rotation_rad && followed.norm() > turn / 2) {  // full turns: the axis is the old one
      followed *= turn * std::round(followed.norm() / turn) / followed.norm();
      continue;
    }
    // Of the rotation vectors (angle + 2 pi k) axis, the one nearest to the last.
    const double along_axis = followed.dot(rotation.axis());
    const double turns = std::round((along_axis - rotation.angle()) / turn);
    followed = (rotation.angle() + turns * turn) * rotation.axis();
  }
  return followed.norm();
}

}  // namespace scene
