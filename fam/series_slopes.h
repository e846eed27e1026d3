// The sixth-order step (fam/arc_series.h), differentiated: the slopes of its series obey the recursion's own product
// rule, those of the Magnus expansion the brackets'.
#pragma once

#include "fam/arc_series.h"
#include "fam/section_slopes.h"

namespace fam {

// a += b x c, slopes of a vector product: of the second factor, or of the first (a -= c x b then).
template <int N>
void add_cross(Slopes3<N>& a, const Vector3d& b, const Slopes3<N>& c) {
  a.row(0) += b[1] * c.row(2) - b[2] * c.row(1);
  a.row(1) += b[2] * c.row(0) - b[0] * c.row(2);
  a.row(2) += b[0] * c.row(1) - b[1] * c.row(0);
}
template <int N>
Slopes3<N> cross(const Vector3d& a, const Slopes3<N>& b) {
  Slopes3<N> result;
  result.row(0) = a[1] * b.row(2) - a[2] * b.row(1);
  result.row(1) = a[2] * b.row(0) - a[0] * b.row(2);
  result.row(2) = a[0] * b.row(1) - a[1] * b.row(0);
  return result;
}

// A screw's slopes, and those of a bracket.
template <int N>
struct ScrewSlopes {
  Slopes3<N> rotation, translation;
};
template <int N>
ScrewSlopes<N> operator+(const ScrewSlopes<N>& a, const ScrewSlopes<N>& b) {
  return {a.rotation + b.rotation, a.translation + b.translation};
}
template <int N>
ScrewSlopes<N> operator*(double factor, const ScrewSlopes<N>& a) {
  return {factor * a.rotation, factor * a.translation};
}
template <int N>
ScrewSlopes<N> bracket_slopes(const Screw& a, const ScrewSlopes<N>& da, const Screw& b, const ScrewSlopes<N>& db) {
  ScrewSlopes<N> result{cross<N>(a.rotation, db.rotation), cross<N>(a.rotation, db.translation)};
  add_cross<N>(result.rotation, -b.rotation, da.rotation);
  add_cross<N>(result.translation, -b.translation_mm, da.rotation);
  add_cross<N>(result.translation, -b.rotation, da.translation);
  add_cross<N>(result.translation, a.translation_mm, db.rotation);
  return result;
}

template <int N, std::size_t terms>
struct SeriesSlopes {
  std::array<Slopes3<N>, terms> rotation, moment_Nmm, translation_mm, force_N;
};

template <bool with_shear, int N, std::size_t terms>
SeriesSlopes<N, terms> series_slopes(const RodSeries<double, 3, terms>& s,
                                     const SectionSlopes<with_shear, terms>& section,
                                     const ArcForces<double, 3>* forces, const ArcChange<N>& change) {
  SeriesSlopes<N, terms> d;
  std::array<Slopes3<N>, terms> fixed, felt_moment, felt_force;  // felt: with what a constant's change is worth
  std::array<Vector3d, terms> fixed_N;
  const bool constant = change.constant != Constant::none;
  const auto set_strain = [&](std::size_t k) {
    if (!constant) return section.strain(k, d.moment_Nmm, d.force_N, d.rotation[k], d.translation_mm[k]);
    felt_moment[k] = d.moment_Nmm[k];
    felt_force[k] = d.force_N[k];
    section.add_constant(change, k, felt_moment[k], felt_force[k]);
    section.strain(k, felt_moment, felt_force, d.rotation[k], d.translation_mm[k]);
  };
  d.force_N[0] = change.force_N;
  d.moment_Nmm[0] = change.moment_Nmm;
  set_strain(0);
  if (forces) {
    fixed_N[0] = forces->fixed_D_N;
    fixed[0] = change.fixed_D_N;
  }
  for (std::size_t k = 0; k + 1 < terms; ++k) {
    Slopes3<N> force = Slopes3<N>::Zero(), moment = Slopes3<N>::Zero();
    for (std::size_t j = 0; j <= k; ++j) {
      const std::size_t i = k - j;
      add_cross<N>(force, s.rotation[i], d.force_N[j]);
      add_cross<N>(force, -s.force_N[i], d.rotation[j]);
      add_cross<N>(moment, s.rotation[i], d.moment_Nmm[j]);
      add_cross<N>(moment, -s.moment_Nmm[i], d.rotation[j]);
      if constexpr (with_shear) {
        add_cross<N>(moment, s.translation_mm[i], d.force_N[j]);
        add_cross<N>(moment, -s.force_N[i], d.translation_mm[j]);
      }
    }
    if constexpr (!with_shear) add_cross<N>(moment, s.translation_mm[0], d.force_N[k]);
    const double share = 1.0 / static_cast<double>(k + 1);
    if (forces) {
      force += fixed[k];
      if (k == 0) force += change.follower_S_N;
      fixed_N[k + 1].setZero();
      fixed[k + 1].setZero();
      for (std::size_t j = 0; j <= k; ++j) {
        fixed_N[k + 1] += share * s.rotation[j].cross(fixed_N[k - j]);
        add_cross<N>(fixed[k + 1], share * s.rotation[k - j], fixed[j]);
        add_cross<N>(fixed[k + 1], -share * fixed_N[k - j], d.rotation[j]);
      }
    }
    d.force_N[k + 1] = share * force;
    d.moment_Nmm[k + 1] = share * moment;
    set_strain(k + 1);
  }
  return d;
}

// Slopes of magnus().
template <bool with_shear, int N, std::size_t terms>
ScrewSlopes<N> magnus_slopes(const RodSeries<double, 3, terms>& s, const SeriesSlopes<N, terms>& d) {
  const Slopes3<N> zero = Slopes3<N>::Zero();
  Screw a1{weighted(s.rotation, a1_weights), s.translation_mm[0]};
  Screw a2{weighted(s.rotation, a2_weights, 1), Vector3d::Zero()},
      a3{weighted(s.rotation, a3_weights, 2), Vector3d::Zero()};
  ScrewSlopes<N> di{weighted(d.rotation, strain_weights), zero}, d1{weighted(d.rotation, a1_weights), zero},
      d2{weighted(d.rotation, a2_weights, 1), zero}, d3{weighted(d.rotation, a3_weights, 2), zero};
  if constexpr (with_shear) {
    a1.translation_mm = weighted(s.translation_mm, a1_weights);
    a2.translation_mm = weighted(s.translation_mm, a2_weights, 1);
    a3.translation_mm = weighted(s.translation_mm, a3_weights, 2);
    di.translation = weighted(d.translation_mm, strain_weights);
    d1.translation = weighted(d.translation_mm, a1_weights);
    d2.translation = weighted(d.translation_mm, a2_weights, 1);
    d3.translation = weighted(d.translation_mm, a3_weights, 2);
  }
  const Screw b = bracket(a1, a2);
  const ScrewSlopes<N> db = bracket_slopes(a1, d1, a2, d2);
  const Screw inner = (1 / 360.) * a3 + (-1 / 720.) * b, middle = bracket(a1, inner);
  const ScrewSlopes<N> d_inner = (1 / 360.) * d3 + (-1 / 720.) * db, d_middle = bracket_slopes(a1, d1, inner, d_inner);
  return di + (1 / 12.) * db + bracket_slopes(a1, d1, middle, d_middle) +
         bracket_slopes(a2, d2, (-1 / 240.) * (a3 + b), (-1 / 240.) * (d3 + db));
}

}  // namespace fam
