#include "studies/report/table.h"
#include "studies/stability/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Two digits of an error would show round-off where a march amplifies it; one does, above 1e-7.
std::string error_cell(const StabilityCell& cell, double value) {
  if (cell.status != "converged") return "";
  if (std::isnan(value)) return "failed";
  return value < 1e-7 ? "<1e-07" : scientific(value, 0);
}

std::string map_csv(const StabilityData& data, const StabilityMap& map) {
  Table table({"method", map.x.label, map.y.label, "cells", "verdict", "error_over_L", "estimate_over_L", "status"});
  for (const std::string& method : data.methods) {
    for (const double y : map.y.values) {
      for (const double x : map.x.values) {
        const StabilityCell* cell = data.find(map.name, method, x, y);
        if (cell == nullptr) continue;
        table.add({method, axis_text(x), map.y_is_cells && cell->cells == 0 ? "automatic" : axis_text(y),
                   std::to_string(cell->cells), name(cell->judgement.verdict), error_cell(*cell, cell->judgement.error),
                   error_cell(*cell, cell->judgement.estimate), cell->status});
      }
    }
  }
  return table.csv({map.title + "; cells: arcs or elements, 0 where the method chooses.",
                    "error: distance of the tip from the exact one over L; estimate: the method's own."});
}

}  // namespace

const StabilityCell* StabilityData::find(const std::string& map, const std::string& method, double x, double y) const {
  const auto found = std::find_if(cells.begin(), cells.end(), [&](const StabilityCell& c) {
    return c.map == map && c.method == method && c.x == x && c.y == y;
  });
  return found == cells.end() ? nullptr : &*found;
}

std::string axis_text(double value) {
  return fmt::format("{:g}", value);
}

std::map<std::string, std::string> stability_tables(const StabilityData& data) {
  std::map<std::string, std::string> files;
  for (const StabilityMap& map : data.maps) files[map.name + ".csv"] = map_csv(data, map);
  return files;
}

}  // namespace studies
