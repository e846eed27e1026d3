#include "studies/report/table.h"
#include "studies/stability/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace studies {

// Fewest cells from which on every finer row of a column is right.
const StabilityCell* coarsest_right(const StabilityData& data, const StabilityMap& map, const std::string& method,
                                    double x) {
  const StabilityCell* coarsest = nullptr;
  for (auto y = map.y.values.rbegin(); y != map.y.values.rend(); ++y) {
    const StabilityCell* cell = data.find(map.name, method, x, *y);
    if (cell == nullptr) continue;
    if (!is_right(cell->judgement.verdict)) break;
    coarsest = cell;
  }
  return coarsest;
}

// One sentence of mechanism a map.
std::string mechanism(const std::string& map) {
  if (map == "follower") {
    return "The boundary is resolution: the rod curls up where the load's length sqrt(EI/F) is short, and an arc must "
           "not be longer. Below it N and 2N arcs can agree by chance.";
  }
  if (map == "fixed") {
    return "The same length, now of a boundary layer at the clamp, where the rod turns into the force.";
  }
  if (map == "direction") {
    return "Beyond the Euler load a push off the axis by a thousandth of a degree has two mirrored answers and an "
           "unstable one between them: the load steps shorten there, none passing the zero that the determinant heads "
           "for; between 2.46 and 2.48 a mesh errs in the Euler load itself, so that two coarse meshes can agree; at "
           "180° exactly every method stays on the straight rod.";
  }
  if (map == "torque") {
    return "Twist turns the bending plane along an arc: the published law applies bend and twist one after the other, "
           "first order in the twist per arc; an element that turns by half a turn is refused, and finite elements "
           "need a load step for each 0.6 rad.";
  }
  if (map == "moment") {
    return "Every arc law is exact for a circle; finite elements take a load step for each 0.6 rad of the tip, and an "
           "element "
           "that turns by half a turn is refused.";
  }
  if (map == "slenderness") {
    return "No locking: reduced integration and the arcs do not see the slenderness; at EI/(kGA L²) = 1 the load "
           "stretches the rod by several times its length.";
  }
  if (map == "twist_stiffness") {
    return "Twist M L/GJ per arc or element: at GJ/EI = 1e-3 it is several turns, and the samples within an arc alias.";
  }
  if (map == "precision") {
    return "In double precision the error falls as 1/N²; in single precision each arc adds its round-off of 6e-8, so "
           "that the sum meets the law's error between 64 and 1000 arcs and grows beyond.";
  }
  if (map == "ribbon") {
    return "At the toppling load 4.0126 sqrt(EI_y GJ)/L² the ribbon leaves its plane, within a few hundredths of the "
           "load; the thousandth sideways keeps all methods on the same side.";
  }
  return "The soft half alone bends; stiffness jumps by 1e4 cost digits, not branches. With a soft clamped half the "
         "load "
         "is 1e4 times as large in its units.";
}

namespace {

struct Range {
  double least = INFINITY, most = -INFINITY;

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  std::string text(int digits = 2) const {
    return std::isinf(least) ? "–" : fmt::format("{:.{}g} … {:.{}g}", least, digits, most, digits);
  }
};

const StabilityMap& map_named(const StabilityData& data, const std::string& name) {
  return *std::find_if(data.maps.begin(), data.maps.end(), [&](const StabilityMap& map) { return map.name == name; });
}

// Growth of the load along one cell, sqrt(|F| L^2/EI) / N, at the coarsest right cell, over the loads of 10 and more.
std::string resolution(const StabilityData& data, const std::string& map_name, const std::string& method) {
  const StabilityMap& map = map_named(data, map_name);
  Range range;
  for (const double load : map.x.values) {
    const StabilityCell* cell = load < 10 ? nullptr : coarsest_right(data, map, method, load);
    if (cell != nullptr) range.add(std::sqrt(load) / cell->cells);
  }
  return range.text();
}

// Exact turn of an element in the moment map where finite elements are right, and where they refused.
std::string turn_of_refused_elements(const StabilityData& data) {
  Range refused, right;
  for (const StabilityCell& c : data.cells) {
    if (c.map != "moment" || c.method.rfind("fem", 0) != 0) continue;
    const double turn_rad = 2 * std::numbers::pi * c.x / c.cells;
    if (is_right(c.judgement.verdict)) right.add(turn_rad);
    if (c.status != "converged") refused.add(turn_rad);
  }
  return fmt::format("right {} rad, refused {} rad", right.text(), refused.text());
}

double error_at(const StabilityData& data, const std::string& map, const std::string& method, double x, double y) {
  const StabilityCell* cell = data.find(map, method, x, y);
  return cell == nullptr ? NAN : cell->judgement.error;
}

std::string errors_over_slenderness(const StabilityData& data, const std::string& method) {
  Range range;
  for (const double slenderness : {1e-8, 1e-4, 1e-2}) range.add(error_at(data, "slenderness", method, 1, slenderness));
  return range.text();
}

// Slope of the error over arcs from 16 to 256, and the arcs with the least error.
std::string precision(const StabilityData& data, const std::string& method) {
  const double coarse = error_at(data, "precision", method, 1, 16), fine = error_at(data, "precision", method, 1, 256);
  double least = INFINITY, best = 0;
  for (const double arcs : map_named(data, "precision").y.values) {
    const double error = error_at(data, "precision", method, 1, arcs);
    if (error >= least) continue;
    least = error;
    best = arcs;
  }
  return fmt::format("exponent {:.1f} from 16 to 256 arcs; least error {:.0e} at {:.0f}",
                     std::log2(fine / coarse) / std::log2(16), least, best);
}

// The first load beyond which plain shooting does not find the answer whatever its steps.
std::string lost_load(const StabilityData& data, const std::string& map_name) {
  const StabilityMap& map = map_named(data, map_name);
  for (const double load : map.x.values) {
    if (coarsest_right(data, map, "rk4 shooting", load) == nullptr) return axis_text(load);
  }
  return "none";
}

}  // namespace

std::string mechanism_checks(const StabilityData& data) {
  Table table({"map", "what decides", "measured"});
  for (const std::string map : {"follower", "fixed"}) {
    for (const std::string method : {"midpoint", "fourth_order", "sixth_order", "fem quadratic"}) {
      table.add({map, "w/N of the coarsest " + method + " cells that are right, F L²/EI ≥ 10",
                 resolution(data, map, method)});
    }
    table.add({map,
               "least F L²/EI that plain shooting from zero does not solve with any number of steps: Newton's basin",
               lost_load(data, map)});
  }
  table.add({"moment", "exact turn of an element", turn_of_refused_elements(data)});
  for (const std::string method : {"fem linear", "fem quadratic"}) {
    table.add({"slenderness",
               "error / L of 8 " + method.substr(4) +
                   " elements from EI/(kGA L²) = 1e-8 to 1e-2: locking "
                   "would raise it",
               errors_over_slenderness(data, method)});
  }
  table.add({"precision", "double precision, F L²/EI = 1", precision(data, "midpoint in double precision")});
  table.add({"precision", "single precision, F L²/EI = 1", precision(data, "midpoint in single precision")});
  return table.markdown();
}

}  // namespace studies
