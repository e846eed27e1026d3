// Where on the rod an answer is given.
#pragma once

#include "exact_reference/rod_equations.h"
#include "scene/equilibrium.h"

#include <vector>

namespace exact_reference {

// Places on 0..1, clamp to tip: `equal_parts` + 1 equally spaced ones and all span ends, each once.
std::vector<double> station_places(const ScaledRod& rod, int equal_parts);

// Enough equal parts for `turning`, the rod's integral of |u| in rad: at most half a radian each, at least 40.
int equal_parts_for(double turning_rad);

scene::Station station_of(const ScaledRod& rod, double place, const Eigen::Vector4d& q,
                          const Eigen::Vector3d& position);

// Internal wrench at the clamp, tendons included, in the base frame: that of the cut plus the tendons'.
void set_base_wrench(scene::Equilibrium& result, const ScaledRod& rod, const Eigen::Vector3d& cut_force_B,
                     const Eigen::Vector3d& cut_moment_B);

}  // namespace exact_reference
