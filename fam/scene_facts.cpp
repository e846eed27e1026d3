#include "fam/scene_facts.h"

#include <algorithm>
#include <cmath>

namespace fam {

using scene::Span;

bool all_loads_follow(std::span<const Span> spans) {
  return std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    return span.fixed_load_B.is_zero() && span.fixed_force_B_N_per_mm.isZero(0) &&
           span.follower_force_S_N_per_mm.isZero(0);
  });
}

bool is_planar(std::span<const Span> spans) {
  const auto about = [&](int axis) {  // 2: the x-y plane, 1: the x-z plane
    const int other = 3 - axis;
    return std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
      const auto planar = [&](const scene::Wrench& load) {
        return load.force_N[axis] == 0 && load.moment_Nmm[0] == 0 && load.moment_Nmm[other] == 0;
      };
      return planar(span.follower_load_S) && planar(span.fixed_load_B) && span.follower_force_S_N_per_mm[axis] == 0 &&
             span.fixed_force_B_N_per_mm[axis] == 0 && span.rest_curvature_per_mm[0] == 0 &&
             span.rest_curvature_per_mm[other] == 0 && span.tendon_S.moment_Nmm[other] == 0;
    });
  };
  return about(2) || about(1);
}

bool is_symmetric(std::span<const Span> spans) {
  const auto along_axis = [](const Eigen::Vector3d& v) { return v[1] == 0 && v[2] == 0; };
  return is_planar(spans) || std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
           const auto wrench_along_axis = [&](const scene::Wrench& w) {
             return along_axis(w.force_N) && along_axis(w.moment_Nmm);
           };
           return wrench_along_axis(span.follower_load_S) && wrench_along_axis(span.fixed_load_B) &&
                  wrench_along_axis(span.tendon_S) && along_axis(span.follower_force_S_N_per_mm) &&
                  along_axis(span.fixed_force_B_N_per_mm) && along_axis(span.rest_curvature_per_mm);
         });
}

bool conservative(std::span<const Span> spans) {
  return std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    return span.follower_load_S.is_zero() && span.follower_force_S_N_per_mm.isZero(0) &&
           span.fixed_load_B.moment_Nmm.isZero(0);
  });
}

double least_stiffness_Nmm2(const Span& span) {
  return std::min(span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2.minCoeff());
}

double moment_growth_per_Nmm2(const Span& span) {
  Eigen::Vector3d c(span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2[0], span.stiffness.bending_Nmm2[1]);
  c = c.cwiseInverse().eval();
  std::sort(c.begin(), c.end());
  return std::sqrt((c[1] - c[0]) * (c[2] - c[1]));
}

}  // namespace fam
