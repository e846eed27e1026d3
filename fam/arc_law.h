// Arc laws: which strain does an arc get from the wrench at its distal end?
//
// published      the paper's law as reconstructed in README.md, "The published law". Second order in h for planar
//                scenes, first order in 3D with torsion. Kirchhoff rods with one bending stiffness.
// midpoint       strain at the wrench carried half an arc towards the clamp. Second order.
// fourth_order   a Runge-Kutta-Munthe-Kaas step on SE(3) (Munthe-Kaas 1999; Iserles et al., Acta Numerica 2000).
// sixth_order    the strain's Taylor series at the distal end, summed up by the Magnus expansion of order six (Blanes,
//                Casas, Ros, BIT 40, 2000). No more dear than fourth_order: the rod equations are quadratic, so that
//                the series is a recursion of cross products, and the arc takes a single exponential.
#pragma once

#include "fam/arc.h"
#include "fam/tendon.h"

#include "scene/rod_model.h"
#include "scene/span.h"

#include <array>

namespace fam {

enum class Law { automatic, published, midpoint, fourth_order, sixth_order };

// Order in which the published law applies bending and twist; the paper does not say.
enum class TwistOrder { bend_twist, twist_bend };

// What an arc of one span needs to know; products with the arc length h are taken once. In the plane (D = 2) the
// bending is about z.
template <int D>
struct BasicArcConstants {
  double length_mm = 0;                                               // h
  Turn<double, D> angular_compliance = Turn<double, D>::Zero();       // h / (GJ, EI_y, EI_z)
  Turn<double, D> rest_rotation = Turn<double, D>::Zero();            // h (u0 + moment of straight tendons / stiffness)
  Vector<double, D> linear_compliance = Vector<double, D>::Zero();    // h / (EA, kGA_y, kGA_z); 0: does not give way
  Vector<double, D> rest_translation_mm = Vector<double, D>::Zero();  // h e_x
  std::vector<BasicTendon<D>> tendons;
  bool straight_tendons = false;  // along e_x whatever the strain: their moment is in rest_rotation

  bool is_elastic() const { return tendons.empty() || straight_tendons; }
};
using ArcConstants = BasicArcConstants<3>;

// The components of a vector in space, or of a turn, that a rod in the x-y plane has.
template <int D>
Vector<double, D> in_space_or_plane(const Vector3d& v) {
  return v.head<D>();
}
template <int D>
Turn<double, D> turn_in_space_or_plane(const Vector3d& w) {
  return w.tail<turns_of(D)>();
}

using scene::RodModel;

// Constants of the arcs of a span that is cut into `arcs`. set_tendons: their tension times load_factor, without
// allocation after the first time.
template <int D = 3>
BasicArcConstants<D> arc_constants(const scene::Span& span, int arcs, RodModel model, double load_factor = 1);
template <int D>
void set_tendons(BasicArcConstants<D>& arc, const scene::Span& span, RodModel model, double load_factor);

// What a law asks of a section: the strain times h under a wrench, and the coefficients of its series along an arc.
// This one is elastic, without tendons (theirs: fam/tendon.h); a Kirchhoff rod keeps the rest translation.
template <bool with_shear, class T, int D>
class ElasticSection {
 public:
  static constexpr bool gives_way = with_shear;
  explicit ElasticSection(const BasicArcConstants<D>& arc) : arc_(arc) {}

  BasicScrew<T, D> strain(const BasicWrench<T, D>& wrench) const {
    BasicScrew<T, D> screw{arc_.rest_rotation.template cast<T>() +
                               arc_.angular_compliance.template cast<T>().cwiseProduct(wrench.moment_Nmm),
                           arc_.rest_translation_mm.template cast<T>()};
    if constexpr (with_shear) {
      screw.translation_mm += arc_.linear_compliance.template cast<T>().cwiseProduct(wrench.force_N);
    }
    return screw;
  }
  void begin_series(const BasicScrew<T, D>&) const {}
  void next(std::size_t, const Turn<T, D>& moment_Nmm, const Vector<T, D>& force_N, Turn<T, D>& rotation,
            Vector<T, D>& translation_mm) const {
    rotation = arc_.angular_compliance.template cast<T>().cwiseProduct(moment_Nmm);
    if constexpr (with_shear) translation_mm = arc_.linear_compliance.template cast<T>().cwiseProduct(force_N);
  }
  bool collapsed() const { return false; }

 private:
  const BasicArcConstants<D>& arc_;
};

// Distributed forces on an arc, times h. Both are constant along it: one in the section frame, one in the base frame,
// of which the components in the arc's distal frame D are known when the arc is met.
template <class T, int D>
struct ArcForces {
  Vector<T, D> follower_S_N, fixed_D_N;
};

// The laws below set the arc's screw, carry the wrench from its distal to its proximal end and return the arc's motion.
// Without distributed forces (the null pointer) the wrench is carried exactly, whatever the strain.
//
// Under distributed forces the wrench, carried back to the distal frame, grows along the arc: its derivative is the
// force and the force's moment about the distal end. The Runge-Kutta laws advance screw and growth together by the same
// steps, on the group SE(3) x R^6.
template <class T, int D>
BasicWrench<T, D> growth(const ArcForces<T, D>& forces, const BasicMotion<T, D>& motion) {
  const Vector<T, D> force = forces.fixed_D_N + motion.rotate_back(forces.follower_S_N);
  return {force, -arm_cross(motion.rotate_back(motion.position_mm), force)};
}

template <class Section, class T, int D>
BasicMotion<T, D> midpoint_step(Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                BasicScrew<T, D>& screw) {
  const BasicScrew<T, D> k1 = section.strain(wrench);
  const BasicMotion<T, D> half = exponential(0.5 * k1);
  BasicWrench<T, D> middle = wrench;
  if (forces) {
    middle = wrench + 0.5 * growth(*forces, exponential(BasicScrew<T, D>{}));
    wrench = wrench + growth(*forces, half);
  }
  screw = section.strain(transport(half, middle));
  BasicMotion<T, D> motion = exponential(screw);
  wrench = transport(motion, wrench);
  return motion;
}

template <class Section, class T, int D>
BasicMotion<T, D> fourth_order_step(Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                    BasicScrew<T, D>& screw) {
  const auto grow = [&](double factor, const BasicMotion<T, D>& motion, BasicWrench<T, D>& growth_here) {
    if (!forces) return wrench;
    growth_here = growth(*forces, motion);
    return wrench + factor * growth_here;
  };
  BasicWrench<T, D> l1, l2, l3, l4;
  const BasicScrew<T, D> k1 = section.strain(wrench);
  const BasicMotion<T, D> to2 = exponential(0.5 * k1);
  const BasicScrew<T, D> k2 = section.strain(transport(to2, grow(0.5, exponential(BasicScrew<T, D>{}), l1)));
  const BasicMotion<T, D> to3 = exponential(0.5 * k2 + (-1 / 8.) * bracket(k1, k2));
  const BasicScrew<T, D> k3 = section.strain(transport(to3, grow(0.5, to2, l2)));
  const BasicMotion<T, D> to4 = exponential(k3);
  const BasicScrew<T, D> k4 = section.strain(transport(to4, grow(1, to3, l3)));
  screw = (1 / 6.) * (k1 + 2.0 * (k2 + k3) + k4) + (-1 / 12.) * bracket(k1, k4);
  BasicMotion<T, D> motion = exponential(screw);
  if (forces) {
    l4 = growth(*forces, to4);
    wrench = wrench + (1 / 6.) * (l1 + 2.0 * (l2 + l3) + l4);
  }
  wrench = transport(motion, wrench);
  return motion;
}

// Taylor series about the distal end, from there to the proximal end, of strain and wrench; coefficients times h^k (the
// strain's times h once more).
template <class T, int D, std::size_t terms>
struct RodSeries {
  std::array<Turn<T, D>, terms> rotation, moment_Nmm;
  std::array<Vector<T, D>, terms> translation_mm, force_N;
};

// n' = u x n + f, m' = u x m + v x n, f' = u x f for the force fixed in space (primes towards the proximal end).
template <std::size_t terms, class Section, class T, int D>
RodSeries<T, D, terms> rod_series(Section&& section, const ArcForces<T, D>* forces, const BasicWrench<T, D>& wrench) {
  RodSeries<T, D, terms> s;
  std::array<Vector<T, D>, terms> fixed_N;
  s.force_N[0] = wrench.force_N;
  s.moment_Nmm[0] = wrench.moment_Nmm;
  if (forces) fixed_N[0] = forces->fixed_D_N;
  const BasicScrew<T, D> first = section.strain(wrench);
  s.rotation[0] = first.rotation;
  s.translation_mm[0] = first.translation_mm;
  section.begin_series(first);
#pragma GCC unroll 8
  for (std::size_t k = 0; k + 1 < terms; ++k) {
    Vector<T, D> force = cross(s.rotation[0], s.force_N[k]);
    Turn<T, D> moment = cross(s.rotation[0], s.moment_Nmm[k]) + arm_cross(s.translation_mm[0], s.force_N[k]);
#pragma GCC unroll 8
    for (std::size_t j = 1; j <= k; ++j) {
      force += cross(s.rotation[j], s.force_N[k - j]);
      moment += cross(s.rotation[j], s.moment_Nmm[k - j]);
      if constexpr (std::remove_cvref_t<Section>::gives_way) moment += arm_cross(s.translation_mm[j], s.force_N[k - j]);
    }
    const T share = T(1.0 / static_cast<double>(k + 1));
    if (forces) {
      force += fixed_N[k];
      if (k == 0) force += forces->follower_S_N;
      Vector<T, D> fixed = cross(s.rotation[0], fixed_N[k]);
      for (std::size_t j = 1; j <= k; ++j) fixed += cross(s.rotation[j], fixed_N[k - j]);
      fixed_N[k + 1] = share * fixed;
    }
    s.force_N[k + 1] = share * force;
    s.moment_Nmm[k + 1] = share * moment;
    section.next(k + 1, s.moment_Nmm[k + 1], s.force_N[k + 1], s.rotation[k + 1], s.translation_mm[k + 1]);
  }
  return s;
}

// Sum of the coefficients from `from` on times weights.
template <class V, std::size_t terms, std::size_t count>
V weighted(const std::array<V, terms>& c, const std::array<double, count>& weights, std::size_t from = 0) {
  using T = typename V::Scalar;
  V sum = T(weights[0]) * c[from];
#pragma GCC unroll 8
  for (std::size_t k = 1; k < count; ++k) sum += T(weights[k]) * c[from + k];
  return sum;
}

// With t from the middle of the arc towards its distal end, in arc lengths: the strain's integral over the arc, and the
// a1 + a2 t + a3 t^2 that goes through the series at the three Gauss points. Weights of the series' coefficients; those
// of a2 start with the second, those of a3 with the third.
constexpr std::array<double, 6> strain_weights{1, 1 / 2., 1 / 3., 1 / 4., 1 / 5., 1 / 6.};
constexpr std::array<double, 6> a1_weights{1, 1 / 2., 1 / 4., 1 / 8., 1 / 16., 1 / 32.};
constexpr std::array<double, 5> a2_weights{-1, -1, -0.9, -0.8, -0.71};
constexpr std::array<double, 4> a3_weights{1, 1.5, 1.65, 1.625};

template <bool with_shear, std::size_t terms, class T, int D>
BasicScrew<T, D> magnus(const RodSeries<T, D, terms>& s) {
  BasicScrew<T, D> integral{weighted(s.rotation, strain_weights), s.translation_mm[0]};
  BasicScrew<T, D> a1{weighted(s.rotation, a1_weights), s.translation_mm[0]};
  BasicScrew<T, D> a2{weighted(s.rotation, a2_weights, 1), Vector<T, D>::Zero()};
  BasicScrew<T, D> a3{weighted(s.rotation, a3_weights, 2), Vector<T, D>::Zero()};
  if constexpr (with_shear) {
    integral.translation_mm = weighted(s.translation_mm, strain_weights);
    a1.translation_mm = weighted(s.translation_mm, a1_weights);
    a2.translation_mm = weighted(s.translation_mm, a2_weights, 1);
    a3.translation_mm = weighted(s.translation_mm, a3_weights, 2);
  }
  const BasicScrew<T, D> b = bracket(a1, a2);
  return integral + (1 / 12.) * b + bracket(a1, bracket(a1, (1 / 360.) * a3 + (-1 / 720.) * b)) +
         bracket(a2, (-1 / 240.) * (a3 + b));
}

template <class Section, class T, int D>
BasicMotion<T, D> sixth_order_step(Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                   BasicScrew<T, D>& screw) {
  if (!forces) {
    screw = magnus<std::remove_cvref_t<Section>::gives_way>(rod_series<6>(section, forces, wrench));
    BasicMotion<T, D> motion = exponential(screw);
    wrench = transport(motion, wrench);
    return motion;
  }
  const RodSeries<T, D, 7> s = rod_series<7>(section, forces, wrench);
  screw = magnus<std::remove_cvref_t<Section>::gives_way>(s);
  constexpr std::array<double, 7> ones{1, 1, 1, 1, 1, 1, 1};
  wrench = {weighted(s.force_N, ones), weighted(s.moment_Nmm, ones)};
  return exponential(screw);
}

// The step of a law but published.
template <class Section, class T, int D>
BasicMotion<T, D> law_step(Law law, Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                           BasicScrew<T, D>& screw) {
  if (law == Law::midpoint) return midpoint_step(section, forces, wrench, screw);
  if (law == Law::fourth_order) return fourth_order_step(section, forces, wrench, screw);
  return sixth_order_step(section, forces, wrench, screw);
}

// The same in a section with tendons; `collapsed` is set where one has no length. Compiled apart (tendon_step.cpp):
// beside the elastic laws it would keep the compiler from inlining those, at 1.1 to 1.4 times the time of a solve.
template <bool with_shear, class T, int D>
BasicMotion<T, D> tendon_step(Law law, const BasicArcConstants<D>& arc, const ArcForces<T, D>* forces,
                              BasicWrench<T, D>& wrench, BasicScrew<T, D>& screw, bool& collapsed);

// Strain times h in any section under a wrench.
template <bool with_shear, int D>
BasicScrew<double, D> strain_under(const BasicArcConstants<D>& arc, const BasicWrench<double, D>& wrench);

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
