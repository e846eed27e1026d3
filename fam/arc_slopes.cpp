#include "fam/arc_slopes.h"

#include "fam/arc_law.h"
#include "fam/dual.h"
#include "fam/motion_slopes.h"
#include "fam/series_slopes.h"
#include "fam/wide_step.h"

namespace fam {
namespace {

struct StrainChange {
  Matrix3d rotation, translation;
};

// The change of the strain (times h) by that of the wrench and of a constant.
template <bool with_shear>
StrainChange strain_change(const BasicArcConstants<3>& arc, const Screw& strain, Matrix3d force, Matrix3d moment,
                           Constant constant, const TendonArms& tendon_arms) {
  const std::array<Vector3d, 1> rotation{strain.rotation}, translation{strain.translation_mm};
  const SectionSlopes<with_shear, 1> section(arc, rotation, translation);
  if (constant != Constant::none) {
    const ConstantSeries<1> worth = section.constant_series(constant, tendon_arms);
    force += worth.force[0];
    moment += worth.moment[0];
  }
  StrainChange result{arc.angular_compliance.asDiagonal() * moment, arc.linear_compliance.asDiagonal() * force};
  if (!arc.tendons.empty()) {
    const auto& A = section.compliance();
    result.rotation = A.template topLeftCorner<3, 3>() * moment;
    if constexpr (with_shear) {
      result.rotation += A.template topRightCorner<3, 3>() * force;
      result.translation = A.template bottomLeftCorner<3, 3>() * moment + A.template bottomRightCorner<3, 3>() * force;
    }
  }
  if constexpr (!with_shear) result.translation.setZero();
  return result;
}

using Number = Dual<3>;

template <class Slopes>
Vector3<Number> with_slopes(const Vector3d& value, const Slopes& slopes) {
  Vector3<Number> result;
  for (int i = 0; i < 3; ++i) result[i] = {value[i], slopes.row(i).transpose().array()};
  return result;
}
Vector3d value(const Vector3<Number>& v) {
  return {v[0].value, v[1].value, v[2].value};
}
Matrix3d slopes_of(const Vector3<Number>& v) {
  Matrix3d slopes;
  for (int i = 0; i < 3; ++i) slopes.row(i) = v[i].slope.matrix().transpose();
  return slopes;
}

// For the laws that ask a section for nothing but its strain under a wrench.
template <bool with_shear>
struct DualSection {
  const BasicArcConstants<3>& arc;
  Constant constant;
  const TendonArms& tendon_arms;

  BasicScrew<Number, 3> strain(const BasicWrench<Number, 3>& wrench) const {
    const Screw screw = strain_under<with_shear, 3>(arc, {value(wrench.force_N), value(wrench.moment_Nmm)});
    const StrainChange change = strain_change<with_shear>(arc, screw, slopes_of(wrench.force_N),
                                                          slopes_of(wrench.moment_Nmm), constant, tendon_arms);
    return {with_slopes(screw.rotation, change.rotation), with_slopes(screw.translation_mm, change.translation)};
  }
};

template <class V, int D, class T, int N>
void set_motion(const MotionSlopes<D, T>& motion, const ScrewChanges<V>& screw, int first, ArcVariation<N>& result) {
  set_columns(motion.turn(screw), first, result.slopes.template topRows<3>());
  set_columns(motion.way(screw), first, result.slopes.template middleRows<3>(3));
}
template <class V, int D, class T, int N>
void set_gain(const MotionSlopes<D, T>& motion, const Changes3<V>& force, const Changes3<V>& moment,
              const ArcChange<N>& change, int first, ArcVariation<N>& result) {
  const Changes3<V> turn = columns<V>(result.slopes.template topRows<3>(), first);
  const Changes3<V> way = columns<V>(result.slopes.template middleRows<3>(3), first);
  const Changes3<V> carried = motion.carried_force(force, turn);
  set_columns(carried + -1.0 * columns<V>(change.force_N, first), first, result.slopes.template middleRows<3>(6));
  set_columns(motion.carried_moment(moment, carried, turn, way) + -1.0 * columns<V>(change.moment_Nmm, first), first,
              result.slopes.template bottomRows<3>());
}

// Three changes at a time, by dual numbers.
template <bool with_shear, int N>
ArcVariation<N> vary_by_numbers(Law law, const BasicArcConstants<3>& arc, const ArcForces<double, 3>* forces,
                                const SectionWrench& wrench, const ArcChange<N>& change) {
  ArcVariation<N> result;
  result.slopes.setZero();
  for (int at = 0; at < N; at += 3) {
    const int three = std::min(at, N - 3);
    const DualSection<with_shear> section{arc, three == N - 3 ? change.constant : Constant::none, change.tendon_arms};
    const auto varied = [three](const Vector3d& v, const Slopes3<N>& slopes) {
      return with_slopes(v, slopes.template middleCols<3>(three));
    };
    BasicWrench<Number, 3> w{varied(wrench.force_N, change.force_N), varied(wrench.moment_Nmm, change.moment_Nmm)};
    ArcForces<Number, 3> along;
    if (forces)
      along = {varied(forces->follower_S_N, change.follower_S_N), varied(forces->fixed_D_N, change.fixed_D_N)};
    BasicScrew<Number, 3> screw;
    if (law == Law::midpoint) midpoint_step(section, forces ? &along : nullptr, w, screw);
    else fourth_order_step(section, forces ? &along : nullptr, w, screw);

    MotionSlopes<3> motion({value(screw.rotation), value(screw.translation_mm)});
    motion.meet({value(w.force_N), value(w.moment_Nmm)});
    ArcVariation<3> part;
    const ArcChange<3> part_change{change.force_N.template middleCols<3>(three),
                                   change.moment_Nmm.template middleCols<3>(three)};
    const Matrix3d rotation = slopes_of(screw.rotation), translation = slopes_of(screw.translation_mm);
    const Matrix3d force = slopes_of(w.force_N), moment = slopes_of(w.moment_Nmm);
    for (int first = 0; first < 3; first += 2) {
      set_motion<Pair>(motion, {columns<Pair>(rotation, first), columns<Pair>(translation, first)}, first, part);
      if (forces) set_gain(motion, columns<Pair>(force, first), columns<Pair>(moment, first), part_change, first, part);
    }
    if (!forces) part.slopes.template bottomRows<6>().setZero();
    result.slopes.template middleCols<3>(three) = part.slopes;
    result.motion = motion.motion();
    result.way_D_mm = motion.way_mm();
    if (forces) result.gain_D = motion.gain(wrench);
  }
  return result;
}

// `s`: the arc's series, seven terms with distributed forces. V: changes at a time.
template <class V, bool with_shear, class T, std::size_t terms, int D, int N>
ArcVariation<N> vary_by_series(const BasicArcConstants<3>& arc, const ArcForces<double, D>* forces,
                               const RodSeries<T, D, terms>& s, const SectionWrench& wrench,
                               const ArcChange<N>& change) {
  const SeriesSlopes<V, with_shear, terms, D> slopes(arc, s, forces);
  std::optional<ConstantSeries<terms>> constant;
  if constexpr (D == 3) {
    if (change.constant != Constant::none) constant = slopes.constant_series(change.constant, change.tendon_arms);
  }
  MotionSlopes<D, T> motion(magnus<with_shear>(s));
  ArcVariation<N> result{motion.motion(), motion.way_mm(), {}, {}};
  if constexpr (terms == 7) {
    motion.meet(proximal_wrench(s));
    result.gain_D = motion.gain(wrench);
  } else {
    result.slopes.template bottomRows<6>().setZero();
  }
  for (int first = 0; first < N; first += width<V>) {
    const auto by = slopes.changes(change, constant ? &*constant : nullptr, first);
    set_motion(motion, by.screw, first, result);
    if constexpr (terms == 7) set_gain(motion, by.force, by.moment, change, first, result);
  }
  return result;
}

template <bool with_shear, std::size_t terms, int D, int N>
ArcVariation<N> vary_on([[maybe_unused]] VectorUnit unit, const BasicArcConstants<3>& arc,
                        const ArcForces<double, D>* forces, const RodSeries<double, D, terms>& s,
                        const SectionWrench& wrench, const ArcChange<N>& change) {
#ifdef FAM_HAS_AVX2_UNIT
  if (unit == VectorUnit::avx2) {
    return call_by_avx2([&] {
      if constexpr (D == 2) return vary_by_series<Quad, with_shear>(arc, forces, s, wrench, change);
      else return vary_by_series<Quad, with_shear>(arc, forces, wide<with_shear>(s), wrench, change);
    });
  }
#endif
  return vary_by_series<Pair, with_shear>(arc, forces, s, wrench, change);
}

template <bool with_shear, int N>
ArcVariation<N> vary(Law law, const BasicArcConstants<3>& arc, const ArcForces<double, 3>* forces,
                     const SectionWrench& wrench, const ArcChange<N>& change, VectorUnit unit) {
  if (law != Law::sixth_order) return vary_by_numbers<with_shear>(law, arc, forces, wrench, change);
  const auto by_series = [&]<std::size_t terms>() {
    return vary_on<with_shear>(unit, arc, forces, series_of<with_shear, terms>(arc, forces, wrench), wrench, change);
  };
  if constexpr (N == 3) return forces ? by_series.template operator()<7>() : by_series.template operator()<6>();
  else return by_series.template operator() < N == 6 ? 6 : 7 > ();
}

// Of an arc in the x-y plane the changes that stay in it (turns and moments about z, ways and forces along x and y) and
// those that leave it do not mix: a force and a moment along the same axis, one of each, take one column together. Here
// the columns are told apart, each answer having its half.
void tell_apart(const Matrix3d& together, bool of_turns, Eigen::Ref<Matrix3d> by_force,
                Eigen::Ref<Matrix3d> by_moment) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const bool crosses = (row == 2) != (column == 2);
      by_force(row, column) = crosses == of_turns ? together(row, column) : 0;
      by_moment(row, column) = crosses == of_turns ? 0 : together(row, column);
    }
  }
}

template <int columns>
const ArcChange<columns>& changes_together() {
  static const ArcChange<columns> changes = [] {
    ArcChange<columns> change;
    change.force_N.template leftCols<3>().setIdentity();
    change.moment_Nmm.template leftCols<3>().setIdentity();
    if constexpr (columns == 6) change.fixed_D_N.template rightCols<3>().setIdentity();
    return change;
  }();
  return changes;
}

BasicArcConstants<2> in_plane(const BasicArcConstants<3>& arc) {
  return {arc.length_mm,
          angular_part<2>(arc.angular_compliance),
          angular_part<2>(arc.rest_rotation),
          linear_part<2>(arc.linear_compliance),
          linear_part<2>(arc.rest_translation_mm),
          {},
          false};
}

template <bool with_shear, int N>
ArcVariation<N> vary_planar(const BasicArcConstants<3>& arc, const ArcForces<double, 3>* forces,
                            const SectionWrench& wrench, VectorUnit unit) {
  constexpr std::size_t terms = N == 9 ? 7 : 6;
  ArcForces<double, 2> along;
  if (forces) along = {linear_part<2>(forces->follower_S_N), linear_part<2>(forces->fixed_D_N)};
  const ArcForces<double, 2>* planar_forces = forces ? &along : nullptr;
  const BasicWrench<double, 2> planar_wrench{linear_part<2>(wrench.force_N), angular_part<2>(wrench.moment_Nmm)};
  const ArcVariation<N - 3> together = vary_on<with_shear>(
      unit, arc, planar_forces, series_of<with_shear, terms>(in_plane(arc), planar_forces, planar_wrench), wrench,
      changes_together<N - 3>());
  ArcVariation<N> result{together.motion, together.way_D_mm, together.gain_D, {}};
  for (int row = 0; row < 12; row += 3) {
    tell_apart(together.slopes.template block<3, 3>(row, 0), row == 0 || row == 9,
               result.slopes.template block<3, 3>(row, 0), result.slopes.template block<3, 3>(row, 3));
  }
  if constexpr (N == 9) result.slopes.template rightCols<3>() = together.slopes.template rightCols<3>();
  return result;
}

template <bool with_shear>
StrainVariation vary_section(const BasicArcConstants<3>& arc, const SectionWrench& wrench, const ArcChange<3>& change) {
  StrainVariation result;
  result.strain = strain_under<with_shear>(arc, wrench);
  result.pulls = tendon_pulls(arc.tendons, result.strain);
  const StrainChange slopes = strain_change<with_shear>(arc, result.strain, change.force_N, change.moment_Nmm,
                                                        change.constant, change.tendon_arms);
  result.strain_slopes << slopes.rotation, slopes.translation;

  const std::array<Vector3d, 1> rotation{result.strain.rotation}, translation{result.strain.translation_mm};
  const SectionSlopes<true, 1> section(arc, rotation, translation);
  result.pull_slopes.setZero();
  if (!arc.tendons.empty()) {
    const Eigen::Matrix<double, 6, 3> by_strain = section.tendon_stiffness() * result.strain_slopes;
    result.pull_slopes << by_strain.bottomRows<3>(), by_strain.topRows<3>();
  }
  if (change.constant == Constant::tension) {
    const ConstantSeries<1> worth = section.constant_series(change.constant, change.tendon_arms);
    result.pull_slopes.topRows<3>() -= worth.force[0];
    result.pull_slopes.bottomRows<3>() -= worth.moment[0];
  }
  return result;
}

}  // namespace

template <int N>
ArcVariation<N> vary_arc(Law law, scene::RodModel model, const BasicArcConstants<3>& arc,
                         const ArcForces<double, 3>* distributed, const SectionWrench& wrench,
                         const ArcChange<N>& change, VectorUnit unit) {
  if (model == scene::RodModel::reissner) return vary<true, N>(law, arc, distributed, wrench, change, unit);
  return vary<false, N>(law, arc, distributed, wrench, change, unit);
}

StrainVariation vary_strain(scene::RodModel model, const BasicArcConstants<3>& arc, const SectionWrench& wrench,
                            const ArcChange<3>& change) {
  return model == scene::RodModel::reissner ? vary_section<true>(arc, wrench, change)
                                            : vary_section<false>(arc, wrench, change);
}

template <int N>
ArcVariation<N> vary_planar_arc(scene::RodModel model, const BasicArcConstants<3>& arc,
                                const ArcForces<double, 3>* distributed, const SectionWrench& wrench, VectorUnit unit) {
  if (model == scene::RodModel::reissner) return vary_planar<true, N>(arc, distributed, wrench, unit);
  return vary_planar<false, N>(arc, distributed, wrench, unit);
}

template ArcVariation<3> vary_arc(Law, scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                  const SectionWrench&, const ArcChange<3>&, VectorUnit);
template ArcVariation<6> vary_arc(Law, scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                  const SectionWrench&, const ArcChange<6>&, VectorUnit);
template ArcVariation<8> vary_arc(Law, scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                  const SectionWrench&, const ArcChange<8>&, VectorUnit);
template ArcVariation<12> vary_arc(Law, scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                   const SectionWrench&, const ArcChange<12>&, VectorUnit);
template ArcVariation<9> vary_arc(Law, scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                  const SectionWrench&, const ArcChange<9>&, VectorUnit);
template ArcVariation<6> vary_planar_arc(scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                         const SectionWrench&, VectorUnit);
template ArcVariation<9> vary_planar_arc(scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                         const SectionWrench&, VectorUnit);

}  // namespace fam
