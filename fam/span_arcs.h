// The arcs of one span and the loads that they meet on the march from tip to clamp.
#pragma once

#include "fam/arc_section.h"
#include "fam/arc_step.h"
#include "fam/rotation.h"

namespace fam {

template <int D>
struct SpanArcs {
  using Rotation = Eigen::Matrix<double, D, D>;

  BasicArcConstants<D> constants;
  BasicWrench<double, D> follower_load_S, fixed_load_B;   // at the span's distal end
  Rotation fixed_force_arms_BS_Nmm;                       // scene::Span
  Vector<double, D> follower_force_S_N, fixed_force_B_N;  // distributed, times the arc length
  bool distributed = false;
  int first_arc = 0, end_arc = 0;  // first_arc .. end_arc - 1

  SpanArcs() = default;
  SpanArcs(SpanArcs&&) noexcept = default;
  SpanArcs& operator=(SpanArcs&&) noexcept = default;
  SpanArcs(const scene::Span& span, RodModel model, int first, int count) { set({span, span}, model, first, count); }

  // Takes memory for tendons alone, where there are more than ever before.
  void set(const SpanOnWay& span, RodModel model, int first, int count) {
    const auto is_distributed = [](const scene::Span& s) {
      return !s.follower_force_S_N_per_mm.isZero(0) || !s.fixed_force_B_N_per_mm.isZero(0);
    };
    distributed = is_distributed(span.from) || is_distributed(span.to);
    first_arc = first;
    end_arc = first + count;
    set_constants(constants, tendons_, span, count, model);
    set_loads(span);
  }

  void reserve(std::size_t tendons) { tendons_.reserve(tendons); }

  // Only what depends on the share.
  void set_way(const SpanOnWay& span, RodModel model) {
    set_share(constants, tendons_, span, model);
    set_loads(span);
  }

  // The point loads at the span's distal end, for the section there.
  template <class T>
  void add_point_loads(const Eigen::Matrix<T, D, D>& rotation_SB, BasicWrench<T, D>& wrench_S) const {
    wrench_S.force_N +=
        follower_load_S.force_N.template cast<T>() + rotation_SB * fixed_load_B.force_N.template cast<T>();
    wrench_S.moment_Nmm += follower_load_S.moment_Nmm.template cast<T>();
    if constexpr (D == 3) wrench_S.moment_Nmm += rotation_SB * fixed_load_B.moment_Nmm.template cast<T>();
    else wrench_S.moment_Nmm += fixed_load_B.moment_Nmm.template cast<T>();
    if (!fixed_force_arms_BS_Nmm.isZero(0)) {
      const Eigen::Matrix<T, D, D> arms_S = rotation_SB * fixed_force_arms_BS_Nmm.template cast<T>();
      wrench_S.moment_Nmm += T(2) * sine_vector(arms_S);  // the axial vector: sum r x f
    }
  }

  // The distributed forces on an arc whose distal section has this rotation.
  template <class T>
  ArcForces<T, D> forces(const Eigen::Matrix<T, D, D>& rotation_SB) const {
    return {follower_force_S_N.template cast<T>(), rotation_SB * fixed_force_B_N.template cast<T>()};
  }

 private:
  void set_loads(const SpanOnWay& span) {
    const auto load = [&](const scene::Wrench& from, const scene::Wrench& to) -> BasicWrench<double, D> {
      return {linear_part<D>(span.between(from.force_N, to.force_N)),
              angular_part<D>(span.between(from.moment_Nmm, to.moment_Nmm))};
    };
    follower_load_S = load(span.from.follower_load_S, span.to.follower_load_S);
    fixed_load_B = load(span.from.fixed_load_B, span.to.fixed_load_B);
    fixed_force_arms_BS_Nmm =
        span.between(span.from.fixed_force_arms_BS_Nmm, span.to.fixed_force_arms_BS_Nmm).template topLeftCorner<D, D>();
    const auto along_arc = [&](const Vector3d& from, const Vector3d& to) -> Vector<double, D> {
      return constants.length_mm * linear_part<D>(span.between(from, to));
    };
    follower_force_S_N = along_arc(span.from.follower_force_S_N_per_mm, span.to.follower_force_S_N_per_mm);
    fixed_force_B_N = along_arc(span.from.fixed_force_B_N_per_mm, span.to.fixed_force_B_N_per_mm);
  }

  std::vector<BasicTendon<D>> tendons_;  // seen by the constants
};

}  // namespace fam
