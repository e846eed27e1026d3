// What solve() returns of a run.
#pragma once

#include "fam/tolerance.h"

#include <string>

namespace fam {

// Stability is judged with twice the arcs until two judgements agree.
constexpr int most_stability_doublings = 6;

scene::Equilibrium success(const Task& task, const Run& run, double error_mm, const std::string& reason);

scene::Equilibrium failure(const Run& run);
scene::Equilibrium too_long_for_series(const ArcExtent& extent);
scene::Equilibrium tolerance_not_met(const Task& task, const Run& run, double error_mm);

}  // namespace fam
