// An equilibrium as the commands print it.
#pragma once

#include "scene/equilibrium.h"

namespace scene {

// One JSON object with the keys that docs/commands.md lists, plus `message`. Where the solve did
// not converge, tip, base and error_estimate_mm are null and centreline is empty. time_us: the solve alone.
std::string to_json(const Equilibrium& result, const std::string& method, double time_us);

// The centreline, clamp to tip: s, position and rotation (row by row) of each station. Empty when not converged.
std::string to_csv(const Equilibrium& result);

// For a person: tip, base, model and its reason.
std::string to_text(const Equilibrium& result, const std::string& method, double time_us);

}  // namespace scene
