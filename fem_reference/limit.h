// Where load stepping cannot go on: along the path of equilibria from no load to the fold that the growing load meets,
// or past what stopped the steps to the full load.
#pragma once

#include "fem_reference/load_stepping.h"

namespace fem_reference {

// result: of step_to_full_load(), ended by a load step too small. It becomes `limit_point` with the load factor of the
// first fold; `converged` where the path comes to the full load before one, over branch points on the branch that it
// is on; else it stays.
void look_for_a_limit(const BeamModel& full_load, const SteppingOptions& options, SteppingResult& result);

}  // namespace fem_reference
