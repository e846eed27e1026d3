#include "studies/model_choice/random_choice.h"

#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "studies/model_choice/ladder.h"
#include "studies/report/table.h"
#include "studies/scenes/random_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace studies {
namespace {

using scene::Equilibrium;

// Errors of a tenth of the tolerance are told apart from none.
constexpr double sharper = 1e-3, sharp_enough = 0.1;

bool is_sharp(const Equilibrium& truth, double tolerance_mm) {
  return truth.converged() && truth.error_estimate_mm <= sharp_enough * tolerance_mm;
}

Equilibrium finer_answer(const scene::Scene& scene, scene::RodModel model, double tolerance_mm) {
  fam::Options options;
  options.model = model;
  options.tolerance_mm = sharper * tolerance_mm;
  return fam::solve(scene, options);
}

Equilibrium exact_answer(const scene::Scene& scene) {
  constexpr double exact_tolerance = 1e-11;
  return exact_reference::solve(scene, {exact_reference::RodModel::reissner, exact_tolerance});
}

// The largest distance of the centreline from the plane through the undeformed axis that lies best.
double distance_from_planes_mm(const Equilibrium& answer) {
  const auto from_plane_mm = [&](double angle) {
    const Eigen::Vector3d normal(0, -std::sin(angle), std::cos(angle));
    double largest = 0;
    for (const scene::Station& station : answer.stations) {
      largest = std::max(largest, std::abs(normal.dot(station.X_BS.position_B_mm)));
    }
    return largest;
  };
  double best = 0, least = from_plane_mm(0);
  for (double step = std::numbers::pi / 90; step > 1e-10; step /= 10) {
    const double middle = best;
    for (int i = -90; i <= 90; ++i) {
      const double angle = middle + i * step, distance = from_plane_mm(angle);
      if (distance < least) least = distance, best = angle;
    }
  }
  return least;
}

double error_with(const scene::Scene& scene, const RandomChoice& choice, fam::Law law, int arcs,
                  const Equilibrium& truth) {
  fam::Options options;
  options.law = law;
  options.arcs = arcs;
  options.estimate_error = false;
  options.model = choice.shear ? scene::RodModel::reissner : scene::RodModel::kirchhoff;
  return shape_error(fam::solve(scene, options), truth);
}

void find_fewest_arcs(RandomChoice& choice, const scene::Scene& scene, int spans, const Equilibrium& truth) {
  const auto holds = [&](fam::Law law) {
    return [&, law](int arcs) { return error_with(scene, choice, law, arcs, truth) <= choice.tolerance; };
  };
  choice.arcs_looked_for = true;
  choice.fewest_arcs = fewest_sufficient(holds(fam::Law::sixth_order), spans, choice.arcs, 16 * choice.arcs);
  if (choice.fewest_arcs <= spans) return;
  for (const fam::Law law : {fam::Law::fourth_order, fam::Law::midpoint}) {
    if (holds(law)(choice.fewest_arcs - 1)) choice.fewer_by_another_law = true;
  }
}

void take_choice(RandomChoice& choice, const Equilibrium& answer) {
  for (const auto& [key, value] : answer.model) {
    if (key == "arcs") choice.arcs = std::get<int>(value);
    if (key == "shear") choice.shear = std::get<bool>(value);
    if (key == "solver") choice.march = std::get<std::string>(value) == "march";
    if (key == "kernel") choice.space = std::get<std::string>(value) == "spatial";
  }
}

}  // namespace

RandomChoice random_choice(std::uint64_t seed, ToAsk asked) {
  const scene::Scene scene = random_scene(seed);
  const SceneFacts facts = facts_of(scene);
  constexpr std::array tolerances = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  RandomChoice choice;
  choice.seed = seed;
  choice.tolerance = tolerances[seed % tolerances.size()];
  choice.gives_way = facts.gives_way;
  choice.judge = "none";
  const double tolerance_mm = choice.tolerance * facts.length_mm;
  fam::Options options;
  options.tolerance_mm = tolerance_mm;
  const Equilibrium answer = fam::solve(scene, options);
  choice.status = scene::name(answer.status);
  if (!answer.converged()) return choice;
  take_choice(choice, answer);

  Equilibrium truth = finer_answer(scene, scene::RodModel::reissner, tolerance_mm);
  choice.judge = "fam";
  const bool needs_exact = !is_sharp(truth, tolerance_mm);
  const Equilibrium exact = needs_exact || asked.exact ? exact_answer(scene) : Equilibrium();
  if (needs_exact) {
    truth = exact;
    choice.judge = is_sharp(truth, tolerance_mm) ? "exact" : "none";
  }
  if (!choice.judged()) return choice;
  choice.error = shape_error(answer, truth);
  if (asked.exact && exact.converged()) choice.exact_error = shape_error(answer, exact);
  // To the digits of the file, from which --quick judges again.
  if (choice.space) choice.off_plane = std::stod(scientific(distance_from_planes_mm(truth) / facts.length_mm, 1));
  if (choice.shear) {
    const Equilibrium without = finer_answer(scene, scene::RodModel::kirchhoff, tolerance_mm);
    choice.shear_needed = !(shape_error(without, truth) <= choice.tolerance);
  }
  if (asked.fewest_arcs) find_fewest_arcs(choice, scene, facts.spans, truth);
  return choice;
}

std::vector<RandomChoice> random_choices(std::uint64_t count, Progress::Style style) {
  std::vector<RandomChoice> choices(count);
  in_parallel(count, "model-choice, random", style, [&](std::uint64_t i) {
    choices[i] = random_choice(mixed_seed(i), {i % exact_every == 0, i / 10 % 4 == 0});
  });
  return choices;
}

RandomCounts count_choices(const std::vector<RandomChoice>& choices, const std::string& kind) {
  RandomCounts counts;
  for (const RandomChoice& c : choices) {
    if (!kind.empty() && kind_of(c.seed) != kind) continue;
    ++counts.scenes;
    if (c.status != "converged") ++counts.unsolved;
    else if (!c.judged()) ++counts.unjudged;
    if (!c.judged()) continue;
    ++counts.judged;
    counts.insufficient += c.insufficient();
    counts.by_exact += c.judge == "exact";
    counts.space += c.space;
    counts.space_needed += c.space && c.space_needed();
    counts.gives_way += c.gives_way;
    counts.shear += c.shear;
    counts.shear_needed += c.shear && c.shear_needed;
    if (c.exact_error >= 0) {
      ++counts.sampled;
      counts.sampled_insufficient += !(c.exact_error <= c.tolerance);
      counts.disagreed += std::abs(c.exact_error - c.error) > sharp_enough * c.tolerance;
    }
    if (!c.arcs_looked_for) continue;
    ++counts.looked_for;
    counts.other_law += c.fewer_by_another_law;
    if (c.fewest_arcs == 0) continue;
    counts.ratios.push_back(c.arcs_ratio());
    counts.within_1 += c.arcs_ratio() <= 1;
    counts.within_2 += c.arcs_ratio() <= 2;
    counts.within_4 += c.arcs_ratio() <= 4;
    const bool as_small = (!c.space || c.space_needed()) && (!c.shear || c.shear_needed) && !c.fewer_by_another_law;
    counts.smallest += as_small && !c.insufficient() && c.arcs_ratio() <= 2;
  }
  return counts;
}

}  // namespace studies
