// Random scenes over everything that the scene format can say: the same scene from the same seed on every machine.
#pragma once

#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <string>

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

// Seeds from this one on are of six families in turn, in which estimates and the choice of arcs proved hardest: strips
// near lateral buckling, heavy rods clamped at any angle, rods coiled by up to twenty turns, robots with one to four
// tendons and forces off the centreline, cables up to F L^2/EI = 1e5, and rods of soft shear.
constexpr std::uint64_t first_family_seed = 200'000;
constexpr std::array<const char*, 6> families{"strips", "heavy rods", "coiled rods", "tendons", "cables", "soft shear"};

// The seed of scene 0, 1, 2, ... of a mix: of ten five are general, one buckles, four are of the families.
std::uint64_t mixed_seed(std::uint64_t index);

// Seeds from this one on are those of campaigns, 2^40 of each: of ten neighbours five are general, one buckles, four are
// of the families, in turn.
constexpr std::uint64_t first_campaign_seed = std::uint64_t{1} << 40;
constexpr std::uint64_t most_campaign_scenes = first_campaign_seed, most_campaigns = std::uint64_t{1} << 22;

// The seed of scene `index` of a campaign.
constexpr std::uint64_t campaign_seed(std::uint64_t campaign, std::uint64_t index) {
  return first_campaign_seed * (1 + campaign) + index;
}

// What the scenes of this seed are called: "general", "buckling", or a family.
std::string kind_of(std::uint64_t seed);

// A valid scene: 1..sections_max sections, all load kinds in both frames; a quarter planar, a third with follower loads
// and tendons alone. random_scene.cpp holds the distributions.
scene::Scene random_scene(std::uint64_t seed, const RandomSceneLimits& limits = {});

}  // namespace studies
