#include "scene/equilibrium.h"

#include "scene/span.h"

#include <Eigen/Geometry>

#include <cmath>

namespace scene {

const char* name(Status status) {
  switch (status) {
    case Status::converged: return "converged";
    case Status::unsupported: return "unsupported";
    case Status::arc_not_converged: return "arc_not_converged";
    case Status::tolerance_not_met: return "tolerance_not_met";
    case Status::load_step_too_small: return "load_step_too_small";
    case Status::not_converged: return "not_converged";
    case Status::work_limit: return "work_limit";
    case Status::limit_point: return "limit_point";
    case Status::tendon_collapsed: return "tendon_collapsed";
    case Status::not_finite: return "not_finite";
  }
  return "unknown";
}

double tip_angle_rad(const std::vector<Station>& stations, const std::optional<Eigen::Vector3d>& plane_normal_B) {
  if (!plane_normal_B) return Eigen::AngleAxisd(stations.back().X_BS.rotation_BS).angle();
  double angle = 0;
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const Eigen::Matrix3d step = stations[i - 1].X_BS.rotation_BS.transpose() * stations[i].X_BS.rotation_BS;
    // The normal is the same in base and section frames. sin and cos of the turn about it.
    const Eigen::Vector3d axis = moment_of_arms<double>(step) / 2;
    angle += std::atan2(axis.dot(*plane_normal_B), (step.trace() - 1) / 2);
  }
  return std::abs(angle);
}

}  // namespace scene
