// What can be read off a scene's spans before it is solved.
#pragma once

#include "scene/span.h"

#include <span>

namespace fam {

// The march from the tip suffices: all loads are in the section frame and none is distributed.
bool all_loads_follow(std::span<const scene::Span> spans);

// All bending is about one axis of the section, y or z, and nothing twists.
bool is_planar(std::span<const scene::Span> spans);

// A mirror image or a turn about the axis leaves the scene as it is: planar, or nothing but tension, torque and twist
// along the axis. Only then can the rod stay on a branch that is unstable.
bool is_symmetric(std::span<const scene::Span> spans);

// The loads have an energy: fixed forces, gravity and tendons alone.
bool conservative(std::span<const scene::Span> spans);

// The smallest of GJ, EI_y, EI_z.
double least_stiffness_Nmm2(const scene::Span& span);

// The rate, per length and moment, at which the direction of a moment about the axis of middle stiffness goes astray:
// that of Euler's unstable spin, sqrt((c2 - c1)(c3 - c2)) with the compliances in order.
double moment_growth_per_Nmm2(const scene::Span& span);

}  // namespace fam
