// Random scenes over everything that the scene format can say: the same scene from the same seed on every machine.
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace studies {

struct RandomSceneLimits {
  int sections_max = 20;
  double length_min_mm = 1e-3, length_max_mm = 1e4;  // of the rod, log-uniform
  double stiffness_decades = 12;                     // of EI between scenes, log-uniform about 1 N mm^2
  double load_max = 1000;                            // of the sum of |F| L^2/EI; EI: see random_scene.cpp
};

// Seeds from this one on are rods that buckle: pressed almost along the axis, or strips bent almost in their stiff
// plane, and pushed aside by 1e-7 to 0.1 of EI/L^2 in all manners.
constexpr std::uint64_t first_buckling_seed = 100'000;

// A valid scene: 1..sections_max sections, all load kinds in both frames; a quarter planar, a third with follower loads
// and tendons alone. random_scene.cpp holds the distributions.
scene::Scene random_scene(std::uint64_t seed, const RandomSceneLimits& limits = {});

}  // namespace studies
