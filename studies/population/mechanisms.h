// What could have made FAM and FE differ: each mechanism is one row, what the two programs do otherwise.
#pragma once

#include "studies/population/loads.h"
#include "studies/population/published_rod.h"

#include <optional>
#include <string>
#include <vector>

namespace studies {

struct Mechanism {
  std::string key, group, fam, fe;  // what either side does, in words
  int arcs = 12;                    // of FAM; 0: the rod itself, as `instead` has it
  ProgramSlips slips = {};
  Side fe_side = Side::follower;
  Side instead = Side::follower_kirchhoff;
};
const std::vector<Mechanism>& all_mechanisms();
std::size_t mechanism_at(const std::string& key);  // throws std::logic_error

// FAM − FE of a case's tip, mm; empty where the law finds no angle. `arcs` in place of the mechanism's own.
std::optional<Eigen::Vector3d> tip_error_mm(const Mechanism& mechanism, const PopulationRod& rod, const LoadSet& set,
                                            const TipCase& c, int arcs);
// Of all cases of a set.
std::optional<std::vector<Eigen::Vector3d>> tip_errors_mm(const Mechanism& mechanism, const PopulationRod& rod,
                                                          const LoadSet& set);

// What the paper says of the trend over N and over the torque, asked of one set.
struct MechanismTrend {
  bool answered = false;
  bool under_3_mm = false, minimum_near_12 = false,
       rises = false;              // Trend (compare/arc_trend.h), worst planar case
  bool grows_with_torque = false;  // from each of 0, 10, ... 50 N mm to the next, first spatial case
};
MechanismTrend trend_of(const Mechanism& mechanism, const PopulationRod& rod, const LoadSet& set);

}  // namespace studies
