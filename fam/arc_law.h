// Arc laws: which strain does an arc get from the wrench at its distal end?
//
// published      the paper's law as reconstructed in README.md, "The published law". Second order in h for planar
//                scenes, first order in 3D with torsion. Kirchhoff rods with one bending stiffness.
// midpoint       strain at the wrench carried half an arc towards the clamp. Second order.
// fourth_order   a Runge-Kutta-Munthe-Kaas step on SE(3) (Munthe-Kaas 1999; Iserles et al., Acta Numerica 2000).
#pragma once

#include "fam/arc.h"

namespace fam {

enum class Law { automatic, published, midpoint, fourth_order };

// Order in which the published law applies bending and twist; the paper does not say.
enum class TwistOrder { bend_twist, twist_bend };

// What an arc of one span needs to know; products with the arc length h are taken once.
struct ArcConstants {
  double length_mm = 0;                             // h
  Vector3d angular_compliance = Vector3d::Zero();   // h / (GJ, EI_y, EI_z)
  Vector3d rest_rotation = Vector3d::Zero();        // h (u0 + tendon moment / stiffness)
  Vector3d linear_compliance = Vector3d::Zero();    // h / (EA, kGA_y, kGA_z); 0 where the section does not give way
  Vector3d rest_translation_mm = Vector3d::Zero();  // h (e_x + tendon force / stiffness)
};

// Strain times h under a wrench; the Kirchhoff rod keeps the rest translation.
template <bool with_shear>
Screw strain(const ArcConstants& arc, const SectionWrench& wrench) {
  Screw screw{arc.rest_rotation + arc.angular_compliance.cwiseProduct(wrench.moment_Nmm), arc.rest_translation_mm};
  if constexpr (with_shear) screw.translation_mm += arc.linear_compliance.cwiseProduct(wrench.force_N);
  return screw;
}

template <bool with_shear>
Screw midpoint_strain(const ArcConstants& arc, const SectionWrench& distal) {
  const Screw k1 = strain<with_shear>(arc, distal);
  return strain<with_shear>(arc, transport(exponential(0.5 * k1), distal));
}

template <bool with_shear>
Screw fourth_order_strain(const ArcConstants& arc, const SectionWrench& distal) {
  const Screw k1 = strain<with_shear>(arc, distal);
  const Screw k2 = strain<with_shear>(arc, transport(exponential(0.5 * k1), distal));
  const Screw k3 = strain<with_shear>(arc, transport(exponential(0.5 * k2 + (-1 / 8.) * bracket(k1, k2)), distal));
  const Screw k4 = strain<with_shear>(arc, transport(exponential(k3), distal));
  return (1 / 6.) * (k1 + 2.0 * (k2 + k3) + k4) + (-1 / 12.) * bracket(k1, k4);
}

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
