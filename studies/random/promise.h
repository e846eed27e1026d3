// How often the automatic choice of arcs keeps its promise for the whole shape, over random scenes and tolerances.
#pragma once

#include "studies/report/progress.h"

#include <cstdint>
#include <string>
#include <vector>

namespace studies {

// One scene solved for a tolerance; lengths over L.
struct Promise {
  std::uint64_t seed = 0;
  double tolerance = 0;
  bool judged = true;  // the exact reference gave an answer; nothing but the status is known of FAM's where it did not
  std::string status;  // of fam::solve
  bool same_branch = true;  // false where the answer is another equilibrium than the exact reference's
  double estimate = 0;
  double error = 0;         // largest of any station; the exact reference's own estimate taken off
  double tip_error = 0;     // likewise
  double wrench_error = 0;  // of the base's force, or its moment over L, over the sum of all loads' sizes
  int arcs = 0;
  int needed = 0;  // fewest arcs, shared out by length, whose true error is within the tolerance; 0: not looked for

  bool solved() const { return judged && status == "converged"; }
};

// The seed of scene 0, 1, 2, ... of the estimates: strips and heavy rods in turn.
std::uint64_t estimate_seed(std::uint64_t index);

// The tolerance goes round 1e-2 .. 1e-8 L with the seed. count_needed: look for `needed` as well.
Promise promise_of(std::uint64_t seed, bool count_needed);

// The promises of scenes 0..scenes-1, by two threads.
std::vector<Promise> all_promises(std::uint64_t scenes, std::uint64_t (*seed_of)(std::uint64_t), Progress::Style style);

// Over L; smaller errors are not told from the judge's own and from round-off.
constexpr double smallest_judged_error = 3e-9;

struct PromiseCounts {
  int scenes = 0;                         // judged
  int solved = 0;                         // of them by FAM
  int kept = 0;                           // of these, whole shape within the tolerance
  int tips_kept = 0;                      // of these, tip within the tolerance
  int wrenches_kept = 0;                  // of these, base wrench within the tolerance over L
  int other_branch = 0;                   // of these, another equilibrium
  int low_estimates = 0;                  // of these, an estimate below half the error, where that exceeds 3e-9 L
  double worst = 0, worst_wrench = 0;     // largest error over tolerance on the same branch
  double median_waste = 0, waste_90 = 0;  // arcs used over arcs needed
};
PromiseCounts count(const std::vector<Promise>& promises);

}  // namespace studies
