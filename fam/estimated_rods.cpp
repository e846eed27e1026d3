#include "fam/estimated_rods.h"

#include "fam/measured_rows.h"

#include "scene/load_visitor.h"

#include <algorithm>
#include <cmath>

namespace fam {
namespace {

using scene::Status;
using scene::Unknown;
using UnknownKind = scene::Unknown::Kind;

// Chosen, not measured.
constexpr double model_share = 0.03;  // of the smallest standard deviation, that the model may be off by
constexpr double least_tolerance_over_L = 1e-8, most_tolerance_over_L = 1e-5;
constexpr double least_place_over_L = 1e-9;               // at the clamp itself no load can stand
constexpr double least_factor = 0.01, most_factor = 100;  // of a stiffness
constexpr int first_reserved_arcs = 32;                   // memory for 1024 costs as much as a solve
// Farther than that from the last solution an estimate's slopes tell nothing: beyond a fold, or half around the rod's
// axis. Of 53 662 solves of the study of sensing 51 576 take up to 5 and 285 up to 100; 1801 took up to 552, and 85 %
// of the time. With 20, 40 and 80 in its place one trial of 200 near the column's load ends in another status; but 40
// turn down what a stream that jumps by a third needs.
constexpr int most_way_newton_steps = 100;

// How far the rod is off, as a whole, where it is off by this measurement's deviation.
double deviation_mm(const scene::Measurement& measurement, const scene::Scene& scene) {
  const double L_mm = scene::length_mm(scene);
  const auto& value = measurement.value;
  if (const auto* position = std::get_if<scene::PositionMeasurement>(&value)) return position->sd_mm;
  if (const auto* rotation = std::get_if<scene::RotationMeasurement>(&value)) return rotation->sd_rad * L_mm;
  if (const auto* curvature = std::get_if<scene::CurvatureMeasurement>(&value))
    return curvature->sd_per_mm * L_mm * L_mm;
  const auto& wrench = std::get<scene::BaseWrenchMeasurement>(value);
  const double EI_Nmm2 = scene::stiffness_of(scene.sections.front()).bending_Nmm2.maxCoeff();
  return std::min(wrench.sd_N * L_mm, wrench.sd_Nmm) * L_mm * L_mm / EI_Nmm2;
}

double model_tolerance_mm(const scene::EstimationProblem& problem) {
  const double L_mm = scene::length_mm(problem.scenes.front().scene);
  double least_mm = HUGE_VAL;
  for (const scene::MeasuredScene& measured : problem.scenes)
    for (const scene::Measurement& measurement : measured.measurements)
      least_mm = std::min(least_mm, deviation_mm(measurement, measured.scene));
  return std::clamp(model_share * least_mm, least_tolerance_over_L * L_mm, most_tolerance_over_L * L_mm);
}

}  // namespace

double unit_of(const Unknown& unknown, const scene::EstimationProblem& problem) {
  const scene::Scene& scene = problem.scenes[unknown.scene].scene;
  const double L = scene::length_mm(scene);
  const scene::Stiffness stiffness = scene::stiffness_of(scene.sections.front());
  const double EI = stiffness.bending_Nmm2.maxCoeff();
  switch (unknown.kind) {
    case UnknownKind::component:
      return scene::visit_load(
          scene.loads[unknown.index], [&](const scene::Force&) { return EI / (L * L); },
          [&](const scene::Moment&) { return EI / L; },
          [&](const scene::DistributedForce&) { return EI / (L * L * L); },
          [&](const scene::Gravity&) {
            const double mass = stiffness.mass_per_length_kg_per_m * 1e-3;  // kg/mm
            return mass > 0 ? EI / (L * L * L) / mass : 1;
          },
          [&](const scene::Tendon&) { return EI / (L * L); });
    case UnknownKind::place: return L;
    case UnknownKind::rest_curvature: return 1 / L;
    case UnknownKind::bending_factor:
    case UnknownKind::torsion_factor: break;
  }
  return 1;
}

double within_bounds(const Unknown& unknown, const scene::EstimationProblem& problem, double value) {
  const scene::Scene& scene = problem.scenes[unknown.scene].scene;
  switch (unknown.kind) {
    case UnknownKind::place: {
      const double length_mm = scene::length_mm(scene);
      return std::clamp(value, least_place_over_L * length_mm, length_mm);
    }
    case UnknownKind::component:
      return scene::tendon_of(scene.loads[unknown.index]) != nullptr ? std::max(value, 0.0) : value;
    case UnknownKind::bending_factor:
    case UnknownKind::torsion_factor: return std::clamp(value, least_factor, most_factor);
    case UnknownKind::rest_curvature: break;
  }
  return value;
}

bool is_at_chosen_bound(const Unknown& unknown, double value) {
  const bool is_factor = unknown.kind == UnknownKind::bending_factor || unknown.kind == UnknownKind::torsion_factor;
  constexpr double hair = 1e-9;  // relative: round-off of the step that ends there
  return is_factor && (value <= (1 + hair) * least_factor || value >= (1 - hair) * most_factor);
}

EstimatedRods::EstimatedRods(const scene::EstimationProblem& problem, const Options& options)
    : now_(problem), values_(problem.unknowns.size()), options_(options), solvers_(problem.scenes.size()) {
  if (options_.arcs == 0 && !(options_.tolerance_mm > 0)) options_.tolerance_mm = model_tolerance_mm(problem);
  options_.reserved_arcs = 0;
  for (const scene::MeasuredScene& measured : problem.scenes) sections_.push_back(measured.scene.sections);
  for (const Unknown& unknown : problem.unknowns) has_sections_ |= is_of_section(unknown);
}

void EstimatedRods::put(std::span<const double> values) {
  std::copy(values.begin(), values.end(), values_.begin());
  if (has_sections_) {
    for (std::size_t i = 0; i < sections_.size(); ++i) now_.scenes[i].scene.sections = sections_[i];
  }
  put_into(now_);
}

void EstimatedRods::put_into(scene::EstimationProblem& problem) const {
  for (std::size_t i = 0; has_sections_ && i < sections_.size(); ++i) problem.scenes[i].scene.sections = sections_[i];
  for (std::size_t k = 0; k < values_.size(); ++k) scene::put(problem, now_.unknowns[k], values_[k]);
}

void EstimatedRods::set_values(Solver& solver, std::size_t scene) const {
  for (const Unknown& u : now_.unknowns) {
    if (is_of_section(u)) {
      const scene::Section& section = now_.scenes[scene].scene.sections[u.index];
      const scene::Stiffness stiffness = scene::stiffness_of(section);
      if (u.kind == UnknownKind::rest_curvature)
        solver.set_rest_curvature_per_mm(u.index, section.rest_curvature_per_mm);
      else
        solver.set_stiffness_Nmm2(u.index,
                                  {stiffness.torsion_Nmm2, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1]});
      continue;
    }
    if (u.scene != scene) continue;
    const bool place = u.kind == UnknownKind::place;
    scene::visit_load(
        now_.scenes[scene].scene.loads[u.index],
        [&](const scene::Force& load) {
          place ? solver.set_at_mm(u.index, load.at_mm) : solver.set_force_N(u.index, load.value_N);
        },
        [&](const scene::Moment& load) {
          place ? solver.set_at_mm(u.index, load.at_mm) : solver.set_moment_Nmm(u.index, load.value_Nmm);
        },
        [&](const scene::DistributedForce& load) { solver.set_distributed_N_per_mm(u.index, load.value_N_per_mm); },
        [&](const scene::Gravity& load) { solver.set_acceleration_m_per_s2(u.index, load.acceleration_m_per_s2); },
        [&](const scene::Tendon& load) { solver.set_tension_N(u.index, load.tension_N); });
  }
}

bool EstimatedRods::reserve() {
  if (options_.reserved_arcs > 0) return false;
  options_.reserved_arcs = first_reserved_arcs;
  for (std::optional<Solver>& solver : solvers_) solver.reset();
  return true;
}

bool EstimatedRods::make(std::size_t scene) {
  auto made = Solver::make(now_.scenes[scene].scene, options_);
  if (const auto* refusal = std::get_if<Refusal>(&made)) {
    status_ = refusal->status;
    message_ = refusal->message;
    return false;
  }
  solvers_[scene].emplace(std::move(std::get<Solver>(made)));
  return true;
}

bool EstimatedRods::solve(std::size_t scene, Solver::Start start) {
  if (solvers_[scene]) set_values(*solvers_[scene], scene);
  else if (!make(scene)) return false;
  const bool on = start == Solver::Start::last_solution;
  Solver::Outcome outcome = solvers_[scene]->solve(start, on ? most_way_newton_steps : most_newton_steps);
  while (outcome.status == Status::tolerance_not_met && options_.reserved_arcs > 0 &&
         options_.reserved_arcs < most_unreserved_arcs) {
    options_.reserved_arcs *= 2;
    if (!make(scene)) return false;
    outcome = solvers_[scene]->solve();
  }
  status_ = outcome.status;
  if (!outcome.converged()) message_ = outcome.message;
  return outcome.converged();
}

}  // namespace fam
