// A centreline that somebody else computed: CSV, a header that names the columns s_mm, x, y and z (or x_mm, y_mm, z_mm,
// as `solve --format csv` has them) in any order, others left aside; then a row a place.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace studies {

struct CentrelinePoint {
  double s_mm = 0;  // arc length from the clamp, of the undeformed rod
  Eigen::Vector3d position_B_mm = Eigen::Vector3d::Zero();
};

// Places closer than this times the length are the same: what rounding to nine digits makes of one.
constexpr double same_station_relative = 1e-9;

// From a file, or from standard input where path is "-": s grows from row to row, from 0 to the rod's length at most;
// one row at least. Throws scene::SceneError naming file, line, column, value and rule.
std::vector<CentrelinePoint> read_centreline(const std::string& path, const scene::Scene& scene);

// The same rod with its sections cut at these places too, so that every method gives a station there.
scene::Scene cut_at(const scene::Scene& scene, const std::vector<CentrelinePoint>& places);

}  // namespace studies
