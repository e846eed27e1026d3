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

// The wrench with six slopes, one for each of its components.
BasicWrench<Dual<6>, 3> varied(const SectionWrench& wrench) {
  BasicWrench<Dual<6>, 3> result{wrench.force_N.cast<Dual<6>>(), wrench.moment_Nmm.cast<Dual<6>>()};
  for (int i = 0; i < 3; ++i) {
    result.force_N[i].slope[i] = 1;
    result.moment_Nmm[i].slope[3 + i] = 1;
  }
  return result;
}

// Blocks of three rows and columns, from a section's frame into the base frame.
template <class To, class From>
void to_base(const Matrix3d& rotation_BS, const From& from, int rows, To&& to) {
  for (int row = 0; row < rows; row += 3) {
    for (int column = 0; column < from.cols(); column += 3) {
      to.template block<3, 3>(row, column) =
          rotation_BS * from.template block<3, 3>(row, column) * rotation_BS.transpose();
    }
  }
}

}  // namespace

void Response::prepare() {
  if (prepared_) return;
  prepared_ = true;
  name_spans();
  for (std::size_t i = solution_.spans.size(); i-- > 0;) factorise_span(i);
}

// Which arcs and which section each has.
void Response::name_spans() {
  first_arcs_.assign(1, 0);
  section_of_span_.clear();
  const auto& sections = solution_.scene->sections;
  std::size_t section = 0;
  double section_end_mm = sections[0].length_mm;
  for (std::size_t i = 0; i < solution_.spans.size(); ++i) {
    const scene::Span& span = solution_.spans[i];
    first_arcs_.push_back(first_arcs_.back() + static_cast<std::size_t>(solution_.arcs_per_span[i]));
    while ((span.start_mm + span.end_mm) / 2 >= section_end_mm && section + 1 < sections.size()) {
      section_end_mm += sections[++section].length_mm;
    }
    section_of_span_.push_back(section);
  }
}

void Response::factorise_span(std::size_t i) {
  const scene::Span& span = solution_.spans[i];
  VariedConstants<double> constants = varied_constants<double>(span, arc_length_mm(i), solution_.model);
  for (std::size_t k = 0; k < span.tendons.size(); ++k) {
    tendons_[k] = {span.tendons[k].arm_S_mm, span.tendons[k].tension_N};
  }
  constants.tendons = {tendons_.data(), span.tendons.size()};
  const bool distributed = has_forces(i);
  const VariedConstants<Dual<3>> same =
      distributed ? seeded_constants({}, i, constants.length_mm) : VariedConstants<Dual<3>>{};
  for (std::size_t k = first_arcs_[i + 1]; k-- > first_arcs_[i];) {
    carry(i, k, linearise(i, k, constants, same));
  }
}

// Slopes and solution of an arc, base frame; the force and moment that its distributed forces add.
SectionWrench Response::linearise(std::size_t i, std::size_t k, const VariedConstants<double>& constants,
                                  const VariedConstants<Dual<3>>& same) {
  const Matrix3d& R = solution_.poses[k + 1].rotation_BS;
  const SectionWrench& wrench = solution_.distal_wrenches_S[k];
  Arc& arc = arcs_[k];
  ArcForces<Dual<6>, 3> forces;
  const bool distributed = has_forces(i);
  if (distributed) {
    const Vector3d fixed_D_N = R.transpose() * solution_.spans[i].fixed_force_B_N_per_mm * constants.length_mm;
    forces = {(constants.length_mm * solution_.spans[i].follower_force_S_N_per_mm).cast<Dual<6>>(),
              fixed_D_N.cast<Dual<6>>()};
  }
  const ArcVariation<6> by_wrench =
      vary_arc(solution_.law, solution_.model, constants, distributed ? &forces : nullptr, varied(wrench));
  to_base(R, by_wrench.slopes, distributed ? 12 : 6, arc.slopes.leftCols<6>());
  if (distributed) {
    const ArcForces<Dual<3>, 3> turning = seeded_forces({}, i, constants.length_mm, R, R);
    const ArcVariation<3> by_force =
        vary_arc(solution_.law, solution_.model, same, &turning,
                 BasicWrench<Dual<3>, 3>{wrench.force_N.cast<Dual<3>>(), wrench.moment_Nmm.cast<Dual<3>>()});
    to_base(R, by_force.slopes, 12, arc.slopes.rightCols<3>());
  }
  arc.force_N = R * wrench.force_N;
  arc.moment_Nmm = R * wrench.moment_Nmm;
  arc.way_mm = R * by_wrench.way_D_mm;
  return {R * by_wrench.gain_D.force_N, R * by_wrench.gain_D.moment_Nmm};
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
    answer = arc.slopes * met;
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
  carried.bottomRows<3>() += skew(arc.way_mm) * carried.topRows<3>() - skew(arc.proximal_force_N) * arc.way_by_turn;
  arc.onwards = carried * arc.turn_by_turn;
}

// w, from the tip; the arcs' own turns and ways wait in the nodes.
void Response::sweep_to_clamp(Sweep& sweep) {
  Columns w = Columns::Zero();
  for (std::size_t i = solution_.spans.size(); i-- > 0;) {
    const bool acts = acts_in(sweep.source, i), distributed = has_forces(i);
    VariedConstants<Dual<3>> constants;
    if (acts) constants = seeded_constants(sweep.source, i, arc_length_mm(i));
    for (std::size_t k = first_arcs_[i + 1]; k-- > first_arcs_[i];) {
      const Arc& arc = arcs_[k];
      Node& node = sweep.nodes[k];
      if (i == sweep.jump_span && k + 1 == first_arcs_[i + 1]) w += sweep.wrench_jump - arc.stiffness * sweep.turn_jump;
      node.wrench = w;
      Eigen::Matrix<double, 12, 3> answer;
      if (distributed) {
        answer.noalias() = arc.slopes.leftCols<6>() * w;
      } else {
        answer.topRows<6>().noalias() = arc.slopes.topLeftCorner<6, 6>() * w;
        answer.bottomRows<6>().setZero();
      }
      if (acts) answer += source_in(sweep.source, i, k, constants);
      node.turn = answer.topRows<3>();
      node.shift_mm = answer.middleRows<3>(3);
      w += answer.bottomRows<6>();
      w.bottomRows<3>() += skew(arc.way_mm) * w.topRows<3>() - skew(arc.proximal_force_N) * node.shift_mm;
      w += arc.onwards * node.turn;
    }
  }
}

// What the source makes of an arc whose distal end is held: turn, way, force and moment, base frame.
Eigen::Matrix<double, 12, 3> Response::source_in(const Source& source, std::size_t i, std::size_t k,
                                                 const VariedConstants<Dual<3>>& constants) const {
  const Matrix3d& R = solution_.poses[k + 1].rotation_BS;
  const SectionWrench& wrench = solution_.distal_wrenches_S[k];
  const bool with_forces = has_forces(i) || brings_forces(source, i);
  ArcForces<Dual<3>, 3> forces;
  if (with_forces) forces = seeded_forces(source, i, constants.length_mm, R, Matrix3d::Zero());
  const ArcVariation<3> variation =
      vary_arc(solution_.law, solution_.model, constants, with_forces ? &forces : nullptr,
               BasicWrench<Dual<3>, 3>{wrench.force_N.cast<Dual<3>>(), wrench.moment_Nmm.cast<Dual<3>>()});
  Eigen::Matrix<double, 12, 3> result;
  for (int row = 0; row < 12; row += 3) result.middleRows<3>(row) = R * variation.slopes.middleRows<3>(row);
  return result;
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
