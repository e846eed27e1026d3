#include "fam/lanes.h"

#include "fam/load_length.h"
#include "fam/rotation.h"
#include "fam/span_arcs.h"

#include "scene/load_visitor.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace fam {
namespace {

using scene::Load;
using scene::Scene;
using scene::Span;

// Every load's numbers 0, in a rod straight at rest.
Scene unloaded(Scene scene) {
  for (Load& load : scene.loads) std::ranges::fill(numbers_of(load), 0);
  for (scene::Section& section : scene.sections) section.rest_curvature_per_mm.setZero();
  return scene;
}

double& number_of(Scene& scene, const BatchColumn& column) {
  return numbers_of(scene.loads[column.load])[static_cast<std::size_t>(column.component)];
}

// As the loads stand in `numbers`.
template <int D>
void write(const SpanArcs<D>& arcs, double* numbers) {
  namespace at = lane_number;
  const auto vector = [&](int first, const Vector<double, D>& v) { std::copy_n(v.data(), D, numbers + first); };
  const auto turn = [&](int first, const Angular<double, D>& w) {
    std::copy_n(w.data(), rotations_of(D), numbers + first + 3 - rotations_of(D));
  };
  vector(at::follower_force, arcs.follower_load_S.force_N);
  turn(at::follower_moment, arcs.follower_load_S.moment_Nmm);
  vector(at::fixed_force, arcs.fixed_load_B.force_N);
  turn(at::fixed_moment, arcs.fixed_load_B.moment_Nmm);
  for (int row = 0; row < D; ++row) {
    for (int column = 0; column < D; ++column)
      numbers[at::fixed_force_arms + 3 * row + column] = arcs.fixed_force_arms_BS_Nmm(row, column);
  }
  vector(at::distributed_follower, arcs.follower_force_S_N);
  vector(at::distributed_fixed, arcs.fixed_force_B_N);
  turn(at::rest_rotation, arcs.constants.rest_rotation);
}

bool is_distributed(int number) {
  return number >= lane_number::distributed_follower && number < lane_number::rest_rotation;
}

// In space: what tendons along the tangent bend a span by, and their tensions; `tendons`: all that may pull.
void write_tendons(const Span& span, std::span<const scene::SectionTendon> tendons, LaneSpan& result) {
  const Vector3d moment_Nmm = straight_tendons(span).moment_Nmm;
  for (int i = 0; i < 3; ++i)
    result.numbers[lane_number::rest_rotation + i] += result.angular_compliance[i] * moment_Nmm[i];
  for (const scene::SectionTendon& tendon : tendons) {
    const int k = result.tendons++;
    result.tendon_y_mm[k] = tendon.arm_S_mm[1];
    result.tendon_z_mm[k] = tendon.arm_S_mm[2];
    for (const scene::SectionTendon& pulled : span.tendons)
      if (pulled.arm_S_mm == tendon.arm_S_mm) result.numbers[lane_number::tension + k] = pulled.tension_N;
  }
}

template <int D>
LaneSpan lane_span(const Span& span, RodModel model, int arcs, std::span<const scene::SectionTendon> tendons) {
  const SpanArcs<D> in_arcs(span, model, 0, arcs);
  LaneSpan result{};
  result.arcs = arcs;
  result.arc_length_mm = span.length_mm() / arcs;
  std::copy_n(in_arcs.constants.angular_compliance.data(), rotations_of(D),
              result.angular_compliance + 3 - rotations_of(D));
  std::copy_n(in_arcs.constants.linear_compliance.data(), D, result.linear_compliance);
  write(in_arcs, result.numbers);
  result.least_stiffness_Nmm2 = least_stiffness_Nmm2(span);
  result.buckling_stiffness_Nmm2 = D == 2 ? span.stiffness.bending_Nmm2.minCoeff() : result.least_stiffness_Nmm2;
  if (D == 3) result.spin_rate_per_Nmm2 = spin_rate_per_Nmm2(span);
  if (model == RodModel::reissner) result.linear_compliance_per_N = linear_compliance_per_N(span);
  if (D == 3) result.rest_turn_rad = span.length_mm() * span.rest_curvature_per_mm.norm();
  for (int k = 0; k < lane_number::rest_rotation; ++k)
    result.distributed |= is_distributed(k) && result.numbers[k] != 0;
  if (D == 3) write_tendons(span, tendons, result);
  for (const scene::SectionTendon& tendon : span.tendons) {
    result.tendon_arms_mm[0] = std::min(result.tendon_arms_mm[0], tendon.arm_S_mm[1]);
    result.tendon_arms_mm[1] = std::max(result.tendon_arms_mm[1], tendon.arm_S_mm[1]);
  }
  return result;
}

}  // namespace

LaneProblem::LaneProblem(const Scene& scene, std::span<const BatchColumn> columns, const Options& options)
    : scene_(scene), columns_(columns) {
  const Scene* const scenes[] = {&scene_};
  cutter_.cut(scenes);
  // Two sets of values that nothing singles out: where both leave the rod in one plane, all do.
  Choice choices[2];
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      number_of(scene_, columns[i]) = 1 + std::fmod(std::numbers::phi * static_cast<double>((k + 1) * (i + 1)), 1);
    }
    cutter_.fill(scene_, given_);
    choices[k] = choose(given_, options, 0);
  }
  choice_ = choices[0];
  if (choice_.plane && (!choices[1].plane || *choices[1].plane != *choice_.plane)) {
    choice_.plane.reset();
    choice_.rotation_BP.setIdentity();
    choice_.round = scene::is_round(given_);
  }
  rods_.conservative = scene::is_conservative(given_);
  for (const Span& span : spans_of(scene_)) {
    tendons_.push_back(span.tendons);
    most_tendons_ = std::max(most_tendons_, static_cast<int>(span.tendons.size()));
  }
  for (const BatchColumn& column : columns) number_of(scene_, column) = 0;
}

bool LaneProblem::is_solvable(RodModel model) const {
  return choice_.law == Law::sixth_order && (is_planar(model) || most_tendons_ <= most_lane_tendons);
}

// Tendons that shear may turn from the tangent have lanes in space alone.
bool LaneProblem::is_planar(RodModel model) const {
  return choice_.plane && (most_tendons_ == 0 || model == RodModel::kirchhoff);
}

// The spans of a scene as they are solved.
std::span<const Span> LaneProblem::spans_of(const Scene& scene) {
  cutter_.fill(scene, given_);
  if (choice_.plane) turn_into_plane(given_, choice_, solved_);
  else if (choice_.round) leave_out_torsion(given_, solved_);
  else return given_;
  return solved_;
}

template <int D>
void LaneProblem::set_spans(RodModel model, std::span<const int> arcs_per_span) {
  const std::span<const Span> spans = spans_of(scene_);
  Matrix3d rest_tip_BS = Matrix3d::Identity();
  lane_spans_.clear();
  double compliance_per_Nmm = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    lane_spans_.push_back(lane_span<D>(spans[i], model, arcs_per_span[i], tendons_[i]));
    lane_spans_.back().compliance_to_clamp_per_Nmm = compliance_per_Nmm;
    compliance_per_Nmm += spans[i].length_mm() / lane_spans_.back().buckling_stiffness_Nmm2;
    if (choice_.round) lane_spans_.back().twist_per_Nmm2 = twist_per_Nmm2(given_[i]);
    rest_tip_BS *= rotation_matrix(Vector3d(spans[i].length_mm() * spans[i].rest_curvature_per_mm));
  }
  Eigen::Map<Matrix3d>(rods_.rest_tip_rotation_SB) = rest_tip_BS;  // by columns: its transpose by rows
  rods_.numbers = lane_number::tension + (D == 3 ? most_tendons_ : 0);
  const Scene nothing = unloaded(scene_);
  terms_.clear();
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    Scene unit = nothing;
    number_of(unit, columns_[column]) = 1;
    const std::span<const Span> loaded = spans_of(unit);
    for (std::size_t i = 0; i < loaded.size(); ++i) {
      const LaneSpan by_one = lane_span<D>(loaded[i], model, arcs_per_span[i], tendons_[i]);
      for (int k = 0; k < rods_.numbers; ++k) {
        if (by_one.numbers[k] == 0) continue;
        terms_.push_back({static_cast<int>(i), k, static_cast<int>(column), by_one.numbers[k]});
        lane_spans_[i].distributed |= is_distributed(k);
      }
      double* const arms_mm = lane_spans_[i].tendon_arms_mm;
      arms_mm[0] = std::min(arms_mm[0], by_one.tendon_arms_mm[0]);
      arms_mm[1] = std::max(arms_mm[1], by_one.tendon_arms_mm[1]);
    }
  }
}

LaneRods& LaneProblem::set(RodModel model, std::span<const int> arcs_per_span) {
  if (is_planar(model)) set_spans<2>(model, arcs_per_span);
  else set_spans<3>(model, arcs_per_span);
  rods_.spans = lane_spans_;
  rods_.terms = terms_;
  rods_.arc_count = std::accumulate(arcs_per_span.begin(), arcs_per_span.end(), 0);
  rods_.planar = is_planar(model);
  rods_.march = choice_.march;
  rods_.reissner = model == RodModel::reissner;
  rods_.round = choice_.round;
  rods_.length_mm = scene::length_mm(scene_);
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rods_.rotation_BP) = choice_.rotation_BP;
  return rods_;
}

}  // namespace fam
