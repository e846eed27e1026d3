// Where a step has gone astray.
#pragma once

#include "fem_reference/beam_model.h"

#include <optional>

namespace fem_reference {

// Whether a tendon has collapsed anywhere on the way between two states (tendon_pull.h).
bool tendon_collapses(const BeamModel& model, const BeamState& from, const BeamState& to);

// The first element that turns by pi or more from end to end, which the mesh cannot show.
std::optional<std::size_t> turned_over(const BeamModel& model, const BeamState& state);

}  // namespace fem_reference
