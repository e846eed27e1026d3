// Two numbers of a span's stiffness that say how far its arcs can be marched.
#pragma once

#include "scene/span.h"

namespace fam {

// The smallest of GJ, EI_y, EI_z.
double least_stiffness_Nmm2(const scene::Span& span);

// The rate, per length and moment, at which the direction of a moment about the axis of middle stiffness goes astray:
// that of Euler's unstable spin, sqrt((c2 - c1)(c3 - c2)) with the compliances in order.
double moment_growth_per_Nmm2(const scene::Span& span);

}  // namespace fam
