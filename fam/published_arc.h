// The arc of the paper's law: a bend in a plane, after a Bezier curve, and a twist apart from it.
#pragma once

#include "fam/arc.h"
#include "fam/arc_section.h"

namespace fam {

// Order in which the law applies bending and twist; the paper does not say.
enum class TwistOrder { bend_twist, twist_bend };

// Bending angle of the published law in its plane, all quantities made dimensionless with h and EI: the root of
// d/dtheta of Pi = int_0^1 (theta - M(sigma; theta))^2 dsigma that safeguarded secant steps reach from the mean
// moment of the straight arc. The tolerance is relative to the loads, so that short arcs keep their digits: done at
// |step| <= angle_step_tolerance (|moment| + |normal| + |theta|), after which one more superlinear step would change
// nothing; false when max_angle_steps do not get there.
constexpr int max_angle_steps = 50;
constexpr double angle_step_tolerance = 1e-9;
struct PlaneLoad {
  double moment;  // M_nu h / EI
  double axial;   // F_x h^2 / EI, in the distal frame
  double normal;  // F_b h^2 / EI, along b = nu x e_x
};
bool published_angle(const PlaneLoad& load, double& angle_rad);

// The published arc; false when its angle was not found.
bool published_arc(const ArcConstants& constants, const SectionWrench& distal, TwistOrder order, Arc& arc);

}  // namespace fam
