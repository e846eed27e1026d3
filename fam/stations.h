// What solve() reports along the rod.
#pragma once

#include "fam/shape.h"

#include "scene/equilibrium.h"
#include "scene/scene.h"

namespace fam {

// Fills stations, clamp to tip (s = k L/40, span ends, and as many arc ends and places in arcs as it takes that none
// turns farther than half a radian from the last), and the tendons' shortening; none of which has collapsed.
// rotation_BP: from the frame that the rod was solved in to the base frame.
template <int D>
void set_shape(scene::Equilibrium& result, const scene::Scene& scene, std::span<const scene::Span> spans,
               const SolvedRod<D>& rod, const Matrix3d& rotation_BP);

}  // namespace fam
