// Directions in the space of states and of the parameter that a path is followed by.
#pragma once

#include "fem_reference/beam_model.h"

namespace fem_reference {

struct Direction {
  BeamIncrement motion;
  double parameter = 0;
};

BeamIncrement no_motion(const BeamModel& model);

// to += factor * what
void add(BeamIncrement& to, const BeamIncrement& what, double factor);
void add(Direction& to, const Direction& what, double factor);
void scale(BeamIncrement& increment, double factor);
void scale(Direction& direction, double factor);

// Mean over the nodes of the products of displacements (in rod lengths) and rotations (in rad). Internal forces do not
// count: where the rod hardly stretches they change without any motion.
double product(const BeamIncrement& a, const BeamIncrement& b);

// Where `reach` of the parameter counts as much as 1.
double product(const Direction& a, const Direction& b, double reach);

// To unit length; the sign so that its product with `ahead` is positive.
void normalise(Direction& direction, const Direction& ahead, double reach);

// Largest rotation of any node, rad.
double largest_rotation(const BeamIncrement& increment);

}  // namespace fem_reference
