// The linear equations of fam/response.h: made arc by arc, and solved for one source.
#include "fam/response.h"
#include "fam/skew.h"

#include <Eigen/LU>

namespace fam {
namespace {

using Columns = Response::Columns;

// How the point loads at a span's end answer a turn of the section there.
Columns turn_stiffness(const scene::Span& span, const Matrix3d& rotation_BS) {
  Columns slopes;
  slopes.topRows<3>() = -skew(rotation_BS * span.follower_load_S.force_N);
  slopes.bottomRows<3>() = -skew(rotation_BS * span.follower_load_S.moment_Nmm);
  const Matrix3d arms = span.fixed_force_arms_BS_Nmm * rotation_BS.transpose();  // sum F (R r)^T
  slopes.bottomRows<3>() += arms.transpose() - arms.trace() * Matrix3d::Identity();
  return slopes;
}

// Blocks of three rows and columns, from a section's frame into the base frame.
template <int rows, int columns>
void to_base(const Matrix3d& rotation_BS, const auto& from, Eigen::Matrix<double, 12, 9>& to) {
  const Matrix3d rotation_SB = rotation_BS.transpose();
  for (int column = 0; column < columns; column += 3) {
    for (int row = 0; row < rows; row += 3) {
      const Matrix3d half = from.template block<3, 3>(row, column) * rotation_SB;
      to.block<3, 3>(row, column).noalias() = rotation_BS * half;
    }
  }
}

// Of a section whose principal axes lie along the plane's, or which has none.
BasicArcConstants<3> turned(const BasicArcConstants<3>& arc, const Matrix3d& rotation_BP) {
  BasicArcConstants<3> result = arc;
  const Matrix3d axes = rotation_BP.transpose().cwiseAbs2();
  result.angular_compliance = axes * arc.angular_compliance;
  result.linear_compliance = axes * arc.linear_compliance;
  result.rest_rotation = rotation_BP.transpose() * arc.rest_rotation;
  return result;
}

Eigen::Matrix<double, 12, 3> turned_rows(const Matrix3d& rotation, const auto& from) {
  Eigen::Matrix<double, 12, 3> result;
  for (int row = 0; row < 12; row += 3) result.middleRows<3>(row) = rotation * from.template middleRows<3>(row);
  return result;
}

// a x b for each column of b.
template <class B>
Matrix3d crossed(const Vector3d& a, const B& b) {
  Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    result(0, i) = a[1] * b(2, i) - a[2] * b(1, i);
    result(1, i) = a[2] * b(0, i) - a[0] * b(2, i);
    result(2, i) = a[0] * b(1, i) - a[1] * b(0, i);
  }
  return result;
}

}  // namespace

void Response::prepare() {
  if (prepared_) return;
  prepared_ = true;
  first_arcs_.assign(1, 0);
  for (const int arcs : solution_.arcs_per_span)
    first_arcs_.push_back(first_arcs_.back() + static_cast<std::size_t>(arcs));
  if (arcs_.size() < first_arcs_.back()) {  // more than were reserved
    arcs_.resize(first_arcs_.back());
    for (Sweep& sweep : sweeps_) sweep.nodes.resize(first_arcs_.back());
  }
  for (std::size_t i = solution_.spans.size(); i-- > 0;) factorise_span(i);
}

void Response::factorise_span(std::size_t i) {
  set_constants(i, arc_length_mm(i));
  planar_ = solution_.rotation_BP && solution_.law == Law::sixth_order && constants_.tendons.empty();
  if (planar_) planar_constants_ = turned(constants_, *solution_.rotation_BP);
  for (std::size_t k = first_arcs_[i + 1]; k-- > first_arcs_[i];) carry(i, k, linearise(i, k));
}

// By the unit changes; in the plane's frame of a planar rod.
template <int N>
ArcVariation<N> Response::vary(const ArcForces<double, 3>* forces, const SectionWrench& wrench) const {
  if (!planar_) return vary_arc(solution_.law, solution_.model, constants_, forces, wrench, unit_changes<N>());
  const Matrix3d rotation_PB = solution_.rotation_BP->transpose();
  ArcForces<double, 3> turned;
  if (forces) turned = {rotation_PB * forces->follower_S_N, rotation_PB * forces->fixed_D_N};
  return vary_planar_arc<N>(solution_.model, planar_constants_, forces ? &turned : nullptr,
                            {rotation_PB * wrench.force_N, rotation_PB * wrench.moment_Nmm});
}

// The same with distributed forces, of these two changes: those across itself that turns make of a fixed one.
ArcVariation<9> Response::vary_by_turns(const ArcForces<double, 3>& forces, const SectionWrench& wrench) const {
  const Eigen::Matrix<double, 3, 2> across = two_across(forces.fixed_D_N);
  ArcChange<8> change = unit_changes<8>();
  change.fixed_D_N.rightCols<2>() = across;
  const ArcVariation<8> by = vary_arc(solution_.law, solution_.model, constants_, &forces, wrench, change);
  ArcVariation<9> result{by.motion, by.way_D_mm, by.gain_D, {}};
  result.slopes << by.slopes.leftCols<6>(), by.slopes.rightCols<2>() * across.transpose();
  return result;
}

// Slopes and solution of an arc, base frame; the force and moment that its distributed forces add.
SectionWrench Response::linearise(std::size_t i, std::size_t k) {
  const SectionPose& pose = solution_.poses[k + 1];
  const SectionWrench& wrench = solution_.distal_wrenches_S[k];
  Arc& arc = arcs_[k];
  arc.force_N = pose.rotation_BS * wrench.force_N;
  arc.moment_Nmm = pose.rotation_BS * wrench.moment_Nmm;
  // The frame of the arc's slopes: the section's or, turned about the tangent, one in whose x-y plane the rod lies.
  const Matrix3d R = planar_ ? Matrix3d(pose.rotation_BS * *solution_.rotation_BP) : pose.rotation_BS;
  arc.has_tensions = false;
  if (!has_forces(i)) {
    const ArcVariation<6> variation = vary<6>(nullptr, wrench);
    to_base<6, 6>(R, variation.slopes, arc.slopes);
    arc.way_mm = R * variation.way_D_mm;
    return {};
  }
  const ArcForces<double, 3> forces = forces_on(i, constants_.length_mm, pose.rotation_BS);
  const auto take = [&](const auto& variation) -> SectionWrench {
    to_base<12, 9>(R, variation.slopes, arc.slopes);
    arc.way_mm = R * variation.way_D_mm;
    return {R * variation.gain_D.force_N, R * variation.gain_D.moment_Nmm};
  };
  arc.has_fixed_along = planar_ || arc_loads_are_asked_for_;
  if (!arc.has_fixed_along) return take(vary_by_turns(forces, wrench));
  arc.has_tensions = !planar_ && acts_in(first_tensions, i);
  if (!arc.has_tensions) return take(vary<9>(&forces, wrench));
  ArcChange<12> change = unit_changes<12>();
  change.constant = Constant::tension;
  change.tendon_arms = tendon_arms(first_tensions, i);
  const ArcVariation<12> variation = vary_arc(solution_.law, solution_.model, constants_, &forces, wrench, change);
  arc.tensions = turned_rows(R, variation.slopes.rightCols<3>());
  return take(variation);
}

// S at the arc's distal end, from that beyond, and what the arc makes of it: its own answer to the turn of its proximal
// end, and S there.
void Response::carry(std::size_t i, std::size_t k, const SectionWrench& gain_B) {
  Arc& arc = arcs_[k];
  const scene::Span& span = solution_.spans[i];
  arc.stiffness.setZero();
  if (k + 1 < first_arcs_.back()) arc.stiffness = arcs_[k + 1].onwards;
  if (k + 1 == first_arcs_[i + 1]) arc.stiffness += turn_stiffness(span, solution_.poses[k + 1].rotation_BS);

  // What the arc meets in its distal frame, by the turn of that: wrench and fixed force.
  Eigen::Matrix<double, 9, 3> met;
  met.topRows<6>() = arc.stiffness;
  met.topRows<3>() += skew(arc.force_N);
  met.middleRows<3>(3) += skew(arc.moment_Nmm);
  Eigen::Matrix<double, 12, 3> answer;
  const bool distributed = has_forces(i);
  if (distributed) {
    met.bottomRows<3>() = skew(arc_length_mm(i) * span.fixed_force_B_N_per_mm);
    answer.noalias() = arc.slopes.lazyProduct(met);
  } else {
    answer.topRows<6>() = arc.slopes.topLeftCorner<6, 6>() * met.topRows<6>();
  }
  arc.turn_by_turn = (Matrix3d::Identity() - answer.topRows<3>()).inverse();
  arc.way_by_turn = answer.middleRows<3>(3) - skew(arc.way_mm);

  arc.proximal_force_N = arc.force_N + gain_B.force_N;
  Columns carried = arc.stiffness;
  if (distributed) {
    carried += answer.bottomRows<6>();
    carried.topRows<3>() -= skew(gain_B.force_N);
    carried.bottomRows<3>() -= skew(gain_B.moment_Nmm);
  }
  carried.bottomRows<3>() += crossed(arc.way_mm, carried.topRows<3>()) - crossed(arc.proximal_force_N, arc.way_by_turn);
  arc.onwards = carried * arc.turn_by_turn;
}

// w, from the tip; the arcs' own turns and ways wait in the nodes.
void Response::sweep_to_clamp(Sweep& sweep) {
  Columns w = Columns::Zero();
  for (std::size_t i = solution_.spans.size(); i-- > 0;) {
    const bool acts = acts_in(sweep.source, i), distributed = has_forces(i);
    if (acts) set_constants(i, arc_length_mm(i));
    for (std::size_t k = first_arcs_[i + 1]; k-- > first_arcs_[i];) {
      const Arc& arc = arcs_[k];
      Node& node = sweep.nodes[k];
      if (i == sweep.jump_span && k + 1 == first_arcs_[i + 1]) w += sweep.wrench_jump - arc.stiffness * sweep.turn_jump;
      node.wrench = w;
      if (!distributed && !acts) {
        const Columns answer = arc.slopes.topLeftCorner<6, 6>() * w;
        node.turn = answer.topRows<3>();
        node.shift_mm = answer.bottomRows<3>();
      } else {
        Eigen::Matrix<double, 12, 3> answer = Eigen::Matrix<double, 12, 3>::Zero();
        if (distributed) answer.noalias() = arc.slopes.leftCols<6>().lazyProduct(w);
        else answer.topRows<6>() = arc.slopes.topLeftCorner<6, 6>() * w;
        if (acts) answer += source_in(sweep.source, i, k);
        node.turn = answer.topRows<3>();
        node.shift_mm = answer.middleRows<3>(3);
        w += answer.bottomRows<6>();
      }
      w.bottomRows<3>() += crossed(arc.way_mm, w.topRows<3>()) - crossed(arc.proximal_force_N, node.shift_mm);
      w += arc.onwards * node.turn;
    }
  }
}

// What the source makes of an arc whose distal end is held: turn, way, force and moment, base frame.
Eigen::Matrix<double, 12, 3> Response::source_in(const Source& source, std::size_t i, std::size_t k) const {
  if (source == first_tensions && arcs_[k].has_tensions) return arcs_[k].tensions;
  const Matrix3d& R = solution_.poses[k + 1].rotation_BS;
  ArcChange<3> change;
  add_source(source, i, constants_.length_mm, R, change);
  if (has_forces(i) && arcs_[k].has_fixed_along && change.constant == Constant::none && change.follower_S_N.isZero(0)) {
    return arcs_[k].slopes.rightCols<3>() * (R * change.fixed_D_N);
  }
  const ArcForces<double, 3> forces = forces_on(i, constants_.length_mm, R);
  const bool with_forces = has_forces(i) || brings_forces(source, i);
  const ArcVariation<3> variation = vary_arc(solution_.law, solution_.model, constants_,
                                             with_forces ? &forces : nullptr, solution_.distal_wrenches_S[k], change);
  return turned_rows(R, variation.slopes);
}

// Turns and shifts, from the clamp.
void Response::sweep_to_tip(Sweep& sweep) const {
  Matrix3d turn = Matrix3d::Zero(), shift_mm = Matrix3d::Zero();
  for (std::size_t k = 0; k < first_arcs_.back(); ++k) {
    const Arc& arc = arcs_[k];
    Node& node = sweep.nodes[k];
    turn = (arc.turn_by_turn * (turn + node.turn)).eval();
    shift_mm += arc.way_by_turn * turn + node.shift_mm;
    node.turn = turn;
    node.shift_mm = shift_mm;
    if (k + 1 == first_arcs_[sweep.jump_span + 1]) {
      turn -= sweep.turn_jump;
      shift_mm -= sweep.shift_jump_mm;
    }
  }
}

}  // namespace fam
