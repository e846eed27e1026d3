// One branch of a path, from its first point to its end.
#pragma once

#include "exact_reference/critical_points.h"
#include "exact_reference/path.h"

#include <string>
#include <vector>

namespace exact_reference {

// What all branches of a path share.
struct Route {
  double from = 0, to = 1;
  std::vector<double> stop_at;
  double largest_step = 0;
  bool turns = false;  // the parameter is a turn, the same again after a full one

  double scale() const { return std::abs(to - from); }
};

// A branch point and the mesh that it stands on.
struct Parting {
  CriticalPoint point;
  Mesh mesh;
};

// The parameter and the rod's wrench at its clamp: they tell an equilibrium from all others, whatever the mesh.
using Mark = Eigen::Matrix<double, 7, 1>;
Mark mark_of(const Eigen::VectorXd& x);
bool same_equilibrium(const Mark& a, const Mark& b, double parameter_scale);

// Moves of the tip per length along a direction, in the base frame, over the rod's length.
Eigen::Vector3d tip_motion(Continuation& path, const Eigen::VectorXd& x, const Eigen::VectorXd& direction);

class PathWalk {
 public:
  PathWalk(const Route& route, Continuation& path, int branch, scene::Path& result, const PathVisitor& visit)
      : route_(route), path_(path), branch_(branch), result_(result), visit_(visit) {}

  // The continuation stands at a regular first point.
  void from_start();
  void from_parting(const Parting& parting);

  scene::PathStatus status() const { return status_; }
  const std::string& message() const { return message_; }
  const std::vector<Parting>& partings() const { return partings_; }

 private:
  // A place of the step and how to note it.
  struct Place {
    double s = 0;
    Eigen::VectorXd x;
    scene::PathPoint point;
  };
  void walk(double s);
  bool step(double& s);
  bool note_stretch(const Solution& end, double s, const std::vector<CriticalPoint>& critical);
  bool is_back(const Eigen::VectorXd& x) const;
  std::vector<double> whole_turns(double a, double b) const;
  bool note_targets(const Place& a, const Place& b);
  std::optional<Solution> solution_at(double parameter, const Place& a, const Place& b);
  void note(const Place& place);
  bool stop(scene::PathStatus status, const char* why);

  const Route& route_;
  Continuation& path_;
  int branch_;
  scene::Path& result_;
  const PathVisitor& visit_;
  Mark start_ = Mark::Zero();
  int points_ = 0;
  scene::PathStatus status_ = scene::PathStatus::not_started;
  std::string message_;
  std::vector<Parting> partings_;
};

}  // namespace exact_reference
