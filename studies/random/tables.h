// The tables of the random scenes that its page shows.
#pragma once

#include "studies/random/outcomes.h"
#include "studies/random/promise.h"
#include "studies/report/table.h"

namespace studies {

// Rows: kind of scene and method; columns: what came of the answers. A row sums up to all scenes asked.
Table outcomes_by_method(const std::vector<RandomOutcome>& outcomes);

Table by_tolerance(const std::vector<Promise>& promises);
Table by_kind(const std::vector<Promise>& promises);
// Scenes without an answer of FAM, by status and kind, judged or not.
Table unsolved(const std::vector<Promise>& promises);

bool is_low_estimate(const Promise& promise);

}  // namespace studies
