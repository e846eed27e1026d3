// Scenes whose loads all follow: the wrench at the tip is known in the tip's own frame, so the rod equations are
// marched from tip to clamp, in the section-frame form, by SUNDIALS CVODE (Adams formulas of variable order), restarted
// at every span's end.
#pragma once

#include "exact_reference/scaled_rod.h"
#include "scene/equilibrium.h"

namespace exact_reference {

// `rod` must have no load in the base frame. tolerance: of the tip, over L; CVODE's own is a five-hundredth of it,
// 2e-15 at least, because its global error is that much larger. The error estimate is the largest change of a
// station's position and that of the tip's rotation against a second march with ten times CVODE's tolerance, or the
// drift of |n| and m.n along spans without distributed loads if that is larger, and 2e-16 a step for round-off. Where
// it is beyond worst_error (solve.h) CVODE's tolerance is tightened as far as it goes: the errors of a march add up along
// thousands of turns.
// Measured: transverse force up to F L^2/EI = 40: error below 4e-13 L, estimate never below the error; 2 ms.
scene::Equilibrium solve_initial_value(const ScaledRod& rod, double tolerance);

}  // namespace exact_reference
