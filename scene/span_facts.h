// What can be read off a scene's spans before it is solved.
#pragma once

#include "scene/span.h"

#include <span>

namespace scene {

// The march from the tip suffices: all loads are in the section frame and none is distributed.
bool all_loads_follow(std::span<const Span> spans);

// All bending is about one axis of the section, y or z, and nothing twists.
bool is_planar(std::span<const Span> spans);

// What leaves the scene as it is: half a turn about the axis (nothing but tension, torque and twist along it), or else
// the mirror of a plane that all bending lies in. A rod can stay on an unstable branch only as far as its symmetry
// holds it there: on the axis, or in the plane as long as it would leave it sideways.
enum class Symmetry { none, plane_xy, plane_xz, axis };
Symmetry symmetry_of(std::span<const Span> spans);

// The loads have an energy: fixed forces, gravity and tendons alone. Loads that cancel at a place do not count.
bool is_conservative(std::span<const Span> spans);

}  // namespace scene
