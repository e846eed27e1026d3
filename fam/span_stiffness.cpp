#include "fam/span_stiffness.h"

#include <algorithm>
#include <cmath>

namespace fam {

using scene::Span;

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
