#include "fem_reference/parametric_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fem_reference {

namespace {

bool is_round(const ElementData& element) {
  const bool centred = std::all_of(element.tendons.begin(), element.tendons.end(),
                                   [](const scene::SectionTendon& tendon) { return tendon.arm_S_mm.isZero(0); });
  return centred && element.moment_stiffness[1] == element.moment_stiffness[2] &&
         element.force_compliance[1] == element.force_compliance[2];
}

bool turns_freely(const BeamModel& model) {
  return model.symmetry == scene::Symmetry::axis && std::all_of(model.elements.begin(), model.elements.end(), is_round);
}

bool planes_apart(const BeamModel& model) {
  const bool untwisted = std::all_of(model.elements.begin(), model.elements.end(),
                                     [](const ElementData& element) { return element.rest_curvature.isZero(0); });
  return untwisted && std::all_of(model.loads.begin(), model.loads.end(), [](const NodalLoad& load) {
           return load.follower_S.moment_Nmm.isZero(0) && load.fixed_B.moment_Nmm.isZero(0);
         });
}

BeamModel scaled(const BeamModel& full_load, double factor) {
  BeamModel model = full_load;
  for (ElementData& element : model.elements) {
    for (scene::SectionTendon& tendon : element.tendons) tendon.tension_N *= factor;
    element.follower_force_S *= factor;
    element.fixed_force_B *= factor;
  }
  for (NodalLoad& load : model.loads) {
    for (scene::Wrench* wrench : {&load.follower_S, &load.fixed_B}) {
      wrench->force_N *= factor;
      wrench->moment_Nmm *= factor;
    }
    load.fixed_force_arms_BS *= factor;
  }
  return model;
}

}  // namespace

double ParametricModel::reach() const {
  return to == from ? 1 : std::abs(to - from);
}

BeamModel beam_model(const scene::Scene& scene, const Options& options) {
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  const ReferenceElement reference =
      reference_element(options.order, options.order + (options.full_integration ? 1 : 0));
  return beam_model(spans, scene::cells_per_span(spans, options.elements), reference,
                    options.model == RodModel::kirchhoff);
}

ParametricModel parametric_model(const scene::PathRequest& request, const Options& options) {
  const auto at = [request, options](double parameter) {
    return beam_model(scene::scene_at(request, parameter), options);
  };
  return {at, request.from, request.to, request.parameter == scene::PathParameter::turn_rad};
}

ParametricModel parametric_model(const BeamModel& full_load) {
  return {[full_load](double parameter) { return scaled(full_load, parameter); }, 0, 1, false};
}

ParameterSlope::ParameterSlope(const ParametricModel& parametric) : parametric_(parametric) {
  if (parametric.turns) {
    factor_ = 0.5;  // d(a + b cos + c sin) = half the difference over a quarter turn to either side
    return;
  }
  before_ = parametric.at(parametric.from);
  after_ = parametric.at(parametric.from + parametric.reach());
  factor_ = 1 / parametric.reach();
}

Imbalance ParameterSlope::at(const BeamState& state, double parameter) {
  if (parametric_.turns) {
    before_ = parametric_.at(parameter - std::numbers::pi / 2);
    after_ = parametric_.at(parameter + std::numbers::pi / 2);
  }
  return difference(imbalance(after_, state), imbalance(before_, state), factor_);
}

PathFacts path_facts(const ParametricModel& parametric) {
  PathFacts facts{true, true, true};
  for (const double share : {0.0, 0.381966, 1.0}) {  // chosen, not measured: one of them is none of a kind
    const BeamModel model = parametric.at(
        parametric.from + share * (parametric.to == parametric.from ? 1 : parametric.to - parametric.from));
    facts.conservative = facts.conservative && model.conservative;
    facts.turns_freely = facts.turns_freely && turns_freely(model);
    facts.planes_apart = facts.planes_apart && facts.turns_freely && planes_apart(model);
  }
  return facts;
}

}  // namespace fem_reference
