// What every method returns.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace scene {

// Pose of a section frame S in the base frame B.
struct Pose {
  Eigen::Matrix3d rotation_BS = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position_B_mm = Eigen::Vector3d::Zero();
};

struct Station {
  double s_mm = 0;
  Pose X_BS;
};

enum class Status {
  converged,
  unsupported,          // the method cannot solve this kind of load or section; the message names it
  arc_not_converged,    // FAM: the angle of an arc, or its series, was not found (fam/solve.h)
  tolerance_not_met,    // the error estimate exceeds the tolerance at the largest number of arcs
  load_step_too_small,  // the load step was halved below 1e-6 of the load
  not_converged,        // an iteration ended above its tolerance; the message gives both
  not_finite            // a pose or a wrench is NaN or infinite
};

// The status as the JSON output spells it.
const char* name(Status status);

// A fact about the model that was used, for the reader of a result ("arcs" = 12).
using Fact = std::pair<std::string, std::variant<bool, int, double, std::string>>;

// Static equilibrium of a scene. Only a converged one has a shape: otherwise `stations` is empty.
struct Equilibrium {
  Status status = Status::not_converged;
  std::string message;            // one line, why not converged; empty when converged
  std::vector<Station> stations;  // clamp to tip; the last one is the tip
  double tip_angle_rad = 0;       // total rotation from clamp to tip, followed along the rod: two turns are 4 pi
  Eigen::Vector3d base_force_B_N = Eigen::Vector3d::Zero();     // internal force at the clamp
  Eigen::Vector3d base_moment_B_Nmm = Eigen::Vector3d::Zero();  // internal moment at the clamp
  double error_estimate_mm = 0;                                 // of the tip's position
  std::optional<bool> stable;                                   // empty: not decided
  std::vector<Fact> model;

  bool converged() const { return status == Status::converged; }
  const Pose& tip() const { return stations.back().X_BS; }
};

// Total rotation angle at the last station: the rotation vector is followed from station to station on its nearest
// branch, so that full turns count. Consecutive stations must be less than half a turn apart.
double total_angle_rad(const std::vector<Station>& stations);

}  // namespace scene
