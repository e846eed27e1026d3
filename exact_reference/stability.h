// Stability of an equilibrium under conservative loads, by the second variation of its potential energy.
#pragma once

#include "exact_reference/shooting.h"

#include <optional>

namespace exact_reference {

// Number of independent directions in which the potential energy falls (Morse index); 0: stable.
// Empty where an equilibrium is neutral within round-off or within what the mesh resolves.
//
// With fixed forces alone N(s) is given, v is minimised out at each section, and the second variation acts on rotations
// only. P = dM/dtheta, the form of everything distal of a node, goes from tip to clamp by each interval's transfer
// matrix, and the rod's negative eigenvalues are counted interval by interval, as in the elimination of a block
// tridiagonal form, but without the inverse of an interval's compliance, of which a strip's stiff axis leaves nothing
// but round-off; where fixed forces act off the centreline, the form of their lever arms is added. Their number is that
// of the conjugate points in (0, L]. Intervals must be short enough to hold none themselves. Exact for scenes without
// follower loads and fixed moments, whose form is not symmetric: of that the symmetric part is taken; `y` must be an
// equilibrium of `shooting`'s mesh under `load` times the loads.
//
// turns_freely: one direction is known to cost nothing and is left out.
std::optional<int> falling_directions(const Shooting& shooting, const NodeStates& y, double load = 1,
                                      bool turns_freely = false);

}  // namespace exact_reference
