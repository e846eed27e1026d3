// Sets of loads as Study I may have had them: 8 planar and 8 spatial cases, forces and moments at the tip, drawn from a
// seed, with the tips that rods of several kinds have under them. None of them is the paper's: those are lost.
#pragma once

#include "scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace studies {

// What a study prints of its rod and its number of cases; here the paper's.
struct PopulationRod {
  double length_mm = 40, diameter_mm = 6;
  double planar_bending_Nmm2 = 750, spatial_bending_Nmm2 = 1500;
  int planar_cases = 8, spatial_cases = 8;
};

// How a set is drawn: components uniform; tip displacement uniform, along a load of uniform direction; one to four
// components of round size, as a person would choose them.
enum class LoadPrior { load, deflection, round };
inline constexpr std::array all_load_priors = {LoadPrior::load, LoadPrior::deflection, LoadPrior::round};
const char* name(LoadPrior prior);

// What a solver may have been told: loads that follow or stay, with shear and stretch or without (Kirchhoff).
enum class Side { follower, follower_kirchhoff, fixed, fixed_kirchhoff, fixed_moment, fixed_force };
constexpr std::size_t side_count = 6;

struct TipLoad {
  bool planar = true;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero(), moment_Nmm = Eigen::Vector3d::Zero();
};

struct TipCase {
  TipLoad load;
  std::array<Eigen::Vector3d, side_count> tip_mm;  // of each Side

  const Eigen::Vector3d& tip_of(Side side) const { return tip_mm[static_cast<std::size_t>(side)]; }
};

struct LoadSet {
  LoadPrior prior = LoadPrior::load;
  scene::Stiffness planar_stiffness, spatial_stiffness;
  std::vector<TipCase> cases;  // planar, then spatial
  int redrawn = 0;             // cases, of which some side had no answer or another displacement

  const scene::Stiffness& stiffness_of(const TipCase& c) const {
    return c.load.planar ? planar_stiffness : spatial_stiffness;
  }
};

// Tips move by 5 to 100 % of the length, as the follower rod with shear has it.
constexpr double least_displacement = 0.05, largest_displacement = 1;

LoadSet draw_load_set(const PopulationRod& rod, LoadPrior prior, std::uint64_t seed);
// The sets of a study: the priors in turn.
LoadSet load_set(const PopulationRod& rod, std::uint64_t index);

// The scene of a case as a side sees it.
scene::Scene scene_of(double length_mm, const scene::Stiffness& stiffness, const TipLoad& load, Side side);
// Tips under loads in the plane or in space; NaN where there is no answer.
std::vector<Eigen::Vector3d> tips_of(double length_mm, const scene::Stiffness& stiffness,
                                     const std::vector<TipLoad>& loads, Side side);

}  // namespace studies
