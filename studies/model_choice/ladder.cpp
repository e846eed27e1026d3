#include "studies/model_choice/ladder.h"

#include "scene/span_facts.h"
#include "studies/compare/error_measures.h"
#include "studies/methods/registry.h"

#include <algorithm>

namespace studies {
namespace {

constexpr int most_cells = 128;  // arcs or elements of a ladder

void add_ladder(std::vector<std::vector<ModelSize>>& ladders, const SceneFacts& facts, ModelSize model) {
  std::vector<ModelSize> rising;
  for (int count = 1; count <= most_cells; count *= 2) {
    if (count < facts.spans && 2 * count <= facts.spans) continue;  // the same cells as the next
    model.count = std::max(count, facts.spans);
    rising.push_back(model);
  }
  ladders.push_back(std::move(rising));
}

}  // namespace

SceneFacts facts_of(const scene::Scene& scene) {
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  const auto gives_way = [](const scene::Span& span) { return span.stiffness.axial_N || span.stiffness.shear_N; };
  return {scene::length_mm(scene), static_cast<int>(spans.size()), scene::plane_direction(spans).has_value(),
          scene::all_loads_follow(spans), std::any_of(spans.begin(), spans.end(), gives_way)};
}

std::string ModelSize::resolution() const {
  return counted(count, finite_elements ? "element" : "arc");
}

const Rung* smallest_sufficient(const std::vector<Rung>& rising, double tolerance) {
  const Rung* smallest = nullptr;
  for (auto rung = rising.rbegin(); rung != rising.rend() && rung->suffices(tolerance); ++rung) smallest = &*rung;
  return smallest;
}

int fewest_sufficient(const std::function<bool(int)>& holds, int least, int guess, int most) {
  int too_few = least - 1, enough = std::clamp(guess, least, most);
  while (!holds(enough)) {
    if (enough == most) return 0;
    too_few = enough;
    enough = std::min(2 * enough, most);
  }
  while (enough - too_few > 1) {
    const int middle = (too_few + enough) / 2;
    (holds(middle) ? enough : too_few) = middle;
  }
  return enough;
}

scene::Scene made_to_take(const ModelSize& model, const SceneFacts& facts, scene::Scene scene) {
  using Eigen::Vector3d;
  constexpr double next_to_nothing = 1e-60;
  if (model.finite_elements) return scene;
  if (facts.planar && model.space)
    scene.loads.push_back(scene::Moment{facts.length_mm, scene::Frame::follower, next_to_nothing * Vector3d::UnitX()});
  if (facts.march && !model.march)
    scene.loads.push_back(scene::Force{facts.length_mm, scene::Frame::fixed, next_to_nothing * Vector3d::UnitX()});
  return scene;
}

std::unique_ptr<Method> method_of(const ModelSize& model) {
  Request request;
  request.count = model.count;
  request.model = model.shear ? scene::RodModel::reissner : scene::RodModel::kirchhoff;
  request.estimate_error = false;
  return method_row(model.finite_elements ? "fe" : "fam_sixth_order")(request);
}

double shape_error(const scene::Equilibrium& answer, const scene::Equilibrium& truth) {
  if (!answer.converged() || !truth.converged()) return std::numeric_limits<double>::quiet_NaN();
  return largest_distance_mm(answer, truth) / truth.stations.back().s_mm;
}

Rung solved_rung(const ModelSize& model, const SceneFacts& facts, const scene::Scene& scene,
                 const scene::Equilibrium& truth) {
  const scene::Equilibrium answer = method_of(model)->solve(made_to_take(model, facts, scene));
  return {model, scene::name(answer.status), shape_error(answer, truth), {}};
}

std::vector<std::vector<ModelSize>> all_models(const SceneFacts& facts) {
  std::vector<std::vector<ModelSize>> ladders;
  for (const bool space : {false, true}) {
    if (!space && !facts.planar) continue;
    for (const bool shear : {false, true}) {
      if (facts.march) add_ladder(ladders, facts, {false, space, shear, true});
      add_ladder(ladders, facts, {false, space, shear, false});
    }
  }
  for (const bool shear : {false, true}) add_ladder(ladders, facts, {true, true, shear, false});
  return ladders;
}

}  // namespace studies
