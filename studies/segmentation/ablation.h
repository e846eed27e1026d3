// The ablation: the published law with its arithmetic weakened on purpose, on P4. Which weaknesses make an error that
// bottoms out near N = 12 or rises beyond 500, as printed in the paper?
#pragma once

#include "studies/compare/arc_trend.h"
#include "studies/methods/weakened_arc.h"

#include "exact_reference/elastica.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace studies {

struct AblationPoint {
  int arcs;
  double error_mm;  // tip, against the elastica in closed form; not finite where the arithmetic broke down
  // Angle of each arc minus the sound law's for the same wrench: their sum (bias) and root of the sum of squares about
  // their mean (scatter), rad; and the largest over the arc's own angle.
  double bias_rad, scatter_rad, largest_relative;
  double sums_mm;  // tip - tip summed up in sound arithmetic from the same angles: what the position's sums lost
  double drift;    // moment at the clamp, over the one carried soundly through the same angles, minus 1
  double fe_mm;    // against the rod with shear and stretch, as finite elements see it
};

struct AblationRow {
  std::string group, name;
  Weakness weakness;
  std::vector<AblationPoint> points;
};

// Relative error of (1 - cos t)/t^2 as written, at the mean angle of an arc.
struct Cancellation {
  int arcs;
  double angle_rad, single_precision, double_precision;
};

// One search stopped at absolute tolerances from 1e-4 to 1e-2 rad, evenly in their logarithm: how many of the curves
// have what is printed.
struct Census {
  std::string search, against;  // golden section, bisection; exact, fe
  int curves = 0, rise = 0, under_3_mm = 0, minimum_near_12 = 0, all_three = 0;
  double smallest_all, largest_all;  // tolerances of those with all three, rad
};

struct AblationData {
  double length_mm, tip_angle_rad;  // of the exact rod
  std::vector<Census> censuses;
  std::vector<AblationRow> rows;
  std::vector<Cancellation> cancellations;

  const AblationRow& row(const std::string& name) const;
  const AblationPoint& point(const std::string& name, int arcs) const;
};

// Searches that halve a bracket until an absolute tolerance.
bool stops_at_a_bracket(const Weakness& weakness);

// A planar rod under a follower load.
using exact_reference::PlanarCantilever;

Eigen::Vector2d weakened_tip_mm(const PlanarCantilever& rod, const Weakness& weakness, int arcs);

// fe_tip_mm: of the same rod, with shear and stretch.
AblationData run_ablation(const PlanarCantilever& rod, const Eigen::Vector2d& fe_tip_mm);

Trend trend(const AblationRow& row, double AblationPoint::*error);

std::string one_digit(double value);  // of its magnitude; "–" where it is not finite
std::string ablation_picture(const AblationData& data);
std::map<std::string, std::string> ablation_tables(const AblationData& data);  // CSV

// Tables of the page.
std::string trend_table(const AblationData& data);
std::string tolerance_table(const AblationData& data);
std::string census_table(const AblationData& data);
std::string mechanism_table(const AblationData& data);

// fixed_frame_mm: how far the tip moves if the load keeps its direction in space.
std::map<std::string, std::string> ablation_files(const AblationData& data, double fixed_frame_mm,
                                                  const std::filesystem::path& page_md);

}  // namespace studies
