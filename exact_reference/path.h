// Exact reference: paths of equilibria (scene/path.h), by its own equations: multiple shooting with the parameter as
// one more unknown (continuation.h), critical points by its own determinant and conjugate points (critical_points.h).
#pragma once

#include "exact_reference/solve.h"
#include "scene/path.h"

#include <functional>

namespace exact_reference {

// Of each point, with its shape: stations and the tendons' shortening; `stable` as of the point.
using PathVisitor = std::function<void(const scene::PathPoint& point, const scene::Equilibrium& shape)>;

// Model and tolerance of the options count.
//
// The start: what solve() finds at `from` by boundary_value. Branches, in the order in which their points were met, are
// followed one way: at a simple point the one that takes the tip into +y, or else into +z, or else turns it about +x;
// at a double one that into +y, at z = 0. A branch begins with a second point at its branch point (kind `start`), and
// ends as the first path does, or closed, back there. A branch point that a branch arrives at is not left again.
//
// On the way the parameter changes by a twentieth of the range at most if largest_step is not given. A turn that is
// complete and back at its first equilibrium is closed.
//
// Throws scene::SceneError where the request is not valid (scene::validate) or an option is out of its range.
scene::Path follow(const scene::PathRequest& request, const Options& options = {}, const PathVisitor& visit = {});

}  // namespace exact_reference
