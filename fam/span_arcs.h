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
  SpanArcs(const scene::Span& span, RodModel model, int first, int count)
      : constants(arc_constants<D>(span, count, model)),
        distributed(!span.follower_force_S_N_per_mm.isZero(0) || !span.fixed_force_B_N_per_mm.isZero(0)),
        first_arc(first),
        end_arc(first + count) {
    set_load(span, model, 1);
  }

  // All loads times the factor.
  void set_load(const scene::Span& span, RodModel model, double factor) {
    const auto load = [factor](const scene::Wrench& wrench) -> BasicWrench<double, D> {
      return {factor * linear_part<D>(wrench.force_N), factor * angular_part<D>(wrench.moment_Nmm)};
    };
    if (!span.tendons.empty()) set_tendons(constants, span, model, factor);
    follower_load_S = load(span.follower_load_S);
    fixed_load_B = load(span.fixed_load_B);
    fixed_force_arms_BS_Nmm = factor * span.fixed_force_arms_BS_Nmm.topLeftCorner<D, D>();
    const double along_arc = factor * constants.length_mm;
    follower_force_S_N = along_arc * linear_part<D>(span.follower_force_S_N_per_mm);
    fixed_force_B_N = along_arc * linear_part<D>(span.fixed_force_B_N_per_mm);
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
};

}  // namespace fam
