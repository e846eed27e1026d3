// What solve() returns of a run.
#pragma once

#include "fam/solution.h"

#include <limits>

namespace fam {

// Stability is judged with twice the arcs until two judgements agree.
constexpr int most_stability_doublings = 6;
// Empty: the loads have no energy, or not decided with at most `arcs_at_most`. other: null, or a solution of the
// problem with other numbers of arcs, which may be one of the spare ones.
std::optional<bool> is_stable(const Problem& problem, const Run& run, const Run* other, Run& spare, Run& another_spare,
                              int arcs_at_most = std::numeric_limits<int>::max());

// solution: memory.
scene::Equilibrium success(const Problem& problem, const Run& run, double error_mm, std::optional<bool> stable,
                           const char* how, Solution& solution);
scene::Equilibrium failure(const Run& run);
scene::Equilibrium too_long_for_series(const ArcExtent& extent);
scene::Equilibrium tolerance_not_met(const Problem& problem, const Run& run, double error_mm);

}  // namespace fam
