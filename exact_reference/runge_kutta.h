// One step of the explicit Runge-Kutta formula of order 8 with 12 stages of Dormand and Prince, coefficients of DOP853
// (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, section II.10), with or without
// its derivative by the initial values.
#pragma once

#include "exact_reference/rod_equations.h"

namespace exact_reference {

constexpr int runge_kutta_order = 8;

State runge_kutta_step(const RodEquations& equations, const State& y, double h);

// The same, and d(result)/dy of the first ten components.
State runge_kutta_step(const RodEquations& equations, const State& y, double h, CoreMatrix& sensitivity);

}  // namespace exact_reference
