// Every scene as a boundary value problem: multiple shooting (shooting.h) on the branch that grows from the unloaded
// rod.
//
// The load grows from nothing with a predictor (prediction.h). A step is taken back and halved when Newton's iteration
// fails, moves a section by more than 0.1 rad from the prediction, or turns one by more than 2 rad; so the answer does
// not jump to another equilibrium. At a fold (the rod snaps) the step shrinks to nothing:
// status limit_point where limit.h finds it ahead, else load_step_too_small. work_limit: more than 3000 load steps, or
// seconds of work (intervals linearised, on the way and on the fine mesh). tendon_collapsed: the load cannot grow
// because a tendon's path has no length somewhere. not_converged: a rest shape that turns by more than 1e4 rad, or a
// fine mesh that does not settle. Exactly symmetric scenes stay symmetric: a straight rod under pure compression stays
// straight beyond the Euler load, with stable = false.
//
// The mesh is refined where a step and two half steps differ and where what grows or decays along an interval is not
// resolved (Shooting::volume_changes), which a taut straight rod does not show in its shape; then it is halved as a
// whole. The largest difference of a node's two positions is the error estimate. Measured accuracy: solve.h.
#pragma once

#include "exact_reference/shooting.h"
#include "scene/equilibrium.h"

#include <optional>

namespace exact_reference {

// tolerance: of any position, over L. The rods of a way (scaled_way), or one alone: the branch goes on from each to the
// next. reached: if given, the nodes at the full load, on the mesh of the way there.
scene::Equilibrium solve_boundary_value(std::span<const ScaledRod> way, double tolerance,
                                        MeshedStates* reached = nullptr);

// Whether the rod unloads from this equilibrium under its full loads (to be converged on that mesh first) to the
// unloaded rod, in steps as above: then it is the one that the growing load leads to. Where the loads have an energy it
// must be stable. Empty: that takes more work than a certificate is worth (coils, cables).
std::optional<bool> leads_back(const ScaledRod& rod, const MeshedStates& equilibrium);

}  // namespace exact_reference
