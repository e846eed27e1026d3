// Where a load that grows meets a fold.
#pragma once

#include "exact_reference/shooting.h"

#include <optional>

namespace exact_reference {

// The load factor of the next fold up to the full load, on the branch from an equilibrium at `load_factor`; empty: the
// branch goes on to the full load, or cannot be followed.
std::optional<double> fold_ahead(const ScaledRod& rod, const MeshedStates& from, double load_factor);

}  // namespace exact_reference
