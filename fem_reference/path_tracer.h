// Follows one branch of a path step by step, and finds its folds, its branch points and the places that are asked for.
//
// A step is accepted when Newton's iteration converges, no node turns far, the tangent turns little, the corrector
// lands near where the tangent pointed, and at most one thing happens in it:
//   fold: the parameter turns back, the determinant and the index change by one;
//   branch point: the determinant and the index change by one, the parameter goes on;
//   double branch point of a round rod on its axis: the index changes by two (without an energy: the determinant of
//   motions in a plane changes its sign).
// Otherwise it is halved; what still happens together in a step of `together` is one point.
// Inverse interpolation finds the zero of the tangent's parameter part at a fold, of the determinant at a branch point
// (its root where double). A sign change without a zero is a jump to another branch, and the step is halved.
#pragma once

#include "fem_reference/path_system.h"
#include "scene/path.h"

#include <functional>
#include <string>
#include <vector>

namespace fem_reference {

struct Landmark {
  PathState state;
  scene::PathPoint::Kind kind = scene::PathPoint::Kind::regular;
  int multiplicity = 0;
  std::optional<double> target;  // the parameter asked for that this point has
};

class PathTracer {
 public:
  // largest_step: of the parameter.
  PathTracer(PathSystem& system, PathState start, double first_step, double largest_step);

  // The points of the next step in their order, its end the last. Empty: no step goes on from here.
  std::optional<std::vector<Landmark>> next(const std::vector<double>& targets);

  const PathState& last() const { return last_; }
  const std::string& failure() const { return failure_; }

 private:
  struct Event {
    scene::PathPoint::Kind kind = scene::PathPoint::Kind::regular;
    int multiplicity = 0;
    bool is_one = true;  // nothing else happens
  };
  struct Place {
    double length = 0;  // from the step's start along its tangent
    PathState state;
  };
  using Function = std::function<double(const PathState&)>;

  double longest_step() const;
  bool is_short_enough(const PathState& next);
  Event event(const PathState& next) const;
  Function event_function(const Event& event, const PathState& next) const;
  std::optional<Place> zero(const Function& function, const Place& from, const Place& to, double apart);
  static Place interpolated(const std::vector<Place>& places, double length);
  std::optional<Landmark> landmark(const Event& event, const PathState& next, double& length);
  bool add_targets(const Place& from, const Place& to, const std::vector<double>& targets,
                   std::vector<Landmark>& landmarks);
  std::optional<Landmark> at_target(double target, const Place& from, const Place& to);
  bool refused(const std::string& why);

  PathSystem& system_;
  PathState last_;
  double step_, largest_step_;
  double rotation_rad_ = 0, surprise_rad_ = 0;  // of the step tried last
  std::string failure_;
};

}  // namespace fem_reference
