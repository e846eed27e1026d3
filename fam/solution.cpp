#include "fam/solution.h"

#include "fam/embedding.h"

#include <algorithm>

namespace fam {

void Solution::reserve(const Room& room) {
  planar_shape_.reserve(room.arcs);
  shape_.reserve(room.arcs);
  first_arc_.reserve(room.spans + 1);
  twist_rad_.reserve(room.arcs);
}

void Solution::set(const Problem& problem, const Run& run) {
  problem_ = &problem;
  run_ = &run;
  first_arc_.assign(1, 0);
  for (const int count : run.arcs) first_arc_.push_back(first_arc_.back() + count);
  is_shaped_ = false;
  twist_rad_.clear();
  if (!problem.choice().round) return;
  double twist = 0;
  for (int arc = 0; arc < arc_count(); ++arc) {
    twist_rad_.push_back(twist);
    twist = twist_rad({arc, 1});
  }
}

void Solution::shape() const {
  if (is_shaped_) return;
  run_->engine.visit([this](const auto& solver) {
    const auto rod = solver.solved();
    if constexpr (std::is_same_v<decltype(rod), const SolvedRod<2>>) planar_shape_.set(rod);
    else shape_.set(rod);
  });
  is_shaped_ = true;
}

std::size_t Solution::span_of(int arc) const {
  return static_cast<std::size_t>(std::upper_bound(first_arc_.begin(), first_arc_.end(), arc) - first_arc_.begin()) - 1;
}

double Solution::length_of_arc_mm(std::size_t span) const {
  return problem_->spans()[span].length_mm() / run_->arcs[span];
}

Place Solution::place_at(double s_mm) const {
  const std::span<const scene::Span> spans = problem_->spans();
  const double hair_mm = scene::same_place_relative * problem_->length_mm();
  const auto end = std::lower_bound(spans.begin(), spans.end(), s_mm - hair_mm,
                                    [](const scene::Span& span, double s) { return span.end_mm < s; });
  const auto i = static_cast<std::size_t>(std::min(end - spans.begin(), std::ptrdiff_t(spans.size()) - 1));
  const double arcs = std::max(0.0, (s_mm - spans[i].start_mm) / length_of_arc_mm(i));
  constexpr double hair = 1e-9;  // of an arc: places that close to its end are its end
  const int arc = std::clamp(static_cast<int>(std::ceil(arcs - hair)) - 1, 0, run_->arcs[i] - 1);
  const double fraction = std::clamp(arcs - arc, 0.0, 1.0);
  return {first_arc_[i] + arc, fraction > 1 - hair ? 1 : fraction};
}

double Solution::arc_end_mm(int arc) const {
  const std::size_t i = span_of(arc);
  const scene::Span& span = problem_->spans()[i];
  return arc + 1 == first_arc_[i + 1] ? span.end_mm : span.start_mm + (arc + 1 - first_arc_[i]) * length_of_arc_mm(i);
}

// The moment about the tangent, constant along a span of a round rod, times what GJ gives way more than EI.
double Solution::twist_rad(const Place& place) const {
  if (!problem_->choice().round) return 0;
  const std::size_t i = span_of(place.arc);
  const double moment_Nmm = run_->engine.visit([&](const auto& solver) {
    return embedded_angular(solver.solved().distal_wrenches_S[static_cast<std::size_t>(place.arc)].moment_Nmm)[0];
  });
  return twist_rad_[static_cast<std::size_t>(place.arc)] +
         twist_per_Nmm2(problem_->scene_spans()[i]) * moment_Nmm * place.fraction * length_of_arc_mm(i);
}

scene::Pose Solution::pose(const Place& place) const {
  const SectionPose pose = run_->engine.visit([&](const auto& solver) {
    const auto rod = solver.solved();
    return in_base(ArcInterior(rod, rod.spans[span_of(place.arc)], place.arc).pose(place.fraction),
                   problem_->choice().rotation_BP);
  });
  scene::Pose result{pose.rotation_BS, pose.position_B_mm};
  if (problem_->choice().round)
    result.rotation_BS *= Eigen::AngleAxisd(twist_rad(place), Vector3d::UnitX()).toRotationMatrix();
  return result;
}

SectionState<3> Solution::state(const Place& place, const scene::Pose& pose_there) const {
  const Matrix3d& rotation_BP = problem_->choice().rotation_BP;
  SectionState<3> state;
  state.rotation_SB = pose_there.rotation_BS.transpose();
  run_->engine.visit([&](const auto& solver) {
    const auto rod = solver.solved();
    const auto wrench = ArcInterior(rod, rod.spans[span_of(place.arc)], place.arc).wrench(place.fraction);
    state.wrench = {in_base(wrench.force_N, rotation_BP), angular_in_base(wrench.moment_Nmm, rotation_BP)};
  });
  if (problem_->choice().round) {
    const Matrix3d back = Eigen::AngleAxisd(-twist_rad(place), Vector3d::UnitX()).toRotationMatrix();
    state.wrench = {back * state.wrench.force_N, back * state.wrench.moment_Nmm};
  }
  return state;
}

scene::Wrench Solution::own_wrench_B(const Place& place) const {
  const Matrix3d& rotation_BP = problem_->choice().rotation_BP;
  const auto own_B = [&](const auto& shape) -> scene::Wrench {
    auto arc = shape.interior(place.arc);
    const auto own = shape.section(arc, place.fraction).own_B;
    return {in_base(own.force_N, rotation_BP), angular_in_base(own.moment_Nmm, rotation_BP)};
  };
  shape();
  return run_->engine.is_planar() ? own_B(planar_shape_) : own_B(shape_);
}

}  // namespace fam
