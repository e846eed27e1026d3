// A column: a straight rod that its loads pull or press along its axis, and whether it buckles.
//
// Its second variation is one of each plane of bending by itself, int (EI theta'^2 - P theta^2) ds, theta = 0 at the
// clamp: it is positive where the turn that the tip's freedom starts, EI theta'' + P theta = 0 from theta' = 0 there,
// vanishes nowhere on the way to the clamp (Jacobi). P(s) is the pressing force, -N under the pull N of the loads
// beyond; of a rod that stretches and shears, its strains v at the least of their energy for each theta, it is
// -N v_x + N^2 / (kGA + T / v_x) with v_x = 1 + (N - T) / EA and the pull T of the tendons.
// On a cell of constant P theta is a sine, a line or a hyperbolic one. Where P changes along a span, steps above it
// have zeros no later and steps below it no sooner (Sturm's comparison theorem): the cells are made finer until both
// tell the same.
#pragma once

#include "fam/arc_law.h"

#include "scene/span.h"

#include <optional>
#include <span>

namespace fam {

// Straight at rest; fixed forces, gravity and tendons, all along the axis.
bool is_column(std::span<const scene::Span> spans);

// Whether it is stable; empty where the pressing force is within 1e-10 of a critical one, or some 1e-3 along a span in
// which it changes, and where the strains are no small ones.
std::optional<bool> is_stable_column(std::span<const scene::Span> spans, RodModel model);

}  // namespace fam
