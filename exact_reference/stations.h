// Where on the rod an answer is given, and what is said there.
#pragma once

#include "exact_reference/rod_equations.h"
#include "scene/equilibrium.h"

#include <vector>

namespace exact_reference {

// State at a place, base frame; at a point load or a tendon's end that of the side towards the clamp.
struct PlacedState {
  double place = 0;  // 0..1
  State state = State::Zero();
};

// int |u| ds from the clamp to each place, in rad: rising, the clamp and the tip included.
struct Turn {
  double place = 0;
  double turned_rad = 0;
};

// Places, clamp to tip, each once: 0, 1/40 ... 1, all span ends, and so many between that the rod turns by at most half
// a radian from one to the next.
std::vector<double> station_places(const ScaledRod& rod, const std::vector<Turn>& turns = {});

// The turn between states that lie close, from their curvatures.
std::vector<Turn> turns_of(const ScaledRod& rod, const std::vector<PlacedState>& states);

// The wrench is the rod's own, tendons left out.
std::vector<scene::Station> stations_of(const ScaledRod& rod, const std::vector<PlacedState>& states);

// Stations and tip angle of a result.
void set_shape(scene::Equilibrium& result, const ScaledRod& rod, const std::vector<PlacedState>& states);

// int |e_x + u0 x r| ds - int |v + u x r| ds of each of the scene's tendons in mm: Gauss's rule of five points between
// neighbouring states, halved until it holds to 1e-15 L, each point by a Runge-Kutta step from the state before it.
std::vector<double> tendon_shortening_mm(const ScaledRod& rod, const std::vector<PlacedState>& states);

}  // namespace exact_reference
