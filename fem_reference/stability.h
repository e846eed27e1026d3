// Whether an equilibrium is a minimum of the potential energy, by the tangent of its elements.
//
// For conservative loads the tangent of beam_element.h, symmetrised, is the Hessian of the saddle functional, and the
// energy's own Hessian is what is left of it when the internal forces n are eliminated. Elimination runs element by
// element from the tip to the clamp; Sylvester's law adds up the signs of the pivots.
// - Displacements and n of an element go first. Moving the distal rod without turning it costs no energy under dead
//   loads, so their pivot block is [A B^T; B -C] with A >= 0 from the tendons and B of full rank, whatever the state
//   and where C = 0 too: one negative pivot for each number of n, as many as its elimination takes away. Nothing is to
//   be counted.
// - What is left acts on the rotations, as do the lever arms of point loads: 3x3 blocks along the rod, positive
//   definite exactly at a minimum.
// Under tendons alone, or no loads, the energy is convex in the strains and nothing needs to be eliminated.
#pragma once

#include "fem_reference/condensed_rod.h"

#include <optional>

namespace fem_reference {

// True: minimum, stable. False: the energy falls in some direction. Empty: neutral within round-off, which is a load
// within about 5e-15 (L / shortest element)^2 of critical. The systems must be those of the model's elements and loads,
// all conservative, in an equilibrium.
std::optional<bool> is_stable(const BeamModel& model, const std::vector<ElementSystem>& elements,
                              const std::vector<NodalSystem>& loads);

// The signs of the eigenvalues of the energy's Hessian on the rotations.
struct Inertia {
  int negative = 0;      // the number of unstable directions
  bool neutral = false;  // one more eigenvalue is zero within round-off
};

// Of the same, counted through to the clamp; of motions that leave the pinned rotation as it is. Empty: an element
// cannot be condensed.
std::optional<Inertia> inertia(const BeamModel& model, const std::vector<ElementSystem>& elements,
                               const std::vector<NodalSystem>& loads, const std::optional<Pin>& pin = {});

}  // namespace fem_reference
