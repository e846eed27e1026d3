// Equilibrium paths of the finite element beam: the equilibria of a scene while its parameter changes, through folds
// and over branch points, by arc length (path_system.h, path_tracer.h).
#pragma once

#include "fem_reference/options.h"
#include "fem_reference/stations.h"
#include "scene/path.h"

#include <functional>

namespace fem_reference {

// Called for each point in the order of Path::points, with the shape there: see stations().
using OnPathPoint = std::function<void(const scene::PathPoint&, const SolvedBeam&)>;

// From the equilibrium that solve() finds at request.from towards request.to. The request must be valid.
//
// index: negative eigenvalues of the tangent of the discrete rod, whose critical parameters have an error as well
// (stability.h); at folds and branch points of the motions that are not neutral. Points of a branch b > 0 begin with
// the branch point that they leave, `start`, into +y as seen at the tip (into +z, a turn about +x where it does not go
// there). On the way the parameter changes by at most largest_step, a twenty-fifth of to - from by default.
//
// Options: elements, order, model, tolerance, max_newton_iterations as in solve(), and all others for the start;
// max_load_steps bounds the points. A branch that does not end as it should gives the status if those before did.
scene::Path follow(const scene::PathRequest& request, const Options& options = {}, const OnPathPoint& on_point = {});

}  // namespace fem_reference
