// fam-studies random: scenes by the thousand. In blocks of 1000 seeds, each block's outcomes in a file of its own, so
// that a run resumes where it was stopped and several processes share one folder.
//   scene SEED            one scene as a file on standard output
//   run FROM TO FOLDER    FROM and TO multiples of the block; every 100th scene by finite elements too
//   second FOLDER         a second opinion on every scene in which FAM is wrong and silent
//   sum FOLDER OUTPUT     counts.csv, failures.csv and README.md from the blocks
//   promise N OUTPUT      N scenes: is the tolerance kept (promise.h)?
//   estimates N OUTPUT    N strips and heavy rods: is an estimate below half the error?
//   check FOLDER LIST     exit status 1 on a listed outcome (random.h) of a seed that LIST does not hold
#pragma once

#include "studies/report/progress.h"

#include <CLI/CLI.hpp>

namespace studies {

// Adds the command; parsing sets `chosen` to its work, which returns the exit status.
void add_random_command(CLI::App& app, const Progress::Style& progress, std::function<int()>& chosen);

}  // namespace studies
