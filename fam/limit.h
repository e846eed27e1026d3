// What becomes of a rod whose growing load cannot be followed: the fold where it snaps, and where it lands.
#pragma once

#include "fam/tolerance.h"

#include "scene/equilibrium.h"

namespace fam {

// After a failed growth that reached a share of the load: limit_point with the fold, or with Options::after_snap the
// next equilibrium under the full load; the path is followed from a little before. Empty: there is no fold on the way,
// or the path could not be followed.
std::optional<scene::Equilibrium> beyond_growth(const scene::Scene& scene, const Options& options, double reached);

}  // namespace fam
