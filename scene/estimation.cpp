#include "scene/estimation.h"

#include "scene/load_visitor.h"

namespace scene {
namespace {

using Kind = Unknown::Kind;

const char* unit_of(const Load& load) {
  return visit_load(
      load, [](const Force&) { return "N"; }, [](const Moment&) { return "N mm"; },
      [](const DistributedForce&) { return "N/mm"; }, [](const Gravity&) { return "m/s^2"; },
      [](const Tendon&) { return "N"; });
}

double* place_of(Load& load) {
  double* const none = nullptr;
  return visit_load(
      load, [](Force& force) { return &force.at_mm; }, [](Moment& moment) { return &moment.at_mm; },
      [&](DistributedForce&) { return none; }, [&](Gravity&) { return none; }, [&](Tendon&) { return none; });
}

}  // namespace

std::string name_of(const Unknown& unknown, const EstimationProblem& problem) {
  if (unknown.kind == Kind::component || unknown.kind == Kind::place) {
    const Load& load = problem.scenes[unknown.scene].scene.loads[unknown.index];
    const std::string of = (problem.scenes.size() > 1 ? "scenes[" + std::to_string(unknown.scene) + "]." : "") +
                           "loads[" + std::to_string(unknown.index) + "].";
    if (unknown.kind == Kind::place) return of + "at_mm, mm";
    return of + (tendon_of(load) ? "tension" : std::string(1, "xyz"[unknown.component])) + ", " + unit_of(load);
  }
  const std::string of = "sections[" + std::to_string(unknown.index) + "].";
  if (unknown.kind == Kind::bending_factor) return of + "bending_factor";
  if (unknown.kind == Kind::torsion_factor) return of + "torsion_factor";
  return of + "rest_curvature_" + "xyz"[unknown.component] + ", 1/mm";
}

bool has_place(const Load& load) {
  Load copy = load;
  return place_of(copy) != nullptr;
}

double value_in(const EstimationProblem& problem, const Unknown& unknown) {
  const Scene& scene = problem.scenes[unknown.scene].scene;
  switch (unknown.kind) {
    case Kind::component: {
      Load load = scene.loads[unknown.index];
      return numbers_of(load)[static_cast<std::size_t>(unknown.component)];
    }
    case Kind::place: {
      Load load = scene.loads[unknown.index];
      return *place_of(load);
    }
    case Kind::rest_curvature: return scene.sections[unknown.index].rest_curvature_per_mm[unknown.component];
    case Kind::bending_factor:
    case Kind::torsion_factor: break;
  }
  return 1;
}

void put(EstimationProblem& problem, const Unknown& unknown, double value) {
  if (unknown.kind == Kind::component) {
    numbers_of(problem.scenes[unknown.scene].scene.loads[unknown.index])[static_cast<std::size_t>(unknown.component)] =
        value;
    return;
  }
  if (unknown.kind == Kind::place) {
    *place_of(problem.scenes[unknown.scene].scene.loads[unknown.index]) = value;
    return;
  }
  for (MeasuredScene& measured : problem.scenes) {
    Section& section = measured.scene.sections[unknown.index];
    if (unknown.kind == Kind::rest_curvature) {
      section.rest_curvature_per_mm[unknown.component] = value;
      continue;
    }
    Stiffness stiffness = stiffness_of(section);
    if (unknown.kind == Kind::bending_factor) stiffness.bending_Nmm2 *= value;
    else stiffness.torsion_Nmm2 *= value;
    section.cross_section = stiffness;
  }
}

}  // namespace scene
