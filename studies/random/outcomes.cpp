#include "studies/random/outcomes.h"

#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "fem_reference/solve.h"
#include "scene/load_visitor.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <set>
#include <sstream>

namespace studies {
namespace {

std::string loads_of(const scene::Scene& scene, std::uint64_t seed) {
  if (seed >= first_buckling_seed) return kind_of(seed);
  bool follower = false, fixed = false;
  for (const scene::Load& load : scene.loads) {
    const std::optional<scene::Frame> frame = scene::frame_of(load);
    if (!frame || scene::is_zero(load)) continue;
    (frame == scene::Frame::fixed ? fixed : follower) = true;
    if (!scene::is_conservative(load)) follower = true;  // a fixed moment, too
  }
  return !fixed ? "follower" : follower ? "mixed" : "dead";
}

scene::Equilibrium solve_fam(const scene::Scene& scene, double tolerance) {
  fam::Options options;
  options.tolerance_mm = tolerance * scene::length_mm(scene);
  return fam::solve(scene, options);
}

scene::Equilibrium solve_fem(const scene::Scene& scene, int elements) {
  fem_reference::Options options;
  options.elements = elements;
  options.max_load_steps = 2000;
  return fem_reference::solve(scene, options);
}

}  // namespace

void random_outcomes(std::uint64_t seed, bool with_finite_elements,
                     const std::function<void(const RandomOutcome&)>& report) {
  const scene::Scene scene = random_scene(seed);
  const double length_mm = scene::length_mm(scene);
  const scene::Equilibrium truth =
      exact_reference::solve(scene, {exact_reference::RodModel::reissner, random_exact_tolerance});
  const std::string loads = loads_of(scene, seed);
  report({seed, loads, "exact", truth.converged() ? "converged" : "not converged", 0,
          truth.error_estimate_mm / length_mm});
  const auto add = [&](const std::string& method, const scene::Equilibrium& answer,
                       const std::function<scene::Equilibrium()>& refined) {
    if (!truth.converged()) {
      report({seed, loads, method, answer.converged() ? "no judge" : "not converged either", 0,
              answer.error_estimate_mm / length_mm});
      return;
    }
    const Judgement judged = judge(answer, truth, length_mm, refined);
    const bool missed = method == "fam" && is_right(judged.verdict) && judged.error > 3 * random_fam_tolerance;
    report({seed, loads, method, missed ? "tolerance missed" : name(judged.verdict), judged.error, judged.estimate});
  };
  add("fam", solve_fam(scene, random_fam_tolerance), [&] { return solve_fam(scene, 1e-2 * random_fam_tolerance); });
  if (with_finite_elements) add("fem", solve_fem(scene, 50), [&] { return solve_fem(scene, 200); });
}

scene::Equilibrium solve_in_small_steps(const scene::Scene& scene) {
  fem_reference::Options options;
  options.elements = 100;
  options.estimate_error = false;
  options.initial_load_step = 0.01;
  options.largest_rotation_rad = 0.1;
  options.max_load_steps = 3000;
  return fem_reference::solve(scene, options);
}

RandomOutcome second_opinion(std::uint64_t seed) {
  const scene::Scene scene = random_scene(seed);
  const double length_mm = scene::length_mm(scene);
  const scene::Equilibrium truth =
      exact_reference::solve(scene, {exact_reference::RodModel::reissner, random_exact_tolerance});
  const scene::Equilibrium answer = solve_in_small_steps(scene);
  const Judgement judged = judge(answer, truth, length_mm, [&] { return answer; });
  return {seed, loads_of(scene, seed), "fem in small steps", name(judged.verdict), judged.error, judged.estimate};
}

bool is_listed(const RandomOutcome& outcome) {
  static const std::set<std::string> fine = {"converged",     "right to 1e-6",        "right to 1e-4",
                                             "right to 1e-2", "not converged either", "wrong but flagged"};
  return fine.count(outcome.outcome) == 0;
}

bool stopped_the_judge(const RandomOutcome& outcome) {
  return outcome.method == "exact" && (outcome.outcome == "work limit" || outcome.outcome == "crash");
}

std::string to_line(const RandomOutcome& o) {
  return fmt::format("{},{},{},{},{:.1e},{:.1e}", o.seed, o.loads, o.method, o.outcome, o.error, o.estimate);
}

RandomOutcome from_line(const std::string& line) {
  std::istringstream cells(line);
  const auto next = [&] {
    std::string cell;
    std::getline(cells, cell, ',');
    return cell;
  };
  RandomOutcome o;
  o.seed = std::stoull(next());
  o.loads = next(), o.method = next(), o.outcome = next();
  o.error = std::strtod(next().c_str(), nullptr), o.estimate = std::strtod(next().c_str(), nullptr);
  return o;
}

}  // namespace studies
