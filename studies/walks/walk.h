// Random walks of a rod's loads by a kept solver, each step judged by the cold solve, and where the two differ by the
// exact reference whose loads take the same way.
#pragma once

#include "studies/report/progress.h"

#include <cstdint>
#include <string>
#include <vector>

namespace studies {

constexpr int steps_of_walk = 3;
constexpr double walk_tolerance = 1e-4, walk_exact_tolerance = 1e-9;  // over L

// One step: from loads that were solved, or from the walk's first ones, on to others. The exact reference goes the same
// way.
//
// clang-format off
//   as cold               the cold solve's shape, to twice the tolerance
//   as exact              another shape, or the cold solve has none: the exact reference's, to the tolerance
//   told by the estimate  farther from that, and the solver's error estimate is as large
//   tolerance missed      the estimate is smaller; up to 1e-2 L
//   wrong                 farther still
//   no judge              another shape than the cold one, and the exact reference does not come through
//   stopped, rightly      limit_point or another failure, and the exact reference stops on this step, too
//   stopped               it comes through
//   stopped, no judge     it stopped on a step before
// clang-format on
struct WalkStep {
  std::uint64_t seed = 0;  // of random_scene
  int step = 0;
  std::string status;  // of the kept solver
  std::string outcome;
  double error = 0;  // over L: from the cold solve, or from the exact reference where that was asked
};

// The steps of the walk that starts from a random scene; none where its first loads are not solved. Judge::exact: the
// cold solve is not asked, and no step is "as cold".
enum class Judge { cold_first, exact };
std::vector<WalkStep> walk(std::uint64_t seed, Judge judge = Judge::cold_first);

// By two threads, in the order of the seeds mixed_seed(0), mixed_seed(1), ...
std::vector<WalkStep> all_walks(std::uint64_t walks, Progress::Style style);

}  // namespace studies
