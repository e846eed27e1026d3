#include "studies/random/random.h"

#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "fem_reference/solve.h"
#include "scene/load_visitor.h"
#include "studies/report/table.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <array>
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

// "0–4999, 100000–101999".
std::string ranges(const std::set<std::uint64_t>& seeds) {
  std::string text;
  for (auto seed = seeds.begin(); seed != seeds.end();) {
    const std::uint64_t first = *seed;
    std::uint64_t last = first;
    while (++seed != seeds.end() && *seed == last + 1) last = *seed;
    text += (text.empty() ? "" : ", ") + fmt::format("{}–{}", first, last);
  }
  return text;
}

std::map<std::string, std::string> random_files(const std::vector<RandomOutcome>& outcomes) {
  std::map<std::array<std::string, 3>, int> counts;
  std::map<std::array<std::string, 2>, std::array<int, 3>> of_method;  // general scenes, buckling ones, families
  std::set<std::uint64_t> seeds;
  Table failures({"seed", "loads", "method", "outcome", "error_over_L", "estimate_over_L"});
  for (const RandomOutcome& o : outcomes) {
    ++counts[{o.loads, o.method, o.outcome}];
    ++of_method[{o.method, o.outcome}][o.seed < first_buckling_seed ? 0 : o.seed < first_family_seed ? 1 : 2];
    seeds.insert(o.seed);
    if (is_listed(o)) {
      failures.add({std::to_string(o.seed), o.loads, o.method, o.outcome, scientific(o.error, 0),
                    o.estimate < 1e-7 ? "<1e-07" : scientific(o.estimate, 0)});
    }
  }
  Table table({"loads", "method", "outcome", "scenes"});
  for (const auto& [key, count] : counts) table.add({key[0], key[1], key[2], std::to_string(count)});
  Table summary({"method", "outcome", "general scenes", "rods that buckle", "families"});
  for (const auto& [key, count] : of_method) {
    summary.add({key[0], key[1], std::to_string(count[0]), std::to_string(count[1]), std::to_string(count[2])});
  }
  const auto silent = [&](const std::string& method) {
    int sum = 0;
    for (const char* outcome : {"wrong and not flagged", "wrong branch"}) {
      for (const int count : of_method[{method, outcome}]) sum += count;
    }
    return sum;
  };
  const std::string second_opinion =
      summary.markdown().find("fem in small steps") == std::string::npos
          ? ""
          : "- *fem in small steps*: a second opinion on the judge, where FAM is wrong and silent: 100 elements, at "
            "most\n  0.1 rad a load step; where they are on a *wrong branch* too they contradict the judge.\n";
  const std::string text = fmt::format(
      R"(# Random scenes

{} random scenes (`studies/random_scene.cpp`): seeds below 100 000 over all load kinds, 1 to 20 sections, loads up to 1000
EI/L²; from 100 000 rods that buckle, pressed up to 50 times Euler's load almost along the axis or strips bent almost in
their stiff plane, and pushed aside by 1e-7 to 0.1 EI/L²; from 200 000 strips, heavy rods, coiled rods, robots with
tendons, cables and rods of soft shear in turn. Seeds: {}. FAM chooses its arcs for a tip error
of 1e-4 L; the exact reference resolves 1e-9 L and judges; 50 quadratic finite elements join on one scene of 100.

Wrong without saying so, on this branch or another: FAM {}, finite elements {}.

{}
- *wrong branch*, *wrong and not flagged*: error above 1e-2 L, own estimate less than a third of it; the branch is another
  one if a tolerance a hundred times smaller moves the tip by less than a tenth of the error.
- *tolerance missed*: error above 3e-4 L, up to 1e-2 L. *work limit*: stopped after five seconds of processor time.
{}- *not converged either*, *no judge*: the exact reference gave up; the method did as well, or did not.

Seeds of every answer that is wrong and silent, missing or unjudged: [failures.csv](failures.csv). By kind of load:
[counts.csv](counts.csv) (follower: with follower loads and tendons alone; dead: with fixed forces, weight and tendons
alone, which have an energy; mixed: the rest; buckling and the families by their names).

    build/release/bin/random_scenes scene SEED > scene.json    # one of them as a scene file
    build/release/bin/random_scenes run FROM TO FOLDER         # thousands again; resumes, and may run beside itself
)",
      seeds.size(), ranges(seeds), silent("fam"), silent("fem"), summary.markdown(), second_opinion);
  return {{"counts.csv", table.csv()}, {"failures.csv", failures.csv()}, {"README.md", text}};
}
}  // namespace studies
