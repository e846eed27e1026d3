#include "fem_reference/beam_model.h"

#include <algorithm>
#include <cmath>

namespace fem_reference {

namespace {

double inverse_or_zero(const std::optional<double>& stiffness) {
  return stiffness ? 1.0 / *stiffness : 0.0;
}

scene::Wrench scaled(const scene::Wrench& wrench, double force_unit_N, double moment_unit_Nmm) {
  return {wrench.force_N / force_unit_N, wrench.moment_Nmm / moment_unit_Nmm};
}

ElementData element_data(const scene::Span& span, double length_mm, double length_unit_mm, double force_unit_N,
                         bool kirchhoff) {
  const double moment_unit_Nmm = force_unit_N * length_unit_mm;
  const double load_unit_N_per_mm = force_unit_N / length_unit_mm;
  const scene::Stiffness& k = span.stiffness;
  ElementData data;
  data.length = length_mm / length_unit_mm;
  data.moment_stiffness =
      Eigen::Vector3d(k.torsion_Nmm2, k.bending_Nmm2[0], k.bending_Nmm2[1]) / (moment_unit_Nmm * length_unit_mm);
  data.force_compliance.setZero();
  if (!kirchhoff) {
    data.force_compliance[0] = inverse_or_zero(k.axial_N) * force_unit_N;
    if (k.shear_N) data.force_compliance.tail<2>() = force_unit_N * k.shear_N->cwiseInverse();
  }
  data.rest_curvature = span.rest_curvature_per_mm * length_unit_mm;
  for (const scene::SectionTendon& tendon : span.tendons) {
    data.tendons.push_back({tendon.arm_S_mm / length_unit_mm, tendon.tension_N / force_unit_N});
  }
  data.follower_force_S = span.follower_force_S_N_per_mm / load_unit_N_per_mm;
  data.fixed_force_B = span.fixed_force_B_N_per_mm / load_unit_N_per_mm;
  return data;
}

// Position of the distal end of an arc of constant curvature u and length h in the frame of its proximal end.
Eigen::Vector3d arc_end(const Eigen::Vector3d& u, double h) {
  const Eigen::Vector3d w = h * u;
  const double angle = w.norm();
  const double square = angle * angle;
  // (1 - cos) / angle^2 and (angle - sin) / angle^3; below the bound the next terms of the series are < 1e-16.
  const double sine = std::sin(0.5 * angle);
  const double b = angle < 1e-2 ? 0.5 - square / 24 + square * square / 720 : 2 * sine * sine / square;
  const double c =
      angle < 1e-2 ? 1.0 / 6 - square / 120 + square * square / 5040 : (angle - std::sin(angle)) / (square * angle);
  const Eigen::Vector3d ex = Eigen::Vector3d::UnitX();
  return h * (ex + b * w.cross(ex) + c * w.cross(w.cross(ex)));
}

}  // namespace

BeamModel beam_model(const std::vector<scene::Span>& spans, const std::vector<int>& cells,
                     const ReferenceElement& reference, bool kirchhoff) {
  BeamModel model;
  model.reference = reference;
  model.conservative = scene::is_conservative(spans);
  model.all_loads_follow = scene::all_loads_follow(spans);
  model.symmetry = scene::symmetry_of(spans);
  model.length_unit_mm = spans.back().end_mm;
  double bending_Nmm2 = 0;
  for (const scene::Span& span : spans) bending_Nmm2 = std::max(bending_Nmm2, span.stiffness.bending_Nmm2.maxCoeff());
  model.force_unit_N = bending_Nmm2 / (model.length_unit_mm * model.length_unit_mm);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const scene::Span& span = spans[i];
    const ElementData data =
        element_data(span, span.length_mm() / cells[i], model.length_unit_mm, model.force_unit_N, kirchhoff);
    model.elements.insert(model.elements.end(), static_cast<std::size_t>(cells[i]), data);
    if (span.follower_load_S.is_zero() && !span.has_fixed_point_load()) continue;
    model.loads.push_back({model.nodes() - 1, scaled(span.follower_load_S, model.force_unit_N, model.moment_unit_Nmm()),
                           scaled(span.fixed_load_B, model.force_unit_N, model.moment_unit_Nmm()),
                           span.fixed_force_arms_BS_Nmm / model.moment_unit_Nmm()});
  }
  return model;
}

BeamState rest_state(const BeamModel& model) {
  const ReferenceElement& reference = model.reference;
  BeamState state;
  state.position_B.push_back(Eigen::Vector3d::Zero());
  state.rotation_BS.push_back(Quaternion::Unit(0));
  for (const ElementData& element : model.elements) {
    const Eigen::Vector3d start_B = state.position_B.back();
    const Quaternion start_BS = state.rotation_BS.back();
    for (int i = 1; i < reference.nodes(); ++i) {
      const double h = reference.node(i) * element.length;
      state.position_B.push_back(start_B + rotated(start_BS, arc_end(element.rest_curvature, h)));
      state.rotation_BS.push_back(product(start_BS, exponential(h * element.rest_curvature)).normalized());
    }
  }
  state.force_S.assign(model.elements.size() * static_cast<std::size_t>(reference.points()), Eigen::Vector3d::Zero());
  return state;
}

void advance(BeamState& state, const BeamIncrement& increment, double factor) {
  for (std::size_t i = 0; i < state.position_B.size(); ++i) {
    state.position_B[i] += factor * increment.displacement_B[i];
    state.rotation_BS[i] = product(state.rotation_BS[i], exponential(factor * increment.rotation_S[i])).normalized();
  }
  for (std::size_t i = 0; i < state.force_S.size(); ++i) state.force_S[i] += factor * increment.force_S[i];
}

BeamIncrement difference(const BeamState& from, const BeamState& to) {
  BeamIncrement increment;
  for (std::size_t i = 0; i < from.position_B.size(); ++i) {
    increment.displacement_B.push_back(to.position_B[i] - from.position_B[i]);
    increment.rotation_S.push_back(logarithm(product(conjugate(from.rotation_BS[i]), to.rotation_BS[i])));
  }
  for (std::size_t i = 0; i < from.force_S.size(); ++i) increment.force_S.push_back(to.force_S[i] - from.force_S[i]);
  return increment;
}

double largest_rotation(const BeamState& from, const BeamState& to) {
  double largest = 0;
  for (std::size_t i = 0; i < from.rotation_BS.size(); ++i) {
    const Quaternion turn = product(conjugate(from.rotation_BS[i]), to.rotation_BS[i]);
    largest = std::max(largest, logarithm(turn).norm());
  }
  return largest;
}

double largest_entry(const std::vector<Eigen::Vector3d>& vectors) {
  double largest = 0;
  for (const Eigen::Vector3d& vector : vectors) largest = std::max(largest, vector.lpNorm<Eigen::Infinity>());
  return largest;
}

bool all_finite(const BeamState& state) {
  const auto finite = [](const auto& value) { return value.allFinite(); };
  return std::all_of(state.position_B.begin(), state.position_B.end(), finite) &&
         std::all_of(state.rotation_BS.begin(), state.rotation_BS.end(), finite) &&
         std::all_of(state.force_S.begin(), state.force_S.end(), finite);
}

}  // namespace fem_reference
