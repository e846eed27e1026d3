// The shape of an equilibrium that is known at the nodes of a mesh.
#pragma once

#include "exact_reference/shooting.h"
#include "scene/equilibrium.h"

namespace exact_reference {

// Stations, tip angle and the tendons' shortening. The rod's load factor is 1.
void set_shape(scene::Equilibrium& result, const ScaledRod& rod, const Shooting& shooting, const NodeStates& y);

}  // namespace exact_reference
