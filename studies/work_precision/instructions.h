// Instructions of single solves, counted by callgrind: unlike times they do not depend on what else the machine does.
#pragma once

#include "studies/work_precision/data.h"

#include <string>
#include <vector>

namespace studies {

// Of each contestant the coarsest resolution within 1e-3 and within 1e-5 of the length, of FAM's automatic choice the
// solve asked for that. This program runs itself under valgrind; empty without it.
std::vector<CountedSolve> counted_solves(const WorkData& data);

// Of solves that lines name, as run_counted_solves() reads them; NaN: not counted.
std::vector<double> instructions_of(const std::vector<std::string>& lines);
// What runs there: the solves that a list names, one a line, each counted under its line's number. A line has a scene's
// folder and name, and a competitor's series, model and resolution; or "random", and what raced_solve() takes.
int run_counted_solves(const std::filesystem::path& list, const std::filesystem::path& cases);

// Median (quartiles) over the scenes of a group, in thousands.
std::string instructions_table(const WorkData& data);
std::string instructions_csv(const WorkData& data);

}  // namespace studies
