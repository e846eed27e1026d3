// What becomes of a rod whose growing load cannot be followed: the fold where it snaps, and where it lands.
#pragma once

#include "fam/tolerance.h"

#include "scene/equilibrium.h"

namespace fam {

// After a growth that failed on the way, the path from no load: limit_point with its first fold, or with
// Options::after_snap the next equilibrium under the full load; where it has no fold, the equilibrium that it leads to,
// or tendon_collapsed. Empty: the path could not be followed so far.
std::optional<scene::Equilibrium> beyond_growth(const scene::Scene& scene, const Options& options);

}  // namespace fam
