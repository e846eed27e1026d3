// fam-studies random: scenes by the thousand. Without a further word the study of them (random.cpp); else
//   scene SEED            one scene as a file on standard output
//   run FROM TO FOLDER    solves and judges scenes in blocks (blocks.h)
//   second FOLDER         a second opinion where FAM is wrong and silent
//   sum FOLDER OUTPUT     counts.csv and failures.csv from the blocks
//   promise N OUTPUT      N scenes: is the tolerance kept (promise.h)?
//   estimates N OUTPUT    N strips and heavy rods: is an estimate below half the error?
//   check FOLDER LIST     exit status 1 on a listed outcome of a seed that LIST does not hold
#pragma once

#include "studies/report/progress.h"

#include <CLI/CLI.hpp>

namespace studies {

// Adds these to the command; parsing sets `chosen` to their work, which returns the exit status.
void add_random_commands(CLI::App& random, const Progress::Style& progress, std::function<int()>& chosen);

}  // namespace studies
