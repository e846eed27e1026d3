// fam-studies limits: 110 000 random scenes; those that fam::solve has no answer to, with the reason, and the exact
// reference's on a sample. With --quick the first 200 are solved, the others read back from results/.
#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "scene/load_visitor.h"
#include "studies/limits/data.h"
#include "studies/report/provenance.h"
#include "studies/scenes/random_scene.h"
#include "studies/study.h"

#include <algorithm>
#include <optional>

namespace studies {
namespace {

constexpr double tolerance = 1e-4;  // over L
constexpr std::uint64_t solved_quickly = 200, judged_every = 10;

std::optional<Unanswered> unanswered(std::uint64_t seed) {
  const scene::Scene scene = random_scene(seed);
  fam::Options options;
  options.tolerance_mm = tolerance * scene::length_mm(scene);
  options.whole_rod = false;
  const scene::Equilibrium answer = fam::solve(scene, options);
  if (answer.converged()) return std::nullopt;
  Unanswered result;
  result.seed = seed;
  result.has_energy = std::all_of(scene.loads.begin(), scene.loads.end(),
                                  [](const scene::Load& load) { return scene::is_conservative(load); });
  result.status = scene::name(answer.status);
  if (answer.limit) result.load_factor = answer.limit->load_factor;
  if (seed % judged_every != 0 && !result.is_numerical()) return result;
  const scene::Equilibrium exact = exact_reference::solve(scene, {exact_reference::RodModel::reissner, 1e-9});
  result.judge = scene::name(exact.status);
  if (exact.limit) result.judge_factor = exact.limit->load_factor;
  return result;
}

std::uint64_t index_of(std::uint64_t seed) {
  return seed < first_buckling_seed ? seed + seed / 10 : 11 * (seed - first_buckling_seed) + 10;
}

}  // namespace

// Every eleventh buckles, so that the first ones hold both kinds.
std::uint64_t limit_seed(std::uint64_t index) {
  return index % 11 == 10 ? first_buckling_seed + index / 11 : index - index / 11;
}

void limits(const StudyOptions& options) {
  const std::uint64_t solved = options.quick ? solved_quickly : limit_scenes;
  std::vector<std::optional<Unanswered>> found(solved);
  in_parallel(solved, "limits", options.progress, [&](std::uint64_t i) { found[i] = unanswered(limit_seed(i)); });
  std::vector<Unanswered> scenes;
  for (const auto& one : found) {
    if (one) scenes.push_back(*one);
  }
  if (options.quick) {
    const std::vector<Unanswered> all = read_unanswered(options.committed / "limits" / "unanswered.csv");
    const auto rest =
        std::find_if(all.begin(), all.end(), [&](const Unanswered& u) { return index_of(u.seed) >= solved; });
    scenes.insert(scenes.end(), rest, all.end());
  }
  write_results(options.output / "limits", "fam-studies limits",
                limit_files(scenes, options.pages / "limits" / "page.md"));
}

}  // namespace studies
