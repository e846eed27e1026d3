#include "scene/span_facts.h"

#include <algorithm>

namespace scene {

bool all_loads_follow(std::span<const Span> spans) {
  return std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    return span.fixed_load_B.is_zero() && span.fixed_force_B_N_per_mm.isZero(0) &&
           span.follower_force_S_N_per_mm.isZero(0);
  });
}

namespace {

bool lies_in(std::span<const Span> spans, int normal) {
  const int other = 3 - normal;
  return std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
    const auto planar = [&](const Wrench& load) {
      return load.force_N[normal] == 0 && load.moment_Nmm[0] == 0 && load.moment_Nmm[other] == 0;
    };
    return planar(span.follower_load_S) && planar(span.fixed_load_B) && span.follower_force_S_N_per_mm[normal] == 0 &&
           span.fixed_force_B_N_per_mm[normal] == 0 && span.rest_curvature_per_mm[0] == 0 &&
           span.rest_curvature_per_mm[other] == 0 && span.tendon_S.moment_Nmm[other] == 0;
  });
}

bool lies_on_axis(std::span<const Span> spans) {
  const auto along = [](const Eigen::Vector3d& v) { return v[1] == 0 && v[2] == 0; };
  return std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
    const auto both = [&](const Wrench& wrench) { return along(wrench.force_N) && along(wrench.moment_Nmm); };
    return both(span.follower_load_S) && both(span.fixed_load_B) && both(span.tendon_S) &&
           along(span.follower_force_S_N_per_mm) && along(span.fixed_force_B_N_per_mm) &&
           along(span.rest_curvature_per_mm);
  });
}

}  // namespace

bool is_planar(std::span<const Span> spans) {
  return lies_in(spans, 2) || lies_in(spans, 1);
}

Symmetry symmetry_of(std::span<const Span> spans) {
  if (lies_on_axis(spans)) return Symmetry::axis;
  if (lies_in(spans, 2)) return Symmetry::plane_xy;
  return lies_in(spans, 1) ? Symmetry::plane_xz : Symmetry::none;
}

bool is_conservative(std::span<const Span> spans) {
  return std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    return span.follower_load_S.is_zero() && span.follower_force_S_N_per_mm.isZero(0) &&
           span.fixed_load_B.moment_Nmm.isZero(0);
  });
}

}  // namespace scene
