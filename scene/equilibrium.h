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

// At a point load or a tendon's end the wrench is that of the side towards the clamp, the load included.
struct Station {
  double s_mm = 0;
  Pose X_BS;
  // The rod's own internal force and moment in the base frame: what the distal part exerts on the proximal one, less
  // the tendons' pulls T t/|t| and r x T t/|t|.
  Eigen::Vector3d force_B_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_B_Nmm = Eigen::Vector3d::Zero();
};

enum class Status {
  converged,
  unsupported,          // the method cannot solve this kind of load or section; the message names it
  arc_not_converged,    // FAM: the angle of an arc, or its series, was not found (fam/solve.h)
  tolerance_not_met,    // the error estimate exceeds the tolerance at the largest number of arcs
  load_step_too_small,  // they were halved below the method's smallest, or a fold is foretold
  not_converged,        // an iteration ended above its tolerance; the message gives both
  work_limit,           // the method's bound on load steps, marched arcs or intervals was used up
  limit_point,          // the loads meet a fold on their way, where the rod would snap
  tendon_collapsed,     // a tendon's path has no length somewhere, |v + u x r| = 0: its direction is not defined
  not_finite            // a pose or a wrench is NaN or infinite
};

// The status as the JSON output spells it.
const char* name(Status status);

// A fact about the model that was used, for the reader of a result ("arcs" = 12).
using Fact = std::pair<std::string, std::variant<bool, int, double, std::string>>;

// Where a growing load stops: a share of it, and what is there, as a path's points are called ("fold").
struct Limit {
  double load_factor = 0;
  std::string kind;
};

// Static equilibrium of a scene. Only a converged one has a shape: otherwise `stations` is empty.
struct Equilibrium {
  Status status = Status::not_converged;
  std::string message;            // one line, why not converged; empty when converged
  std::vector<Station> stations;  // clamp to tip; the last one is the tip
  double tip_angle_rad = 0;       // see tip_angle_rad()
  double error_estimate_mm = 0;   // of the position of any station
  std::optional<bool> stable;     // empty: not decided
  // How much of each of the scene's tendons leaves through the clamp: int |e_x + u0 x r| ds - int |v + u x r| ds.
  std::vector<double> tendon_shortening_mm;
  std::vector<Fact> model;
  std::optional<Limit> limit;  // of limit_point, where it was located

  bool converged() const { return status == Status::converged; }
  const Pose& tip() const { return stations.back().X_BS; }
  const Station& base() const { return stations.front(); }
};

// Where a plane's normal is given (of a planar scene, span_facts.h): the size of the turn about it, followed from
// station to station, so that full turns count; consecutive stations must be less than half a turn apart. Else the
// rotation angle of the last station, 0 to pi.
double tip_angle_rad(const std::vector<Station>& stations, const std::optional<Eigen::Vector3d>& plane_normal_B);

}  // namespace scene
