// Finite element reference: a geometrically exact (Simo-Reissner) beam on deal.II.
//
// Solves every kind of load of the scene format, follower and fixed. With reduced integration its own discretisation
// error falls as h^(2 order) at the tip and the elements' ends, and as h^(order + 1) between them. Formulation:
// beam_element.h. It stands in for the beam elements of a commercial code and shares no mechanics with the finite arc
// method.
#pragma once

#include "scene/equilibrium.h"
#include "scene/rod_model.h"
#include "scene/scene.h"

namespace fem_reference {

using scene::RodModel;  // kirchhoff: exact, not a penalty

struct Options {
  int elements = 50;              // on the whole rod, shared out over the spans; each span gets at least one
  int order = 2;                  // of the shape functions: 1, 2 or 3
  bool full_integration = false;  // order + 1 Gauss points in place of `order`; shows shear locking, else useless
  RodModel model = RodModel::reissner;
  bool estimate_error = true;  // a second solve, on about half the elements

  double initial_load_step = 0.25;    // 0 < . <= 1
  double smallest_load_step = 1e-8;   // below it the solve gives up
  int max_load_steps = 100'000;       // accepted and rejected
  int max_newton_iterations = 15;     // in a load step
  double largest_rotation_rad = 0.6;  // of any node in a load step: keeps to the branch that starts at no load
  double tolerance = 1e-10;           // on Newton increments to come (lengths over L, rad), residuals; load_stepping.h
};

// The equilibrium that the rod reaches when its loads (tendons included) grow together from zero; beside a buckling
// load the stable one, unless a perfect symmetry holds the rod on the unstable one (load_stepping.h).
//
// stations: all nodes, span ends and s = k L/40, with the rod's own force and moment (stations.h). error_estimate_mm:
// of the position of any station, from two meshes (NaN if the second solve fails, 0 if not asked for). stable: under
// fixed forces on and off the centreline, distributed fixed forces, gravity and tendons alone, or no loads, by the
// tangent (stability.h) of the discrete rod, whose critical loads have an error as well; empty under any other load and
// where it is neutral. Facts: elements, order, integration, model, load_steps, newton_iterations, of the main solve.
//
// Status load_step_too_small: the load step fell below smallest_load_step. not_finite, tendon_collapsed: the same, and
// the last attempt met a value that is not finite, or a tendon whose path has next to no length somewhere
// (tendon_pull.h). work_limit: max_load_steps used up. not_converged: an element turns by pi or more from end to end,
// or a section is compressed to nothing (1 + stretch <= 0), so that the result is no rod. unsupported: full integration
// of a rod that does not stretch or shear, which locks to a straight line. Throws scene::SceneError if an option is out
// of its range. The scene must be valid.
scene::Equilibrium solve(const scene::Scene& scene, const Options& options = {});

}  // namespace fem_reference
