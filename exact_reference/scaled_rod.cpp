#include "exact_reference/scaled_rod.h"

#include "scene/load_visitor.h"

#include <algorithm>

namespace exact_reference {
namespace {

using Eigen::Vector3d;

double mean_bending_stiffness_Nmm2(std::span<const scene::Span> spans) {
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

// Turns a planar rod with equal sections about its axis into the x-y plane, and leaves nothing out of that.
void turn_into_xy(ScaledRod& rod, const Eigen::Vector2d& direction) {
  rod.symmetry = scene::Symmetry::plane_xy;
  Eigen::Matrix3d& Q = rod.turn_about_axis;
  Q.bottomRightCorner<2, 2>() << direction[0], direction[1], -direction[1], direction[0];
  const auto in_plane = [&](Vector3d& v) {
    v = Q * v;
    v[2] = 0;
  };
  const auto about_normal = [&](Vector3d& v) { v = Vector3d(0, 0, Q.row(2).dot(v)); };
  for (ScaledSpan& span : rod.spans) {
    about_normal(span.rest_curvature_S);
    for (Vector3d* density : {&span.follower_density_S, &span.fixed_density_B}) in_plane(*density);
    for (scene::Wrench* load : {&span.follower_load_S, &span.fixed_load_B}) {
      in_plane(load->force_N);
      about_normal(load->moment_Nmm);
    }
    span.fixed_force_arms_BS = Q * span.fixed_force_arms_BS * Q.transpose();
    span.fixed_force_arms_BS.row(2).setZero();
    span.fixed_force_arms_BS.col(2).setZero();
    for (ScaledTendon& tendon : span.tendons) tendon.arm_S = Q * tendon.arm_S;
  }
  for (Vector3d& arm : rod.tendon_arms_S) arm = Q * arm;
}

void set_tendon_paths(ScaledRod& rod, const scene::Scene& scene) {
  for (const scene::Load& load : scene.loads) {
    const scene::Tendon* tendon = scene::tendon_of(load);
    if (tendon == nullptr) continue;
    const Vector3d arm_S = Vector3d(0, tendon->offset_mm[0], tendon->offset_mm[1]) / rod.length_mm;
    const auto known = std::find(rod.tendon_arms_S.begin(), rod.tendon_arms_S.end(), arm_S);
    TendonPath& path = rod.tendon_paths.emplace_back();
    path.arm = static_cast<std::size_t>(known - rod.tendon_arms_S.begin());
    if (known == rod.tendon_arms_S.end()) rod.tendon_arms_S.push_back(arm_S);
    const auto middle_lies_beyond = [](double to, const ScaledSpan& span) { return to < (span.start + span.end) / 2; };
    path.spans = static_cast<std::size_t>(
        std::upper_bound(rod.spans.begin(), rod.spans.end(), tendon->to_mm / rod.length_mm, middle_lies_beyond) -
        rod.spans.begin());
  }
}

}  // namespace

double ScaledRod::load_size() const {
  double size = 0, tendons = 0, compliance = 0;
  for (const ScaledSpan& span : spans) {
    for (const scene::Wrench* load : {&span.follower_load_S, &span.fixed_load_B}) {
      size += load->force_N.norm() + load->moment_Nmm.norm();
    }
    size += span.fixed_force_arms_BS.norm();
    size += span.length() * (span.follower_density_S.norm() + span.fixed_density_B.norm());
    compliance = std::max(compliance, span.bending_compliance.maxCoeff());
    double pull = 0;
    for (const ScaledTendon& tendon : span.tendons) pull += tendon.tension * tendon.arm_S.norm();
    tendons = std::max(tendons, pull);
  }
  return (size + tendons) * compliance;
}

bool ScaledRod::has_fixed_load() const {
  return std::any_of(spans.begin(), spans.end(), [](const ScaledSpan& span) {
    return !span.fixed_load_B.is_zero() || !span.fixed_force_arms_BS.isZero(0) || !span.fixed_density_B.isZero(0);
  });
}

bool ScaledRod::moments_are_known() const {
  const bool forces = std::any_of(spans.begin(), spans.end(), [](const ScaledSpan& span) {
    return !span.fixed_load_B.force_N.isZero(0) || !span.fixed_force_arms_BS.isZero(0) ||
           !span.fixed_density_B.isZero(0);
  });
  return has_fixed_moment() && !forces && !has_follower_load() && !has_tendon();
}

bool ScaledRod::has_tendon() const {
  return std::any_of(spans.begin(), spans.end(), [](const ScaledSpan& span) { return !span.tendons.empty(); });
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

namespace {

// In the scene's own axes.
ScaledRod scaled(const scene::Scene& scene, std::span<const scene::Span> spans, RodModel model) {
  const double length = spans.back().end_mm;
  const double bending = mean_bending_stiffness_Nmm2(spans);

  ScaledRod rod;
  rod.length_mm = length;
  rod.symmetry = scene::symmetry_of(spans);
  rod.plane_normal_B = scene::plane_normal(spans);
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
    out.fixed_force_arms_BS = span.fixed_force_arms_BS_Nmm / rod.moment_unit_Nmm;
    for (const scene::SectionTendon& tendon : span.tendons) {
      out.tendons.push_back({tendon.arm_S_mm / length, tendon.tension_N / rod.force_unit_N});
    }
  }
  set_tendon_paths(rod, scene);
  return rod;
}

// The loads of `rod` grow from those of `before`.
void start_from(ScaledRod& rod, const ScaledRod& before) {
  for (std::size_t i = 0; i < rod.spans.size(); ++i) {
    ScaledSpan& span = rod.spans[i];
    span.before = before.spans[i];
    for (const ScaledTendon& tendon : before.spans[i].tendons) {
      const auto same = std::find_if(span.tendons.begin(), span.tendons.end(),
                                     [&](const ScaledTendon& t) { return t.arm_S == tendon.arm_S; });
      if (same == span.tendons.end()) span.tendons.push_back({tendon.arm_S, 0, tendon.tension});
      else same->tension_before = tendon.tension;
    }
  }
}

}  // namespace

ScaledRod scaled_rod(const scene::Scene& scene, RodModel model) {
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  ScaledRod rod = scaled(scene, spans, model);
  const std::optional<Eigen::Vector2d> direction = scene::plane_direction(spans);
  const bool oblique = direction && (*direction)[0] != 0 && (*direction)[1] != 0;
  if (oblique && scene::is_isotropic(spans)) turn_into_xy(rod, *direction);
  return rod;
}

ScaledRod scaled_rod(const scene::Scene& scene, const scene::SpanCutter& cutter, RodModel model) {
  scene::Reused<scene::Span> spans;
  cutter.fill(scene, spans);
  return scaled(scene, spans, model);
}

std::vector<ScaledRod> scaled_way(std::span<const scene::Scene> scenes, RodModel model) {
  std::vector<const scene::Scene*> all;
  for (const scene::Scene& scene : scenes) all.push_back(&scene);
  scene::SpanCutter cutter;
  cutter.cut(all);
  std::vector<ScaledRod> rods;
  for (const scene::Scene& scene : scenes) {
    rods.push_back(scaled_rod(scene, cutter, model));
    if (rods.size() == 1) continue;
    ScaledRod& before = rods[rods.size() - 2];
    start_from(rods.back(), before);
    rods.back().symmetry = scene::common_symmetry(rods.back().symmetry, before.symmetry);
  }
  return rods;
}

}  // namespace exact_reference
