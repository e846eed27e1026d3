#include "studies/promise.h"

#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "studies/random_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace studies {
namespace {

// A tenth of a millionth of L from the exact reference is as good as nothing for tolerances down to 1e-9 L.
constexpr double judge_tolerance = 1e-11;
// Farther than this from the exact tip an answer is not an inexact one but another equilibrium, or plainly wrong.
constexpr double other_branch = 3e-2;

double tip_distance(const scene::Equilibrium& a, const scene::Equilibrium& b, double length_mm) {
  return (a.tip().position_B_mm - b.tip().position_B_mm).norm() / length_mm;
}

// The fewest arcs, 1, 2, 3, ... times n/8 of those used, from which the true error is within the tolerance. Found by
// bisection: the error falls with the arcs.
int needed_arcs(const scene::Scene& scene, const scene::Equilibrium& truth, double tolerance, int used) {
  const double length_mm = scene::length_mm(scene);
  const auto holds = [&](int arcs) {
    fam::Options options;
    options.arcs = arcs;
    options.estimate_error = false;
    options.tolerance_mm = tolerance * length_mm;
    const scene::Equilibrium answer = fam::solve(scene, options);
    return answer.converged() && tip_distance(answer, truth, length_mm) <= tolerance;
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

std::optional<Promise> promise_of(std::uint64_t seed, bool count_needed) {
  const scene::Scene scene = random_scene(seed);
  const double length_mm = scene::length_mm(scene);
  const scene::Equilibrium truth =
      exact_reference::solve(scene, {exact_reference::RodModel::reissner, judge_tolerance});
  if (!truth.converged()) return std::nullopt;
  constexpr std::array tolerances = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
  Promise promise;
  promise.seed = seed;
  promise.tolerance = tolerances[seed % tolerances.size()];
  promise.judge_error = truth.error_estimate_mm / length_mm;
  fam::Options options;
  options.tolerance_mm = promise.tolerance * length_mm;
  const scene::Equilibrium answer = fam::solve(scene, options);
  promise.converged = answer.converged();
  if (!promise.converged) return promise;
  promise.estimate = answer.error_estimate_mm / length_mm;
  promise.error = std::max(0.0, tip_distance(answer, truth, length_mm) - promise.judge_error);
  promise.same_branch = promise.error <= std::max(other_branch, 3 * promise.tolerance);
  for (const auto& [key, value] : answer.model) {
    if (key == "arcs") promise.arcs = std::get<int>(value);
  }
  if (count_needed && promise.same_branch) {
    promise.needed = needed_arcs(scene, truth, promise.tolerance, promise.arcs);
  }
  return promise;
}

PromiseCounts count(const std::vector<Promise>& promises) {
  PromiseCounts counts;
  std::vector<double> waste;
  for (const Promise& promise : promises) {
    if (!promise.converged) {
      ++counts.not_converged;
      continue;
    }
    ++counts.solved;
    const double excess = promise.error / promise.tolerance;
    if (!promise.same_branch) ++counts.other_branch;
    else if (excess <= 1) ++counts.kept;
    else counts.worst_excess = std::max(counts.worst_excess, excess);
    if (promise.needed > 0) waste.push_back(static_cast<double>(promise.arcs) / promise.needed);
  }
  std::sort(waste.begin(), waste.end());
  if (!waste.empty()) {
    counts.median_waste = waste[waste.size() / 2];
    counts.waste_90 = waste[waste.size() * 9 / 10];
  }
  return counts;
}

}  // namespace studies
