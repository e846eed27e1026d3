// The automatic choice and plain shooting side by side on random scenes.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/study.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace studies {

// One scene and target; errors are tip errors over L against the exact rod with shear and stretch.
struct RandomRace {
  std::uint64_t seed = 0;
  double target = 0;
  bool judged = false;  // the exact reference has an answer
  std::string status;   // of fam::solve, asked for the target
  double error = 0;     // of its answer
  int steps = 0;        // fewest of plain shooting within the target; 0: none
  double shooting_error = 0;
  std::optional<Timing> fam, shooting;
  double fam_instructions = std::numeric_limits<double>::quiet_NaN(), shooting_instructions = fam_instructions;

  bool fam_is_right() const { return status == "converged" && error <= target; }
  // Time of shooting over that of fam::solve, infinite where shooting fails.
  double ratio() const;
  // The same of instructions, where both are right; else, and where none were counted, NaN.
  double ratio_of_instructions() const;
};

inline const std::vector<double> race_targets = {1e-3, 1e-5};
inline const std::string races_file = "accuracy_random.csv";

// The first thousand of the mix (mixed_seed) that have a load fixed in space, two targets each. With --quick the first
// twenty are solved, the others read back from the committed results; no times then.
std::vector<RandomRace> random_races(const StudyOptions& options);
// Where both are right.
void count_instructions(std::vector<RandomRace>& races);
// One of a race's solves, to be counted or timed: by "fam", asked for a target, or by "rk4" of so many steps.
std::function<void()> raced_solve(std::uint64_t seed, const std::string& by, double target_or_steps);

std::string races_csv(const std::vector<RandomRace>& races);
std::string races_timing_csv(const std::vector<RandomRace>& races);
// What is right, which a run with --quick has too, and the times, by kind.
std::string races_right(const std::vector<RandomRace>& races);
std::string races_answer(const std::vector<RandomRace>& races);
std::string races_table(const std::vector<RandomRace>& races);
std::string races_picture(const std::vector<RandomRace>& races);

}  // namespace studies
