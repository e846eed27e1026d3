// Brings the load from zero to its full value, in steps that adapt to how far the rod turns.
#pragma once

#include "fem_reference/beam_system.h"
#include "fem_reference/options.h"
#include "scene/equilibrium.h"

#include <optional>
#include <string>

namespace fem_reference {

struct SteppingOptions {
  double initial_load_step = 0.25;
  double smallest_load_step = 1e-8;
  int max_load_steps = 100'000;  // accepted and rejected
  int max_newton_iterations = 15;
  double largest_rotation_rad = 0.6;  // of any node in a step
  double tolerance = 1e-10;
  double smallest_bifurcation_step = 1e-5;
};

SteppingOptions stepping_options(const Options& options);

// state only when the status is `converged`.
struct SteppingResult {
  scene::Status status = scene::Status::not_converged;
  std::string message;
  BeamState state;
  std::optional<double> limit;  // the load factor of a fold, which limit.h finds
  std::optional<bool> stable;   // stability.h; empty where the loads are not conservative, and where it is neutral
  int load_steps = 0;           // accepted
  int newton_iterations = 0;    // all, those of rejected steps included
};

// The increment that Newton's iteration would add next, at most: it falls by more from one to the next than it did from
// the last (0: there is none) to now, quadratically in the end.
double next_increment(double last, double now);

// Newton's iteration ends: largest increment of a node yet to come (displacement over L, rotation in rad) <= tolerance
// and largest residual <= tolerance F, with F = max(1, largest internal force) in EI / L^2.
bool is_converged(double largest_increment, const Residual& residual, double largest_force, double tolerance);

// From the rest shape to the full load, along the path of equilibria.
//
// A step is accepted when
//   Newton's iteration has converged, and
//   no node has turned by more than largest_rotation_rad in the step, half of that in the first one, and
//   no node lies farther than a twelfth of largest_rotation_rad from where the last step pointed, nor, unless the step
//   is shorter than a sixteenth of the last, farther than half of what one has turned in it,
// the last two of which keep Newton from reaching another branch of equilibria, where the residual vanishes as well.
// Beside a buckling load the branches lie too close for that. So a step is refused too if the tangent's determinant has
// changed its sign, and no step goes on to where it vanishes by the line through the last two (scene/branch_watch.h).
// In a planar scene the determinant is that of motions in the plane, and on the axis none is watched: there a rod whose
// symmetry nothing breaks stays on its branch. Where the loads are conservative, a step from a stable equilibrium to
// one that is not is halved as well, in planar scenes and on the axis down to smallest_bifurcation_step, where it is
// accepted. Loads that all follow the rod leave it one equilibrium, and nothing to watch.
//
// A step in which a tendon collapses (tendon_pull.h) is refused; where the steps become too small for that, the status
// is tendon_collapsed. One that ends with max_load_steps has the status work_limit. An accepted step in which an
// element turns by pi or more from end to end, beyond what the mesh can show, is the last.
SteppingResult step_to_full_load(const BeamModel& model, const SteppingOptions& options);

}  // namespace fem_reference
