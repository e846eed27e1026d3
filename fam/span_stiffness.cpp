#include "fam/span_stiffness.h"

#include <algorithm>
#include <cmath>

namespace fam {

using scene::Span;

double least_stiffness_Nmm2(const Span& span) {
  return std::min(span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2.minCoeff());
}

scene::Wrench straight_tendons(const Span& span) {
  scene::Wrench wrench;
  for (const scene::SectionTendon& tendon : span.tendons) {
    wrench.force_N[0] -= tendon.tension_N;
    wrench.moment_Nmm -= tendon.tension_N * tendon.arm_S_mm.cross(Eigen::Vector3d::UnitX());
  }
  return wrench;
}

double load_moment_Nmm(const Span& span) {
  return span.follower_load_S.moment_Nmm.norm() + span.fixed_load_B.moment_Nmm.norm() +
         span.fixed_force_arms_BS_Nmm.norm();
}

double moment_growth_per_Nmm2(const Span& span) {
  Eigen::Vector3d c(span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2[0], span.stiffness.bending_Nmm2[1]);
  c = c.cwiseInverse().eval();
  std::sort(c.begin(), c.end());
  return std::sqrt((c[1] - c[0]) * (c[2] - c[1]));
}

}  // namespace fam
