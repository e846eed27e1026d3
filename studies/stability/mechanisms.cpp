#include "studies/report/table.h"
#include "studies/stability/data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace studies {
namespace {

struct Range {
  double least = INFINITY, most = -INFINITY;

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool empty() const { return std::isinf(least); }
  std::string text() const {
    if (empty()) return "–";
    const std::string low = for_reader(fmt::format("{:.2g}", least)), high = for_reader(fmt::format("{:.2g}", most));
    return low == high ? low : low + " … " + high;
  }
};

double error_at(const StabilityData& data, const std::string& map, const std::string& method, double x, double y) {
  const StabilityCell* cell = data.find(map, method, x, y);
  return cell == nullptr ? NAN : cell->judgement.error;
}

}  // namespace

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

// sqrt(|F| L^2/EI) / N of the coarsest right cells, over the loads of 10 and more, method by method.
std::string growth_of_right_cells(const StabilityData& data, const std::string& map_name) {
  const StabilityMap& map = data.map_named(map_name);
  std::vector<std::string> parts;
  for (const std::string method : {"midpoint", "fourth_order", "sixth_order", "fem quadratic"}) {
    Range range;
    for (const double load : map.x.values) {
      const StabilityCell* cell = load < 10 ? nullptr : coarsest_right(data, map, method, load);
      if (cell != nullptr) range.add(std::sqrt(load) / cell->cells);
    }
    parts.push_back(contender(method).name() + " " + range.text());
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// Exact turn of an element in the moment map where finite elements are right, and where they refused.
std::string turns_of_elements(const StabilityData& data) {
  Range refused, right;
  for (const StabilityCell& c : data.cells) {
    if (c.map != "moment" || !c.method.starts_with("fem")) continue;
    const double turn_rad = 2 * std::numbers::pi * c.x / c.cells;
    if (is_right(c.judgement.verdict)) right.add(turn_rad);
    if (c.status != "converged") refused.add(turn_rad);
  }
  return fmt::format("{} rad where they are right, {} rad where they have no answer", right.text(), refused.text());
}

std::string errors_over_slenderness(const StabilityData& data, const std::string& method) {
  Range range;
  for (const double slenderness : {1e-8, 1e-4, 1e-2}) range.add(error_at(data, "slenderness", method, 1, slenderness));
  return range.text();
}

// Slope of the error over arcs from 16 to 256, and the arcs with the least error, at F L^2/EI = 1.
std::string error_over_arcs(const StabilityData& data, const std::string& method) {
  const double coarse = error_at(data, "precision", method, 1, 16), fine = error_at(data, "precision", method, 1, 256);
  double least = INFINITY, best = 0;
  for (const double arcs : data.map_named("precision").y.values) {
    const double error = error_at(data, "precision", method, 1, arcs);
    if (error < least) least = error, best = arcs;
  }
  return for_reader(fmt::format("falls with exponent {:.1f} from 16 to 256 arcs and is least, {:.0e} L, at {:.0f}",
                                -std::log2(fine / coarse) / std::log2(16), least, best));
}

bool exact_for_circles(const StabilityData& data) {
  return std::all_of(data.cells.begin(), data.cells.end(), [](const StabilityCell& c) {
    const bool arcs = contender(c.method).method.starts_with("fam");
    return c.map != "moment" || !arcs || c.judgement.verdict == Verdict::right_to_1e6;
  });
}

bool straight_stays_straight(const StabilityData& data) {
  return std::all_of(data.cells.begin(), data.cells.end(), [](const StabilityCell& c) {
    const Verdict verdict = c.judgement.verdict;
    return c.map != "direction" || c.x != 180 || verdict == Verdict::right_to_1e6 || verdict == Verdict::unsupported;
  });
}

}  // namespace studies
