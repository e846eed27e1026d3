// Numbers of a span that say how far its arcs can be marched, and what its tendons do while it is straight.
#pragma once

#include "scene/span.h"

namespace fam {

// The smallest of GJ, EI_y, EI_z.
double least_stiffness_Nmm2(const scene::Span& span);

// The rate, per length and moment, at which the direction of a moment about the axis of middle stiffness goes astray:
// that of Euler's unstable spin, sqrt((c2 - c1)(c3 - c2)) with the compliances in order.
double moment_growth_per_Nmm2(const scene::Span& span);

// The pulls of tendons along e_x, as the internal force -T and moment -r x T e_x that they leave to the rod (section
// frame).
scene::Wrench straight_tendons(const scene::Span& span);

// Bound on the moments of the point loads at the span's end.
double load_moment_Nmm(const scene::Span& span);

}  // namespace fam
