// The sixth-order step (fam/arc_series.h), differentiated: the slopes of its series obey the recursion's own product
// rule, those of the Magnus expansion the brackets'.
#pragma once

#include "fam/arc_series.h"
#include "fam/changes.h"
#include "fam/section_slopes.h"

namespace fam {

template <class V, class T, int D>
[[gnu::always_inline]] inline ScrewChanges<V> bracket(const BasicScrew<T, D>& a, const ScrewChanges<V>& da,
                                                      const BasicScrew<T, D>& b, const ScrewChanges<V>& db) {
  return {cross(da.rotation, b.rotation) + cross(a.rotation, db.rotation),
          cross(da.rotation, b.translation_mm) + cross(a.rotation, db.translation) + cross(da.translation, b.rotation) +
              cross(a.translation_mm, db.rotation)};
}

// An arc's series, and what the slopes ask of it more than once. In the plane (D = 2) the arc lies there, its changes
// need not: `arc` is the section in space all the same, without tendons. V: changes at a time (fam/changes.h).
template <class V, bool with_shear, std::size_t terms, int D>
class SeriesSlopes {
 public:
  using Number = NumberBeside<V, D>;
  using Series = RodSeries<Number, D, terms>;

  SeriesSlopes(const BasicArcConstants<3>& arc, const Series& series, const ArcForces<double, D>* forces)
      : arc_(arc), s_(series), section_(arc, series.rotation, series.translation_mm), forces_(forces) {
    if (forces) {
      fixed_N_[0] = as<Number>(forces->fixed_D_N);
      for (std::size_t k = 0; k + 1 < terms; ++k) {
        auto sum = fam::cross(s_.rotation[0], fixed_N_[k]);
        for (std::size_t j = 1; j <= k; ++j) sum += fam::cross(s_.rotation[j], fixed_N_[k - j]);
        fixed_N_[k + 1] = Number(1.0 / static_cast<double>(k + 1)) * Vector<Number, D>(sum);
      }
    }
    a1_ = {weighted(s_.rotation, a1_weights), s_.translation_mm[0]};
    a2_.rotation = weighted(s_.rotation, a2_weights, 1);
    a3_.rotation = weighted(s_.rotation, a3_weights, 2);
    if constexpr (with_shear) {
      a1_.translation_mm = weighted(s_.translation_mm, a1_weights);
      a2_.translation_mm = weighted(s_.translation_mm, a2_weights, 1);
      a3_.translation_mm = weighted(s_.translation_mm, a3_weights, 2);
    }
    const BasicScrew<Number, D> b = fam::bracket(a1_, a2_);
    inner_ = (1 / 360.) * a3_ + (-1 / 720.) * b;
    outer_ = (-1 / 240.) * (a3_ + b);
    middle_ = fam::bracket(a1_, inner_);
  }

  // Slopes of the screw; with distributed forces of the wrench at the proximal end. `constant`: null, or what the last
  // three changes' constant is worth.
  struct Slopes {
    ScrewChanges<V> screw;
    Changes3<V> force, moment;
  };
  template <int N>
  Slopes changes(const ArcChange<N>& change, const ConstantSeries<terms>* constant, int first) const {
    if (first + width<V> <= N - 3) constant = nullptr;
    const int of_constant = first - (N - 3);
    Terms d;
    d.force[0] = columns<V>(change.force_N, first);
    d.moment[0] = columns<V>(change.moment_Nmm, first);
    if (forces_) d.fixed[0] = columns<V>(change.fixed_D_N, first);
    set_strain(d, constant, of_constant, 0);
    for (std::size_t k = 0; k + 1 < terms; ++k) {
      advance(d, k);
      if (forces_ && k == 0) d.force[1] += columns<V>(change.follower_S_N, first);
      set_strain(d, constant, of_constant, k + 1);
    }
    Slopes slopes{magnus(d), {}, {}};
    if (forces_) {
      slopes.force = d.force[0];
      slopes.moment = d.moment[0];
      for (std::size_t k = 1; k < terms; ++k) slopes.force += d.force[k], slopes.moment += d.moment[k];
    }
    return slopes;
  }

  ConstantSeries<terms> constant_series(Constant constant, const TendonArms& tendon_arms) const {
    return section_.constant_series(constant, tendon_arms);
  }

 private:
  struct Terms {
    std::array<Changes3<V>, terms> rotation, translation, force, moment, fixed;
    std::array<std::array<Changes3<V>, terms>, D == 3 && with_shear ? scene::max_tendon_offsets : 0>
        tendons;  // t h, as far as there are
  };

  // The strain under the wrench and what a changed constant is worth.
  [[gnu::always_inline]] void set_strain(Terms& d, const ConstantSeries<terms>* constant, int first,
                                         std::size_t k) const {
    Changes3<V> force = d.force[k], moment = d.moment[k];
    if (constant) force += columns<V>(constant->force[k], first), moment += columns<V>(constant->moment[k], first);
    if constexpr (D == 3) {
      if (!arc_.tendons.empty()) return set_tendon_strain(d, force, moment, k);
    }
    const Vector3d &c = arc_.angular_compliance, &l = arc_.linear_compliance;
    d.rotation[k] = {c[0] * moment.x, c[1] * moment.y, c[2] * moment.z};
    if constexpr (with_shear) d.translation[k] = {l[0] * force.x, l[1] * force.y, l[2] * force.z};
  }
  void set_tendon_strain(Terms& d, Changes3<V> force, Changes3<V> moment, std::size_t k) const {
    const auto tendons = section_.tendons();
    if constexpr (!with_shear) {
      for (std::size_t j = 1; j <= k; ++j) moment += -1.0 * product(section_.turn_stiffness()[j], d.rotation[k - j]);
    }
    for (std::size_t i = 0; with_shear && k > 0 && i < tendons.size(); ++i) {
      Changes3<V> pull = product(tendons[i].across[1], d.tendons[i][k - 1]);
      for (std::size_t j = 2; j <= k; ++j) pull += product(tendons[i].across[j], d.tendons[i][k - j]);
      moment += cross(pull, tendons[i].arm_mm);
      force += -1.0 * pull;
    }
    const auto& A = section_.compliance();
    d.rotation[k] = product(A.template topLeftCorner<3, 3>(), moment);
    if constexpr (with_shear) {
      d.rotation[k] += product(A.template topRightCorner<3, 3>(), force);
      d.translation[k] = product(A.template bottomLeftCorner<3, 3>(), moment);
      d.translation[k] += product(A.template bottomRightCorner<3, 3>(), force);
      for (std::size_t i = 0; i < tendons.size(); ++i)
        d.tendons[i][k] = cross(d.rotation[k], tendons[i].arm_mm) + d.translation[k];
    }
  }

  // Coefficient k + 1 of the wrench and the fixed force, the strain's k-th being known.
  void advance(Terms& d, std::size_t k) const {
    Changes3<V> force{}, moment{}, fixed{};
    for (std::size_t j = 0; j <= k; ++j) {
      const std::size_t i = k - j;
      force += cross(s_.rotation[i], d.force[j]) + cross(d.rotation[j], s_.force_N[i]);
      moment += cross(s_.rotation[i], d.moment[j]) + cross(d.rotation[j], s_.moment_Nmm[i]);
      if constexpr (with_shear) {
        moment += cross(s_.translation_mm[i], d.force[j]) + cross(d.translation[j], s_.force_N[i]);
      }
      if (forces_) fixed += cross(s_.rotation[i], d.fixed[j]) + cross(d.rotation[j], fixed_N_[i]);
    }
    if constexpr (!with_shear) moment += cross(s_.translation_mm[0], d.force[k]);
    const double share = 1.0 / static_cast<double>(k + 1);
    if (forces_) {
      force += d.fixed[k];
      d.fixed[k + 1] = share * fixed;
    }
    d.force[k + 1] = share * force;
    d.moment[k + 1] = share * moment;
  }

  template <std::size_t count>
  static Changes3<V> sum(const std::array<Changes3<V>, terms>& c, const std::array<double, count>& weights,
                         std::size_t from = 0) {
    Changes3<V> result = weights[0] * c[from];
    for (std::size_t k = 1; k < count; ++k) result += weights[k] * c[from + k];
    return result;
  }

  ScrewChanges<V> magnus(const Terms& d) const {
    ScrewChanges<V> whole{sum(d.rotation, strain_weights), {}}, d1{sum(d.rotation, a1_weights), {}},
        d2{sum(d.rotation, a2_weights, 1), {}}, d3{sum(d.rotation, a3_weights, 2), {}};
    if constexpr (with_shear) {
      whole.translation = sum(d.translation, strain_weights);
      d1.translation = sum(d.translation, a1_weights);
      d2.translation = sum(d.translation, a2_weights, 1);
      d3.translation = sum(d.translation, a3_weights, 2);
    }
    const ScrewChanges<V> b = bracket(a1_, d1, a2_, d2);
    const ScrewChanges<V> middle = bracket(a1_, d1, inner_, (1 / 360.) * d3 + (-1 / 720.) * b);
    return whole + (1 / 12.) * b + bracket(a1_, d1, middle_, middle) + bracket(a2_, d2, outer_, (-1 / 240.) * (d3 + b));
  }

  struct NoTendons {
    NoTendons(const auto&, const auto&, const auto&) {}
  };
  const BasicArcConstants<3>& arc_;
  const Series& s_;
  std::conditional_t<D == 3, SectionSlopes<with_shear, terms, Number>, NoTendons> section_;
  const ArcForces<double, D>* forces_;
  std::array<Vector<Number, D>, terms> fixed_N_;
  BasicScrew<Number, D> a1_, a2_, a3_, inner_, outer_, middle_;
};

}  // namespace fam
