// A step over one arc by the Taylor series of its strain.
#pragma once

#include "fam/arc_step.h"

#include <array>
#include <type_traits>

namespace fam {

// Taylor series about the distal end, from there to the proximal end, of strain and wrench; coefficients times h^k (the
// strain's times h once more).
template <class T, int D, std::size_t terms>
struct RodSeries {
  std::array<Angular<T, D>, terms> rotation, moment_Nmm;
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
    auto force_sum = cross(s.rotation[0], s.force_N[k]);
    auto moment_sum = cross(s.rotation[0], s.moment_Nmm[k]);
    moment_sum += arm_cross(s.translation_mm[0], s.force_N[k]);
#pragma GCC unroll 8
    for (std::size_t j = 1; j <= k; ++j) {
      force_sum += cross(s.rotation[j], s.force_N[k - j]);
      moment_sum += cross(s.rotation[j], s.moment_Nmm[k - j]);
      if constexpr (std::remove_cvref_t<Section>::gives_way)
        moment_sum += arm_cross(s.translation_mm[j], s.force_N[k - j]);
    }
    Vector<T, D> force = force_sum;
    const Angular<T, D> moment = moment_sum;
    const Factor<T> share(1.0 / static_cast<double>(k + 1));
    if (forces) {
      force += fixed_N[k];
      if (k == 0) force += forces->follower_S_N;
      auto fixed = cross(s.rotation[0], fixed_N[k]);
      for (std::size_t j = 1; j <= k; ++j) fixed += cross(s.rotation[j], fixed_N[k - j]);
      fixed_N[k + 1] = share * Vector<T, D>(fixed);
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
  using Weight = Factor<typename V::Scalar>;
  V sum = Weight(weights[0]) * c[from];
#pragma GCC unroll 8
  for (std::size_t k = 1; k < count; ++k) sum += Weight(weights[k]) * c[from + k];
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

// At the proximal end.
template <class T, int D>
BasicWrench<T, D> proximal_wrench(const RodSeries<T, D, 7>& s) {
  constexpr std::array<double, 7> ones{1, 1, 1, 1, 1, 1, 1};
  return {weighted(s.force_N, ones), weighted(s.moment_Nmm, ones)};
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
  wrench = proximal_wrench(s);
  return exponential(screw);
}

// Of the part of an arc that ends at its distal end: the strain's series, by that of the whole. The wrench's is not
// set.
template <bool with_shear, class T, int D>
RodSeries<T, D, 7> strain_of_part(const RodSeries<double, D, 7>& whole, const T& part) {
  RodSeries<T, D, 7> own;
  T power = part;
  for (std::size_t k = 0; k < whole.rotation.size(); ++k, power = power * part) {
    own.rotation[k] = power * as<T>(whole.rotation[k]);
    if (with_shear || k == 0) own.translation_mm[k] = power * as<T>(whole.translation_mm[k]);
  }
  return own;
}

// Its step, which takes the wrench from there to the proximal end.
template <bool with_shear, class T, int D>
BasicMotion<T, D> part_step(const RodSeries<double, D, 7>& whole, const T& part, bool distributed,
                            BasicWrench<T, D>& wrench) {
  RodSeries<T, D, 7> own = strain_of_part<with_shear>(whole, part);
  const BasicMotion<T, D> motion = exponential(magnus<with_shear>(own));
  if (!distributed) {
    wrench = transport(motion, wrench);
    return motion;
  }
  T power = 1;
  for (std::size_t k = 0; k < whole.rotation.size(); ++k, power = power * part) {
    own.force_N[k] = power * as<T>(whole.force_N[k]);
    own.moment_Nmm[k] = power * as<T>(whole.moment_Nmm[k]);
  }
  wrench = proximal_wrench(own);
  return motion;
}

}  // namespace fam
