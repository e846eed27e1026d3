#include "fam/varied_march.h"

#include "fam/skew.h"
#include "fam/vector_unit.h"

namespace fam {
namespace {

template <int N>
SectionState<2, Dual<N>> with_slopes(const SectionState<2>& state, const Fields<2, N>& fields) {
  SectionState<2, Dual<N>> varied;
  const auto slope = [](const auto& row) { return typename Dual<N>::Slope(row.transpose().array()); };
  for (int i = 0; i < 2; ++i) {
    for (int axis = 0; axis < 2; ++axis) {  // turning the section turns the base axes in it back
      const double back = i == 0 ? state.rotation_SB(1, axis) : -state.rotation_SB(0, axis);
      varied.rotation_SB(i, axis) = {state.rotation_SB(i, axis), slope(back * fields.turn.row(0))};
    }
    varied.wrench.force_N[i] = {state.wrench.force_N[i], slope(fields.force_N.row(i))};
  }
  varied.wrench.moment_Nmm[0] = {state.wrench.moment_Nmm[0], slope(fields.moment_Nmm.row(0))};
  return varied;
}

// The moments of fixed forces' arms on a section, 2 sine_vector(arms_S), by a small turn of it.
Matrix3d arms_slope(const Matrix3d& arms_S) {
  return arms_S - arms_S.trace() * Matrix3d::Identity();
}

// The arc's slopes (ArcVariation) in the directions of the fields.
template <int N>
struct ArcFields {
  RigidMotion motion;
  Vector3d way_D_mm;
  SectionWrench gain_D;
  Eigen::Matrix<double, 12, N> slopes;
};

template <int N, int M>
ArcFields<N> combined(const ArcVariation<M>& by_unit, const Eigen::Matrix<double, M, N>& met) {
  ArcFields<N> result{by_unit.motion, by_unit.way_D_mm, by_unit.gain_D, {}};
  if constexpr (M == 6) {
    call_on(widest_unit(), [&] {
      result.slopes.template topRows<6>().noalias() = by_unit.slopes.template topRows<6>().lazyProduct(met);
    });
  } else {
    call_on(widest_unit(), [&] { result.slopes.noalias() = by_unit.slopes.lazyProduct(met); });
  }
  return result;
}

// Wrench and fields from the arc's distal end to its proximal one.
template <int N>
void carry(const ArcFields<N>& arc, bool distributed, SectionState<3>& state, Fields<3, N>& fields) {
  // In the distal frame: the wrench about the distal end, then about the proximal one; then all into that one's frame.
  const auto turn = arc.slopes.template topRows<3>(), way = arc.slopes.template middleRows<3>(3);
  SectionWrench wrench = state.wrench;
  if (distributed) {
    wrench = wrench + arc.gain_D;
    fields.force_N += arc.slopes.template middleRows<3>(6);
    fields.moment_Nmm += arc.slopes.template bottomRows<3>();
  }
  const Matrix3d force = skew(wrench.force_N);
  wrench.moment_Nmm += arc.way_D_mm.cross(wrench.force_N);
  fields.moment_Nmm += skew(arc.way_D_mm) * fields.force_N - force * way;
  fields.moment_Nmm -= skew(wrench.moment_Nmm) * turn;
  fields.force_N -= force * turn;
  fields.turn -= turn;
  const auto rotate = [&motion = arc.motion](auto& matrix) {
    for (int column = 0; column < matrix.cols(); ++column) matrix.col(column) = motion.rotate(matrix.col(column));
  };
  rotate(fields.turn);
  rotate(fields.force_N);
  rotate(fields.moment_Nmm);
  rotate(state.rotation_SB);
  state.wrench = {arc.motion.rotate(wrench.force_N), arc.motion.rotate(wrench.moment_Nmm)};
}

}  // namespace

template <int N>
void march_varied(const LoadedRod<2>& rod, ArcRange arcs, SectionState<2>& state, Fields<2, N>& fields) {
  SectionState<2, Dual<N>> varied = with_slopes(state, fields);
  rod.march(arcs, varied);
  for (int i = 0; i < 2; ++i) {
    for (int axis = 0; axis < 2; ++axis) state.rotation_SB(i, axis) = varied.rotation_SB(i, axis).value;
    state.wrench.force_N[i] = varied.wrench.force_N[i].value;
    fields.force_N.row(i) = varied.wrench.force_N[i].slope.matrix().transpose();
  }
  // R' = -turn [e_z] R, whose first column gives turn = R(0,0)' R(1,0) - R(1,0)' R(0,0).
  fields.turn.row(0) = (varied.rotation_SB(0, 0).slope * state.rotation_SB(1, 0) -
                        varied.rotation_SB(1, 0).slope * state.rotation_SB(0, 0))
                           .matrix()
                           .transpose();
  state.wrench.moment_Nmm[0] = varied.wrench.moment_Nmm[0].value;
  fields.moment_Nmm.row(0) = varied.wrench.moment_Nmm[0].slope.matrix().transpose();
}

template <int N>
void add_point_loads(const SpanArcs<3>& span, SectionState<3>& state, Fields<3, N>& fields) {
  span.add_point_loads(state.rotation_SB, state.wrench);
  const Matrix3d& R = state.rotation_SB;
  Matrix3d by_turn = skew(R * span.fixed_load_B.moment_Nmm);
  if (!span.fixed_force_arms_BS_Nmm.isZero(0)) by_turn += arms_slope(R * span.fixed_force_arms_BS_Nmm);
  fields.force_N += skew(R * span.fixed_load_B.force_N) * fields.turn;
  fields.moment_Nmm += by_turn * fields.turn;
}

template <int N>
bool vary_step(const LoadedRod<3>& rod, const SpanArcs<3>& span, SectionState<3>& state, Fields<3, N>& fields) {
  const ArcForces<double, 3> forces = span.forces(state.rotation_SB);
  const ArcForces<double, 3>* distributed = span.distributed ? &forces : nullptr;
  const auto vary = [&]<int M>(const ArcChange<M>& change) {
    return vary_arc(rod.law(), rod.model(), span.constants, distributed, state.wrench, change);
  };
  ArcFields<N> arc;
  if constexpr (N == 3) {
    ArcChange<3> change;
    change.force_N = fields.force_N;
    change.moment_Nmm = fields.moment_Nmm;
    if (distributed) change.fixed_D_N = skew(forces.fixed_D_N) * fields.turn;
    const ArcVariation<3> variation = vary(change);
    arc = {variation.motion, variation.way_D_mm, variation.gain_D, variation.slopes};
  } else if (!distributed) {
    Eigen::Matrix<double, 6, N> met;
    met << fields.force_N, fields.moment_Nmm;
    arc = combined(vary(unit_changes<6>()), met);
  } else {
    // A turn changes the force fixed in space across itself alone.
    const Eigen::Matrix<double, 3, 2> across = two_across(forces.fixed_D_N);
    ArcChange<8> change = unit_changes<8>();
    change.fixed_D_N.rightCols<2>() = across;
    Eigen::Matrix<double, 8, N> met;
    met << fields.force_N, fields.moment_Nmm, across.transpose() * skew(forces.fixed_D_N) * fields.turn;
    arc = combined(vary(change), met);
  }
  call_on(widest_unit(), [&] { carry(arc, distributed != nullptr, state, fields); });
  return span.constants.is_elastic() || arc.motion.rotation.allFinite();  // else the strain was not found
}

template void march_varied(const LoadedRod<2>&, ArcRange, SectionState<2>&, Fields<2, 1>&);
template void march_varied(const LoadedRod<2>&, ArcRange, SectionState<2>&, Fields<2, 4>&);
template void add_point_loads(const SpanArcs<3>&, SectionState<3>&, Fields<3, 3>&);
template void add_point_loads(const SpanArcs<3>&, SectionState<3>&, Fields<3, 9>&);
template bool vary_step(const LoadedRod<3>&, const SpanArcs<3>&, SectionState<3>&, Fields<3, 3>&);
template bool vary_step(const LoadedRod<3>&, const SpanArcs<3>&, SectionState<3>&, Fields<3, 9>&);

}  // namespace fam
