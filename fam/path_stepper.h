// Steps along a path: solutions with all that is judged by, on a mesh that follows the rod as it curls.
#pragma once

#include "fam/path_equations.h"
#include "fam/stability.h"

#include <optional>

namespace fam {

using PathChange = PathEquations::Change;

// A solution on a path.
struct PathPlace {
  PathState state;
  PathChange tangent;              // the way that the path goes, of size 1 (PathEquations::inner)
  scene::Determinant determinant;  // PathEquations::Linear
  std::optional<int> index;        // where the loads have an energy
  std::optional<CrossTurn> cross;  // on the axis of a rod that no direction across is told apart of
  bool is_free = false;            // it may turn about its axis at no cost
  Vector3d tip_position_B_mm = Vector3d::Zero();
  PathEquations::Accuracy accuracy;
  double surprise_rad = 0;  // how far Newton's method took it from where it was looked for
  // A branch leaves another one here: what is judged by belongs to that one.
  bool is_fork = false;

  double slope() const { return tangent[tangent.size() - 1]; }
};

// A place as it can be gone on from, also by another path of the same rod.
struct SavedPlace {
  PathMesh mesh;
  PathPlace place;
  scene::Symmetry held = scene::Symmetry::none;
};

class PathStepper {
 public:
  struct Settings {
    double lowest = 0, highest = 1;  // values of the parameter that may be asked for
    double unit = 1;                 // of it
    bool is_watched = false;         // short steps, so as to stay on a branch that only determinants tell
    double critical_tolerance = 1;   // relative, of critical values; or as places have, if that is finer
    bool told_by_parameter = true;   // places are accurate at their parameter, and not only as those of some other
  };
  PathStepper(const scene::PathRequest& request, const Options& options, const Settings& settings);

  // What `fam solve` finds at a parameter, to go on from upwards or downwards. Empty: message() says why.
  std::optional<PathPlace> start(double parameter, bool upwards);
  const std::string& message() const { return message_; }

  double unit() const { return settings_.unit; }
  double parameter(const PathPlace& place) const { return place.state.parameter; }
  double inner(const PathChange& a, const PathChange& b) const { return equations_.inner(a, b); }

  enum class Newton { usual, tight };
  // Along the tangent and half the curvature times the length squared; not judged. Empty: Newton's method did not
  // converge.
  std::optional<PathPlace> step(const PathPlace& from, double length, const PathChange& curvature,
                                Newton newton = Newton::usual);
  // Tells index, accuracy and tip of the place found last. False: its shape is not finite.
  bool judge(PathPlace& place);
  // The solution with exactly this parameter, on the way that tangent and curvature lead from near it.
  std::optional<PathPlace> at(const PathPlace& near, double parameter, const PathChange& curvature);
  // The parameter, if there is one, at which alone no direction across is told from another: a bent rod may turn about
  // its axis there at no cost, and the equations are singular but for a phase.
  std::optional<double> free_parameter() const { return free_parameter_; }
  bool is_free_turn(const PathPlace& place) const { return place.is_free && place.state.parameter == free_parameter_; }

  // For critical points and stops, which no arc of a regular point tells of.
  bool may_double() const;
  // How far a critical value of the parameter may be off: the share of it that the tolerance is of the length.
  double parameter_tolerance(double parameter) const;
  // Whether the place is as accurate as asked for, with arcs that do not swing too far.
  bool is_accurate(const PathPlace& place) const;
  // The place again with twice the arcs, in all spans or in those that are too coarse where the path goes; with
  // segments for loads about its own. False: that cannot be done.
  bool refine(PathPlace& place);
  bool refine_for(const PathPlace& next, PathPlace& place);
  bool recentre(PathPlace& place);
  bool is_within_mesh(const PathPlace& place) const;

  // The most that the parameter may change in a step from here, upwards or downwards: loads grown so far make no two
  // critical points.
  bool is_small_change(double from, double to);

  // Where another branch crosses: the same place with that one's direction, towards +y.
  PathPlace fork(const PathPlace& place, int multiplicity);

  SavedPlace saved(const PathPlace& place) const { return {equations_.mesh(), place, equations_.held()}; }
  PathPlace restored(const SavedPlace& saved);
  // The same going back.
  void reverse(PathPlace& place) const;

  PathEquations& equations() { return equations_; }
  const PathEquations& equations() const { return equations_; }
  bool tendon_collapsed() const { return equations_.tendon_collapsed(); }

 private:
  std::optional<PathPlace> corrected(PathState guess, const PathBorder::Row& row, Newton newton);
  std::optional<PathPlace> judged(std::optional<PathPlace> place);
  bool change_mesh(PathPlace& place, const PathMesh& mesh);
  bool refine(PathPlace& place, const std::vector<bool>& spans);
  PathMesh mesh_about(double parameter);
  void set_symmetry(const scene::PathRequest& request);
  bool is_held_by(const PathState& state, scene::Symmetry symmetry) const;
  PathState state_of(const scene::Scene& scene);

  scene::PathRequest request_;
  Options options_;
  Settings settings_;
  double tolerance_mm_;
  PathEquations equations_;
  scene::Symmetry symmetry_ = scene::Symmetry::none;  // of the scene at all parameters
  bool is_round_ = false;                             // no direction across is told from another, at all parameters
  std::optional<double> free_parameter_;
  std::string message_;
};

}  // namespace fam
