// Arc laws: which strain does an arc get from the wrench at its distal end?
//
// published      the paper's law as reconstructed in README.md, "The published law". Second order in h for planar
//                scenes, first order in 3D with torsion. Kirchhoff rods with one bending stiffness.
// midpoint       strain at the wrench carried half an arc towards the clamp. Second order.
// fourth_order   a Runge-Kutta-Munthe-Kaas step on SE(3) (Munthe-Kaas 1999; Iserles et al., Acta Numerica 2000).
#pragma once

#include "fam/arc.h"

#include "scene/span.h"

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

enum class RodModel { automatic, kirchhoff, reissner };

// Constants of the arcs of a span that is cut into `arcs`; the tendons' tension is multiplied by load_factor.
ArcConstants arc_constants(const scene::Span& span, int arcs, RodModel model, double load_factor = 1);

// Strain times h under a wrench; the Kirchhoff rod keeps the rest translation.
template <bool with_shear, class T>
BasicScrew<T> strain(const ArcConstants& arc, const BasicWrench<T>& wrench) {
  BasicScrew<T> screw{arc.rest_rotation.cast<T>() + arc.angular_compliance.cast<T>().cwiseProduct(wrench.moment_Nmm),
                      arc.rest_translation_mm.cast<T>()};
  if constexpr (with_shear) {
    screw.translation_mm += arc.linear_compliance.cast<T>().cwiseProduct(wrench.force_N);
  }
  return screw;
}

// The laws below set the arc's screw, carry the wrench from its distal to its proximal end and return the arc's motion.

template <bool with_shear, class T>
BasicMotion<T> midpoint_step(const ArcConstants& arc, BasicWrench<T>& wrench, BasicScrew<T>& screw) {
  const BasicScrew<T> k1 = strain<with_shear>(arc, wrench);
  screw = strain<with_shear>(arc, transport(exponential(0.5 * k1), wrench));
  const BasicMotion<T> motion = exponential(screw);
  wrench = transport(motion, wrench);
  return motion;
}

template <class T>
BasicScrew<T> fourth_order_sum(const BasicScrew<T>& k1, const BasicScrew<T>& k2, const BasicScrew<T>& k3,
                               const BasicScrew<T>& k4) {
  return (1 / 6.) * (k1 + 2.0 * (k2 + k3) + k4) + (-1 / 12.) * bracket(k1, k4);
}

template <bool with_shear, class T>
BasicMotion<T> fourth_order_step(const ArcConstants& arc, BasicWrench<T>& wrench, BasicScrew<T>& screw) {
  const BasicScrew<T> k1 = strain<with_shear>(arc, wrench);
  const BasicScrew<T> k2 = strain<with_shear>(arc, transport(exponential(0.5 * k1), wrench));
  const BasicScrew<T> k3 =
      strain<with_shear>(arc, transport(exponential(0.5 * k2 + (-1 / 8.) * bracket(k1, k2)), wrench));
  const BasicScrew<T> k4 = strain<with_shear>(arc, transport(exponential(k3), wrench));
  screw = fourth_order_sum(k1, k2, k3, k4);
  const BasicMotion<T> motion = exponential(screw);
  wrench = transport(motion, wrench);
  return motion;
}

// Distributed forces on an arc, times h. Both are constant along it: one in the section frame, one in the base frame,
// of which the components in the arc's distal frame D are known when the arc is met.
template <class T>
struct ArcForces {
  Vector3<T> follower_S_N, fixed_D_N;
};

// Under distributed forces the wrench, carried back to the distal frame, grows along the arc: its derivative is the
// force and the force's moment about the distal end. Screw and growth are advanced together by the same Runge-Kutta
// steps, on the group SE(3) x R^6.
template <class T>
BasicWrench<T> growth(const ArcForces<T>& forces, const BasicMotion<T>& motion) {
  const Vector3<T> force = forces.fixed_D_N + motion.rotate_back(forces.follower_S_N);
  return {force, -motion.rotate_back(motion.position_mm).cross(force)};
}

template <bool with_shear, class T>
BasicMotion<T> midpoint_step(const ArcConstants& arc, const ArcForces<T>& forces, BasicWrench<T>& wrench,
                             BasicScrew<T>& screw) {
  const BasicScrew<T> k1 = strain<with_shear>(arc, wrench);
  const BasicWrench<T> l1 = growth(forces, exponential(BasicScrew<T>{}));
  const BasicMotion<T> half = exponential(0.5 * k1);
  screw = strain<with_shear>(arc, transport(half, wrench + 0.5 * l1));
  const BasicMotion<T> motion = exponential(screw);
  wrench = transport(motion, wrench + growth(forces, half));
  return motion;
}

template <bool with_shear, class T>
BasicMotion<T> fourth_order_step(const ArcConstants& arc, const ArcForces<T>& forces, BasicWrench<T>& wrench,
                                 BasicScrew<T>& screw) {
  const BasicScrew<T> k1 = strain<with_shear>(arc, wrench);
  const BasicWrench<T> l1 = growth(forces, exponential(BasicScrew<T>{}));
  const BasicMotion<T> to2 = exponential(0.5 * k1);
  const BasicScrew<T> k2 = strain<with_shear>(arc, transport(to2, wrench + 0.5 * l1));
  const BasicWrench<T> l2 = growth(forces, to2);
  const BasicMotion<T> to3 = exponential(0.5 * k2 + (-1 / 8.) * bracket(k1, k2));
  const BasicScrew<T> k3 = strain<with_shear>(arc, transport(to3, wrench + 0.5 * l2));
  const BasicWrench<T> l3 = growth(forces, to3);
  const BasicMotion<T> to4 = exponential(k3);
  const BasicScrew<T> k4 = strain<with_shear>(arc, transport(to4, wrench + l3));
  const BasicWrench<T> l4 = growth(forces, to4);
  screw = fourth_order_sum(k1, k2, k3, k4);
  const BasicMotion<T> motion = exponential(screw);
  wrench = transport(motion, wrench + (1 / 6.) * (l1 + 2.0 * (l2 + l3) + l4));
  return motion;
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
