#include "response_support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace support {

using Eigen::Vector3d;
using scene::Scene;

scene::RodModel model_of(const Scene& scene) {
  for (const scene::Section& section : scene.sections) {
    const scene::Stiffness stiffness = scene::stiffness_of(section);
    if (stiffness.axial_N || stiffness.shear_N) return scene::RodModel::reissner;
  }
  return scene::RodModel::kirchhoff;
}

SolvedRod::SolvedRod(Scene scene, int arcs, fam::Law law)
    : SolvedRod(scene, scene::cells_per_span(scene::spans_of(scene), arcs), law) {}

SolvedRod::SolvedRod(Scene scene, std::vector<int> arcs_per_span, fam::Law law)
    : scene_(std::move(scene)),
      spans_(scene::spans_of(scene_)),
      loads_(spans_),
      arcs_per_span_(std::move(arcs_per_span)),
      law_(law),
      rod_(std::make_unique<fam::BasicBoundaryValue<3>>()) {
  rod_->set(loads_.way(), arcs_per_span_, law, model_of(scene_));
  converged_ = rod_->run() == scene::Status::converged;
  const fam::SolvedRod<3> solution = solved();
  if (!converged_) return;
  shape_ = std::make_unique<fam::BasicShape<3>>();
  shape_->set(solution);
  response_.reserve(solution.arcs.size(), spans_.size(), scene::max_tendon_offsets);
  const scene::Scene* const scenes[] = {&scene_};
  cutter_.cut(scenes);
  response_.set({&scene_, spans_, cutter_.sections(), arcs_per_span_, solution.poses, solution.distal_wrenches_S,
                 solution.law, solution.model});
}

// At an arc's end the side towards the clamp.
std::pair<fam::ArcInterior<3>, double> SolvedRod::place(double s_mm) const {
  std::size_t i = 0;
  while (i + 1 < spans_.size() && s_mm > spans_[i].end_mm * (1 + 1e-12)) ++i;
  const double arcs = (s_mm - spans_[i].start_mm) / spans_[i].length_mm() * arcs_per_span_[i];
  const double last = std::clamp(std::ceil(arcs - 1e-9), 1.0, static_cast<double>(arcs_per_span_[i]));
  return {shape_->interior(solved().spans[i].first_arc + static_cast<int>(last) - 1), std::min(1.0, arcs - last + 1)};
}

fam::BasicShape<3>::Section SolvedRod::section(double s_mm) const {
  auto [arc, fraction] = place(s_mm);
  return shape_->section(arc, fraction);
}

fam::BasicScrew<double, 3> SolvedRod::strain_per_mm(double s_mm) const {
  auto [arc, fraction] = place(s_mm);
  return arc.strain_per_mm(fraction);
}

Scene changed(Scene scene, const fam::Parameter& parameter, double change) {
  const auto component = static_cast<Eigen::Index>(parameter.component);
  if (parameter.kind == Kind::rest_curvature) {
    scene.sections[parameter.index].rest_curvature_per_mm[component] += change;
  } else if (parameter.kind == Kind::stiffness) {
    scene::Stiffness stiffness = scene::stiffness_of(scene.sections[parameter.index]);
    (component == 0 ? stiffness.torsion_Nmm2 : stiffness.bending_Nmm2[component - 1]) += change;
    scene.sections[parameter.index].cross_section = stiffness;
  } else {
    std::visit(
        [&](auto& load) {
          const bool by_place = parameter.kind == Kind::place;
          if constexpr (requires { load.at_mm; }) {
            if (by_place) load.at_mm += change;
          }
          if (by_place) return;
          if constexpr (requires { load.value_N; }) load.value_N[component] += change;
          if constexpr (requires { load.value_Nmm; }) load.value_Nmm[component] += change;
          if constexpr (requires { load.value_N_per_mm; }) load.value_N_per_mm[component] += change;
          if constexpr (requires { load.acceleration_m_per_s2; }) load.acceleration_m_per_s2[component] += change;
          if constexpr (requires { load.tension_N; }) load.tension_N += change;
        },
        scene.loads[parameter.index]);
  }
  return scene;
}

double step_of(const Scene& scene, const fam::Parameter& parameter) {
  const double length_mm = scene::length_mm(scene);
  double least_Nmm2 = std::numeric_limits<double>::infinity(), mass = 0;
  for (const scene::Section& section : scene.sections) {
    const scene::Stiffness stiffness = scene::stiffness_of(section);
    least_Nmm2 = std::min({least_Nmm2, stiffness.torsion_Nmm2, stiffness.bending_Nmm2.minCoeff()});
    mass = std::max(mass, stiffness.mass_per_length_kg_per_m);
  }
  const double turn = 1e-2, force_N = turn * least_Nmm2 / (length_mm * length_mm);
  if (parameter.kind == Kind::rest_curvature) return turn / length_mm;
  if (parameter.kind == Kind::place) return 2e-3 * length_mm;
  if (parameter.kind == Kind::stiffness) {
    const scene::Stiffness stiffness = scene::stiffness_of(scene.sections[parameter.index]);
    return turn * (parameter.component == 0 ? stiffness.torsion_Nmm2 : stiffness.bending_Nmm2[parameter.component - 1]);
  }
  const scene::Load& load = scene.loads[parameter.index];
  if (std::holds_alternative<scene::Moment>(load)) return force_N * length_mm;
  if (std::holds_alternative<scene::DistributedForce>(load)) return force_N / length_mm;
  if (std::holds_alternative<scene::Gravity>(load)) return force_N / length_mm / (1e-3 * mass);
  return force_N;
}

std::vector<fam::Parameter> parameters_of(const Scene& scene) {
  std::vector<fam::Parameter> parameters;
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const scene::Load& load = scene.loads[i];
    const int components = std::holds_alternative<scene::Tendon>(load) ? 1 : 3;
    for (int k = 0; k < components; ++k) parameters.push_back({Kind::load, i, k});
    const auto* force = std::get_if<scene::Force>(&load);
    const auto* moment = std::get_if<scene::Moment>(&load);
    const double at_mm = force ? force->at_mm : moment ? moment->at_mm : HUGE_VAL;
    if (at_mm < 0.999 * scene::length_mm(scene)) parameters.push_back({Kind::place, i, 0});
  }
  for (std::size_t i = 0; i < scene.sections.size(); ++i) {
    for (int k = 0; k < 3; ++k) parameters.push_back({Kind::rest_curvature, i, k});
    for (int k = 0; k < 3; ++k) parameters.push_back({Kind::stiffness, i, k});
  }
  return parameters;
}

Vector6 derivative(fam::Response& response, const fam::Parameter& parameter, double s_mm, What what) {
  switch (parameter.kind) {
    case Kind::load: return response.by_load(parameter.index, s_mm, what).col(parameter.component);
    case Kind::rest_curvature: return response.by_rest_curvature(parameter.index, s_mm, what).col(parameter.component);
    case Kind::stiffness: return response.by_stiffness(parameter.index, s_mm, what).col(parameter.component);
    case Kind::place: return response.by_place(parameter.index, s_mm, what).col(0);
  }
  return {};
}

namespace {

bool is_slack_tendon(const Scene& scene, const fam::Parameter& parameter) {
  if (parameter.kind != Kind::load) return false;
  const auto* tendon = std::get_if<scene::Tendon>(&scene.loads[parameter.index]);
  return tendon && tendon->tension_N == 0;
}

}  // namespace

Differences::Differences(const SolvedRod& rod, const fam::Parameter& parameter)
    : step_(step_of(rod.scene(), parameter)), one_sided_(is_slack_tendon(rod.scene(), parameter)) {
  if (one_sided_) step_ *= 0.1;
  rods_.reserve(4);
  const auto add = [&](double change) {
    rods_.emplace_back(changed(rod.scene(), parameter, change), rod.arcs_per_span(), rod.law());
  };
  for (const double share : one_sided_ ? std::array{1.0, 0.0, 0.5, 0.25} : std::array{1.0, -1.0, 0.5, -0.5}) {
    add(share * step_);
  }
}

Vector6 Differences::between(std::size_t more, std::size_t less, double s_mm, What what) const {
  if (!rods_[more].converged() || !rods_[less].converged()) {
    return Vector6::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const auto a = rods_[more].section(s_mm), b = rods_[less].section(s_mm);
  Vector6 result;
  if (what == What::pose) {
    result << a.pose.position_B_mm - b.pose.position_B_mm,
        fam::rotation_vector(Eigen::Matrix3d(a.pose.rotation_BS * b.pose.rotation_BS.transpose()));
  } else if (what == What::strain) {
    const auto strain = rods_[more].strain_per_mm(s_mm) + (-1.0) * rods_[less].strain_per_mm(s_mm);
    result << strain.rotation, strain.translation_mm;
  } else {
    result << a.own_B.force_N - b.own_B.force_N, a.own_B.moment_Nmm - b.own_B.moment_Nmm;
  }
  return result / step_;
}

// Extrapolated: of the error all but the fourth power of the step, one-sided the third, is gone.
Vector6 Differences::at(double s_mm, What what) const {
  if (!one_sided_) return (4 * between(2, 3, s_mm, what) - between(0, 1, s_mm, what) / 2) / 3;
  const Vector6 wide = between(0, 1, s_mm, what), half = 2 * between(2, 1, s_mm, what),
                quarter = 4 * between(3, 1, s_mm, what);
  return (4 * (2 * quarter - half) - (2 * half - wide)) / 3;
}

}  // namespace support
