// Runs random scenes in blocks of 500 seeds, each block's outcomes in a file of its own: a run resumes where it was
// stopped, and several processes share one folder. A scene that takes more than twenty seconds of processor time is
// stopped and counted as "work limit".
#pragma once

#include "studies/random/outcomes.h"
#include "studies/report/progress.h"

#include <filesystem>

namespace studies {

// FROM and TO: multiples of 500. On two processors. Every 100th scene by finite elements, too.
void run_blocks(std::uint64_t from, std::uint64_t to, const std::filesystem::path& folder, Progress::Style style);

// Of all blocks of a folder, by seed.
std::vector<RandomOutcome> all_outcomes(const std::filesystem::path& folder);

// Adds second opinions (outcomes.h) on every scene of the folder in which FAM is wrong and silent.
void second_opinions(const std::filesystem::path& folder);

// 1, and a line on standard error each, if the folder holds a listed outcome of a seed that the list (failures.csv)
// does not; else 0. "work limit" depends on the machine and does not count.
int check_outcomes(const std::filesystem::path& folder, const std::filesystem::path& list);

}  // namespace studies
