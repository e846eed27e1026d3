// How often the automatic choice of arcs keeps its promise, over random scenes and tolerances.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace studies {

// One scene solved for a tolerance; lengths over L.
struct Promise {
  std::uint64_t seed = 0;
  double tolerance = 0;
  bool converged = false;   // of fam::solve
  bool same_branch = true;  // the exact reference's error judges; false where the answer is another equilibrium
  double estimate = 0, error = 0;
  double judge_error = 0;  // the exact reference's own
  int arcs = 0;
  int needed =
      0;  // arcs whose true error is within the tolerance, the fewest of those shared out by length; 0: not looked for
};

// Empty where the exact reference gives no answer. The tolerance goes round 1e-2 .. 1e-9 with the seed. Scenes:
// random_scene.h. count_needed: look for `needed` as well.
std::optional<Promise> promise_of(std::uint64_t seed, bool count_needed);

struct PromiseCounts {
  int solved = 0;                         // by FAM, where the exact reference gives an answer
  int kept = 0;                           // of them with a true error within the tolerance
  int other_branch = 0;                   // of them on another equilibrium than the exact reference
  int not_converged = 0;                  // FAM said so
  double worst_excess = 0;                // largest true error over tolerance of a broken promise on the same branch
  double median_waste = 0, waste_90 = 0;  // arcs used over arcs needed
};
PromiseCounts count(const std::vector<Promise>& promises);

// promise.csv, promise.svg and README.md of results/work_precision/promise.
std::map<std::string, std::string> promise_files(const std::vector<Promise>& promises);

}  // namespace studies
