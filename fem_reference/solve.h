// Finite element reference: a geometrically exact (Simo-Reissner) beam on deal.II.
//
// Solves every kind of load of the scene format, follower and fixed. With reduced integration its own discretisation
// error falls as h^(2 order) at the tip and the elements' ends, and as h^(order + 1) between them. Formulation:
// beam_element.h. It stands in for the beam elements of a commercial code and shares no mechanics with the finite arc
// method.
#pragma once

#include "fem_reference/options.h"
#include "scene/equilibrium.h"
#include "scene/scene.h"

namespace fem_reference {

// The equilibrium that the rod reaches when its loads (tendons included) grow together from zero; beside a buckling
// load the stable one, unless a perfect symmetry holds the rod on the unstable one (load_stepping.h).
//
// stations: all nodes, span ends and s = k L/40, with the rod's own force and moment (stations.h). error_estimate_mm:
// of the position of any station, from two meshes (NaN if the second solve fails, 0 if not asked for). stable: under
// fixed forces on and off the centreline, distributed fixed forces, gravity and tendons alone, or no loads, by the
// tangent (stability.h) of the discrete rod, whose critical loads have an error as well; empty under any other load and
// where it is neutral. Facts: elements, order, integration, model, load_steps, newton_iterations, of the main solve.
//
// Status limit_point: the growing load meets a fold of the path, `limit` says where. load_step_too_small: the load step
// fell below smallest_load_step for another reason. not_finite, tendon_collapsed: the same, and
// the last attempt met a value that is not finite, or a tendon whose path has next to no length somewhere
// (tendon_pull.h). work_limit: max_load_steps used up. not_converged: an element turns by pi or more from end to end,
// or a section is compressed to nothing (1 + stretch <= 0), so that the result is no rod. unsupported: full integration
// of a rod that does not stretch or shear, which locks to a straight line. Throws scene::SceneError if an option is out
// of its range. The scene must be valid.
scene::Equilibrium solve(const scene::Scene& scene, const Options& options = {});

}  // namespace fem_reference
