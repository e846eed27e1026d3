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
// followed one way: at a simple point the one that takes the tip into +y, or into +z where it does not move in y; at a
// double one that into +y, at z = 0. A branch begins with a second point at its branch point (kind `start`), and ends
// as the first path does, or closed, back there. A branch point that a branch arrives at is not left again.
//
// Throws scene::SceneError where a scene at `from` or `to` is not valid or an option is out of its range.
scene::Path follow(const scene::PathRequest& request, const Options& options = {}, const PathVisitor& visit = {});

}  // namespace exact_reference
