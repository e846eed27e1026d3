#include "studies/random/promise.h"

#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "scene/load_visitor.h"
#include "studies/compare/error_measures.h"
#include "studies/report/progress.h"
#include "studies/scenes/random_scene.h"

#include <algorithm>
#include <array>
#include <variant>

namespace studies {
namespace {

// A tenth of a millionth of L from the exact reference is as good as nothing for tolerances down to 1e-8 L.
constexpr double judge_tolerance = 1e-11;
// Farther than this from the exact shape an answer is not an inexact one but another equilibrium, or plainly wrong.
constexpr double other_branch = 3e-2;

double shape_distance(const scene::Equilibrium& a, const scene::Equilibrium& b, double length_mm) {
  return largest_distance_mm(a, b) / length_mm;
}

double tip_distance(const scene::Equilibrium& a, const scene::Equilibrium& b, double length_mm) {
  return (a.tip().position_B_mm - b.tip().position_B_mm).norm() / length_mm;
}

// The sum of all loads' sizes, moments over L.
double load_size_N(const scene::Scene& scene, double length_mm) {
  double size = 0;
  for (const scene::Span& span : scene::spans_of(scene)) {
    for (const scene::Wrench* load : {&span.follower_load_S, &span.fixed_load_B}) {
      size += load->force_N.norm() + load->moment_Nmm.norm() / length_mm;
    }
    size += span.fixed_force_arms_BS_Nmm.norm() / length_mm;
    size += span.length_mm() * (span.follower_force_S_N_per_mm.norm() + span.fixed_force_B_N_per_mm.norm());
  }
  for (const scene::Load& load : scene.loads) {
    if (const scene::Tendon* tendon = scene::tendon_of(load)) size += tendon->tension_N;
  }
  return size;
}

// Of the base.
double wrench_distance(const scene::Equilibrium& answer, const scene::Equilibrium& truth, double length_mm,
                       double load_size_N) {
  if (load_size_N == 0) return 0;
  const double force = (answer.base().force_B_N - truth.base().force_B_N).norm();
  const double moment = (answer.base().moment_B_Nmm - truth.base().moment_B_Nmm).norm();
  return std::max(force, moment / length_mm) / load_size_N;
}

// Found by bisection: the error falls with the arcs.
int needed_arcs(const scene::Scene& scene, const scene::Equilibrium& truth, double tolerance, int used) {
  const double length_mm = scene::length_mm(scene);
  const auto holds = [&](int arcs) {
    fam::Options options;
    options.arcs = arcs;
    options.estimate_error = false;
    options.tolerance_mm = tolerance * length_mm;
    const scene::Equilibrium answer = fam::solve(scene, options);
    return answer.converged() && shape_distance(answer, truth, length_mm) <= tolerance;
  };
  int low = 0, high = used;
  while (!holds(high)) {
    low = high;
    high *= 2;
    if (high > 16 * used) return used;
  }
  while (high - low > std::max(1, used / 16)) {
    const int middle = (low + high) / 2;
    (holds(middle) ? high : low) = middle;
  }
  return std::max(high, static_cast<int>(scene::spans_of(scene).size()));
}

}  // namespace

std::uint64_t estimate_seed(std::uint64_t index) {
  return first_family_seed + families.size() * (index / 2) + index % 2;
}

Promise promise_of(std::uint64_t seed, bool count_needed) {
  const scene::Scene scene = random_scene(seed);
  const double length_mm = scene::length_mm(scene);
  constexpr std::array tolerances = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  Promise promise;
  promise.seed = seed;
  promise.tolerance = tolerances[seed % tolerances.size()];
  fam::Options options;
  options.tolerance_mm = promise.tolerance * length_mm;
  const scene::Equilibrium answer = fam::solve(scene, options);
  promise.status = scene::name(answer.status);
  const scene::Equilibrium truth =
      exact_reference::solve(scene, {exact_reference::RodModel::reissner, judge_tolerance});
  promise.judged = truth.converged();
  if (!promise.solved()) return promise;
  const double judge_error = truth.error_estimate_mm / length_mm;
  promise.estimate = answer.error_estimate_mm / length_mm;
  promise.error = std::max(0.0, shape_distance(answer, truth, length_mm) - judge_error);
  promise.tip_error = std::max(0.0, tip_distance(answer, truth, length_mm) - judge_error);
  promise.wrench_error =
      std::max(0.0, wrench_distance(answer, truth, length_mm, load_size_N(scene, length_mm)) - judge_error);
  promise.same_branch = promise.error <= std::max(other_branch, 3 * promise.tolerance);
  for (const auto& [key, value] : answer.model) {
    if (key == "arcs") promise.arcs = std::get<int>(value);
  }
  if (count_needed && promise.same_branch) {
    promise.needed = needed_arcs(scene, truth, promise.tolerance, promise.arcs);
  }
  return promise;
}

std::vector<Promise> all_promises(std::uint64_t scenes, std::uint64_t (*seed_of)(std::uint64_t),
                                  Progress::Style style) {
  std::vector<Promise> promises(scenes);
  in_parallel(scenes, "promise", style, [&](std::uint64_t i) {
    const bool count_needed = i / 10 % 4 == 0;  // a quarter of the scenes, all kinds and tolerances
    promises[i] = promise_of(seed_of(i), count_needed);
  });
  return promises;
}

PromiseCounts count(const std::vector<Promise>& promises) {
  PromiseCounts counts;
  std::vector<double> waste;
  for (const Promise& promise : promises) {
    counts.scenes += promise.judged;
    if (!promise.solved()) continue;
    ++counts.solved;
    if (!promise.same_branch) {
      ++counts.other_branch;
      continue;
    }
    counts.kept += promise.error <= promise.tolerance;
    counts.tips_kept += promise.tip_error <= promise.tolerance;
    counts.wrenches_kept += promise.wrench_error <= promise.tolerance;
    counts.low_estimates += promise.error > smallest_judged_error && promise.estimate < promise.error / 2;
    counts.worst = std::max(counts.worst, promise.error / promise.tolerance);
    counts.worst_wrench = std::max(counts.worst_wrench, promise.wrench_error / promise.tolerance);
    if (promise.needed > 0) waste.push_back(static_cast<double>(promise.arcs) / promise.needed);
  }
  if (!waste.empty()) {
    counts.median_waste = quantile(waste, 0.5);
    counts.waste_90 = quantile(waste, 0.9);
  }
  return counts;
}

}  // namespace studies
