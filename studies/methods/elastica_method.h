// The planar elastica in closed form (exact_reference/elastica.h) as a competitor.
#pragma once

#include "studies/methods/method.h"

namespace studies {

// Straight, uniform Kirchhoff rods with forces in the x-y plane and moments about z at the tip, all forces in one
// frame; else Status::unsupported. Stations: clamp and tip. The bare solve sets the elastica up and evaluates the tip.
std::unique_ptr<Method> elastica_method();

}  // namespace studies
