// The shape of an equilibrium that is known at the nodes of a mesh.
#pragma once

#include "exact_reference/shooting.h"
#include "scene/equilibrium.h"

namespace exact_reference {

// Stations, tip angle and the tendons' shortening. The rod's load factor is 1.
void set_shape(scene::Equilibrium& result, const ScaledRod& rod, const Shooting& shooting, const NodeStates& y);

// What a result would hold at these stations' places, clamp to tip.
std::vector<scene::Station> stations_at(const std::vector<scene::Station>& places, const ScaledRod& rod,
                                        const Shooting& shooting, const NodeStates& y);

// |v + u x r| of a tendon is next to nothing at a node: where a load cannot grow, that is why.
bool tendon_has_collapsed(const ScaledRod& rod, const Shooting& shooting, const NodeStates& y, double load_factor);

}  // namespace exact_reference
