#include "fam/reach.h"

#include "fam/model_choice.h"
#include "fam/span_stiffness.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fam {
namespace {

// Strain k of an arc that turns by k h, and the moment m = K (k - k0) - tendons' of its section.
struct ArcMoment {
  Vector3d strain_per_mm, moment_Nmm;
  Vector3d stiffness_Nmm2;
  double scale;  // of m x k

  ArcMoment(const scene::Span& span, const Vector3d& turn_rad, double h_mm)
      : strain_per_mm(turn_rad / h_mm),
        stiffness_Nmm2(span.stiffness.torsion_Nmm2, span.stiffness.bending_Nmm2[0], span.stiffness.bending_Nmm2[1]) {
    const Vector3d elastic_Nmm = stiffness_Nmm2.cwiseProduct(strain_per_mm - span.rest_curvature_per_mm);
    const Vector3d tendons_Nmm = straight_tendons(span).moment_Nmm;
    moment_Nmm = elastic_Nmm - tendons_Nmm;
    scale = (elastic_Nmm.norm() + tendons_Nmm.norm()) * strain_per_mm.norm();
  }

  bool is_steady() const { return moment_Nmm.cross(strain_per_mm).norm() <= 1e-12 * scale; }

  double rate_per_mm() const {
    Matrix3d slope;  // its trace is 0
    for (int i = 0; i < 3; ++i) {
      slope.col(i) = (moment_Nmm / stiffness_Nmm2[i] - strain_per_mm).cross(Vector3d::Unit(i));
    }
    return std::sqrt(std::abs((slope * slope).trace()) / 2);
  }
};

}  // namespace

double largest_reach_rad(std::span<const scene::Span> spans, std::span<const int> arcs_per_span,
                         std::span<const Arc> arcs, bool planar) {
  const bool free_of_force = largest_growth(spans, std::vector<int>(spans.size(), 1)) == 0;
  if (free_of_force && planar) return 0;
  auto arc = arcs.begin();
  double largest = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double h_mm = spans[i].length_mm() / arcs_per_span[i];
    for (int k = 0; k < arcs_per_span[i]; ++k, ++arc) {
      const ArcMoment state(spans[i], arc->screw.rotation, h_mm);
      if (free_of_force && state.is_steady()) continue;
      largest = std::max({largest, arc->screw.rotation.norm(), planar ? 0 : h_mm * state.rate_per_mm()});
    }
  }
  return largest;
}

}  // namespace fam
