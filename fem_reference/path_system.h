// The equations of a path of equilibria: the beam's, in which the parameter is one more unknown, bordered by a
// condition on the increments of Newton's iteration.
//
// Rotations change multiplicatively, so the condition is one on increments: they are orthogonal to a direction, that of
// the path at the last point for a step along it, that of the parameter for a solve where it is given. The bordered
// system is solved by the band's factors and two right hand sides. Near a fold or a branch point the band is nearly
// singular: the error of the two solutions is then along the mode that costs nothing, which the condition takes out.
//
// Where a turn of the whole rod about the x axis costs nothing, its mode is taken out by a pin: a rotation of that mode
// that is not small anywhere near is held. The eigenvalues of what is left are those of all other modes.
#pragma once

#include "fem_reference/beam_system.h"
#include "fem_reference/direction.h"
#include "fem_reference/load_stepping.h"
#include "fem_reference/parametric_model.h"

#include <optional>

namespace fem_reference {

struct PathState {
  double parameter = 0;
  BeamState state;
  Direction tangent;                         // of unit length
  scene::Determinant determinant;            // of the motions that the pin leaves
  std::optional<scene::Determinant> planar;  // of motions in the x-y plane, where double points are its zeros
  std::optional<int> index;                  // number of unstable directions; empty: no energy
  bool neutral = false;                      // it may be turned about the x axis
};

class PathSystem {
 public:
  PathSystem(ParametricModel parametric, const SteppingOptions& options);

  // Newton's iteration from a guess, its increments orthogonal to `fixed`, and what a path needs of the equilibrium
  // found; its tangent leads `ahead`. Empty: see failure().
  std::optional<PathState> solve(BeamState guess, double parameter, const Direction& fixed, const Direction& ahead);
  // The same of a state that is in equilibrium.
  std::optional<PathState> at(const BeamState& state, double parameter, const Direction& ahead);
  // From a point on in a direction.
  std::optional<PathState> step(const PathState& from, const Direction& direction, double length);

  // Away from the path at a branch point: of the two directions in which the equations hold, the mode that costs
  // nothing (of a double point's the one in the x-y plane) and that with the parameter, what is orthogonal to the path.
  std::optional<Direction> off_the_path(const PathState& at, bool is_double);

  Direction along_parameter(double sign) const;
  double dot(const Direction& a, const Direction& b) const { return product(a, b, reach_); }
  const PathFacts& facts() const { return facts_; }
  const ParametricModel& parametric() const { return parametric_; }
  const BeamModel& model() const { return model_; }
  const SteppingOptions& options() const { return options_; }
  const char* failure() const { return failure_; }
  int newton_iterations() const { return newton_iterations_; }

 private:
  bool failed(const char* why);
  Residual assemble(const BeamState& state, double parameter);
  bool correct(BeamState& state, double& parameter, const Direction& fixed);
  bool bordered_increment(const BeamState& state, double parameter, const Direction& fixed, Direction& increment);
  std::optional<PathState> judged(BeamState state, double parameter, const Direction& ahead);
  void place_pin(const BeamState& state);
  std::optional<Direction> buckling_mode(bool is_double);

  ParametricModel parametric_;
  ParameterSlope slope_;
  PathFacts facts_;
  SteppingOptions options_;
  double reach_;
  BeamModel model_;
  BeamSystem system_;
  std::optional<Pin> pin_;
  double pinned_turn_ = 1;  // of the free turn's mode at the pin
  int newton_iterations_ = 0;
  const char* failure_ = "";
};

}  // namespace fem_reference
