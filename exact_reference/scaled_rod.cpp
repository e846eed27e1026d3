#include "exact_reference/scaled_rod.h"

#include <algorithm>

namespace exact_reference {
namespace {

using Eigen::Vector3d;

double mean_bending_stiffness_Nmm2(const std::vector<scene::Span>& spans) {
  double compliance = 0;
  for (const scene::Span& span : spans) compliance += span.length_mm() / span.stiffness.bending_Nmm2.minCoeff();
  return spans.back().end_mm / compliance;
}

Vector3d shear_compliance_per_N(const scene::Stiffness& stiffness, RodModel model) {
  Vector3d compliance = Vector3d::Zero();
  if (model == RodModel::kirchhoff) return compliance;
  if (stiffness.axial_N) compliance[0] = 1 / *stiffness.axial_N;
  if (stiffness.shear_N) compliance.tail<2>() = stiffness.shear_N->cwiseInverse();
  return compliance;
}

}  // namespace

double ScaledRod::load_size() const {
  double size = 0, compliance = 0;
  for (const ScaledSpan& span : spans) {
    for (const scene::Wrench* load : {&span.follower_load_S, &span.fixed_load_B}) {
      size += load->force_N.norm() + load->moment_Nmm.norm();
    }
    size += span.length() * (span.follower_density_S.norm() + span.fixed_density_B.norm());
    compliance = std::max(compliance, span.bending_compliance.maxCoeff());
  }
  return size * compliance;
}

bool ScaledRod::has_fixed_load() const {
  return std::any_of(spans.begin(), spans.end(), [](const ScaledSpan& span) {
    return !span.fixed_load_B.is_zero() || !span.fixed_density_B.isZero(0);
  });
}

bool ScaledRod::has_fixed_moment() const {
  return std::any_of(spans.begin(), spans.end(),
                     [](const ScaledSpan& span) { return !span.fixed_load_B.moment_Nmm.isZero(0); });
}

bool ScaledRod::has_follower_load() const {
  return std::any_of(spans.begin(), spans.end(), [](const ScaledSpan& span) {
    return !span.follower_load_S.is_zero() || !span.follower_density_S.isZero(0);
  });
}

bool ScaledRod::shears_or_stretches() const {
  return std::any_of(spans.begin(), spans.end(),
                     [](const ScaledSpan& span) { return !span.shear_compliance.isZero(0); });
}

ScaledRod scaled_rod(const scene::Scene& scene, RodModel model) {
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  const double length = spans.back().end_mm;
  const double bending = mean_bending_stiffness_Nmm2(spans);

  ScaledRod rod;
  rod.length_mm = length;
  rod.symmetry = scene::symmetry_of(spans);
  rod.force_unit_N = bending / length / length;
  rod.moment_unit_Nmm = bending / length;
  const auto scaled = [&](const scene::Wrench& wrench) {
    return scene::Wrench{wrench.force_N / rod.force_unit_N, wrench.moment_Nmm / rod.moment_unit_Nmm};
  };
  for (const scene::Span& span : spans) {
    const scene::Stiffness& stiffness = span.stiffness;
    ScaledSpan& out = rod.spans.emplace_back();
    out.start = span.start_mm / length;
    out.end = span.end_mm / length;
    out.bending_compliance << bending / stiffness.torsion_Nmm2, bending / stiffness.bending_Nmm2[0],
        bending / stiffness.bending_Nmm2[1];
    out.shear_compliance = rod.force_unit_N * shear_compliance_per_N(stiffness, model);
    out.rest_curvature_S = length * span.rest_curvature_per_mm;
    out.follower_density_S = length / rod.force_unit_N * span.follower_force_S_N_per_mm;
    out.fixed_density_B = length / rod.force_unit_N * span.fixed_force_B_N_per_mm;
    out.follower_load_S = scaled(span.follower_load_S);
    out.fixed_load_B = scaled(span.fixed_load_B);
    out.tendon_S = scaled(span.tendon_S);
  }
  return rod;
}

}  // namespace exact_reference
