// The derivatives that `fam solve --derivatives` adds.
#pragma once

#include "fam/options.h"
#include "scene/scene.h"

#include <string>

namespace apps {

// The JSON text of a solved scene with the key `derivatives` added: of the tip's pose, six rows (position_B in mm, a
// small rotation in the base frame in rad), by every load, section and a small wrench at the tip. Null where the solver
// does not reach the tolerance.
std::string with_derivatives(const std::string& solved_json, const scene::Scene& scene, const fam::Options& options);

}  // namespace apps
