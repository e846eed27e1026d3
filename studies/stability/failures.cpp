// What fails at which load number, and what to take instead, computed from the maps.
#include "studies/methods/registry.h"
#include "studies/report/table.h"
#include "studies/stability/data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

using Cells = std::vector<const StabilityCell*>;

// A line of the table: one map, or two with a word each.
struct LoadNumber {
  std::string name;
  std::vector<std::pair<std::string, std::string>> maps;  // word and map
};

const std::vector<LoadNumber>& load_numbers() {
  static const std::vector<LoadNumber> numbers = {{"F L²/EI, follower", {{"", "follower"}}},
                                                  {"F L²/EI, fixed, across", {{"", "fixed"}}},
                                                  {"F L²/EI, fixed, pushing (Euler: 2.47)", {{"", "direction"}}},
                                                  {"end moment, turns M L/(2π EI)", {{"", "moment"}}},
                                                  {"torque, turns M L/(2π GJ)", {{"", "torque"}}},
                                                  {"slenderness EI/(kGA L²)", {{"", "slenderness"}}},
                                                  {"GJ/EI", {{"", "twist_stiffness"}}},
                                                  {"EI strong/weak", {{"ribbon", "ribbon"}, {"jump", "jump"}}}};
  return numbers;
}

// Of the directions the table tells of those that push.
Cells cells_of(const StabilityData& data, const std::string& map, const std::string& method) {
  Cells cells = data.find_all(map, method);
  if (map == "direction") std::erase_if(cells, [](const StabilityCell* c) { return c->x <= 90; });
  return cells;
}

bool right(const StabilityCell* cell) {
  return is_right(cell->judgement.verdict);
}

std::string number(double value) {
  return for_reader(axis_text(value));
}

std::string range(double low, double high) {
  return low == high ? number(low) : number(low) + " … " + number(high);
}

// The loads that no number of arcs or elements solves; the finest tried is right neither alone nor with all above.
std::string where_no_resolution_helps(const StabilityData& data, const StabilityMap& map, const std::string& method) {
  std::vector<double> asked, lost;
  for (const double x : map.x.values) {
    if (data.find(map.name, method, x, map.y.values.front()) == nullptr) continue;
    asked.push_back(x);
    if (coarsest_right(data, map, method, x) == nullptr) lost.push_back(x);
  }
  if (lost.empty()) return "";
  if (lost.back() == asked.back()) return "from " + number(lost.front()) + " on";
  return "at " + range(lost.front(), lost.back());
}

std::string where_wrong(const StabilityMap& map, const Cells& cells) {
  double least_x = INFINITY, least_y = INFINITY, most_y = -INFINITY;
  for (const StabilityCell* c : cells) {
    if (right(c)) continue;
    least_x = std::min(least_x, c->x);
    least_y = std::min(least_y, c->y);
    most_y = std::max(most_y, c->y);
  }
  if (std::isinf(least_x)) return "";
  if (map.name == "direction") return "from " + number(least_y) + " on";
  return fmt::format("at {} where {} ≥ {}", range(least_y, most_y), map.x.label, number(least_x));
}

// Where each method fails, those that fail alike together.
std::string failures_in(const StabilityData& data, const StabilityMap& map) {
  std::vector<std::pair<std::string, std::vector<std::string>>> alike;
  const auto add = [&](const std::string& where, const std::string& name) {
    const auto found =
        std::find_if(alike.begin(), alike.end(), [&](const auto& entry) { return entry.first == where; });
    if (found == alike.end()) alike.push_back({where, {name}});
    else found->second.push_back(name);
  };
  for (const Contender& method : contenders()) {
    const Cells cells = cells_of(data, map.name, method.key);
    if (cells.empty()) continue;
    const auto refused = [](const StabilityCell* c) { return c->judgement.verdict == Verdict::unsupported; };
    const auto silent = [](const StabilityCell* c) { return is_silent(c->judgement.verdict); };
    if (std::all_of(cells.begin(), cells.end(), refused)) {
      add("refuses", method.name());
      continue;
    }
    const std::string where =
        map.y_is_cells ? where_no_resolution_helps(data, map, method.key) : where_wrong(map, cells);
    const auto lies = std::count_if(cells.begin(), cells.end(), silent);
    if (where.empty() && lies == 0) continue;
    add(where + (lies > 0 ? fmt::format(", **silent on {} of {}**", lies, cells.size()) : ""), method.name());
  }
  std::vector<std::string> parts;
  for (const auto& [where, names] : alike) parts.push_back(fmt::format("{} {}", fmt::join(names, ", "), where));
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, "; "));
}

// "≤ 256 arcs, 16 elements": what the methods that do not choose were given.
std::string given(const StabilityMap& map) {
  const Contender &arcs = contender("sixth_order"), &elements = contender("fem quadratic");
  return map.y_is_cells ? fmt::format("≤ {} arcs, {} elements", arcs.most_cells, elements.most_cells)
                        : fmt::format("{} arcs, {} elements", arcs.fixed_cells, elements.fixed_cells);
}

// Fewest sixth-order arcs that are right over a whole map, with all finer; 0: none.
int arcs_for_all(const StabilityData& data, const StabilityMap& map) {
  int arcs = 0;
  for (const double x : map.x.values) {
    const StabilityCell* cell = coarsest_right(data, map, "sixth_order", x);
    if (cell == nullptr) return 0;
    arcs = std::max(arcs, cell->cells);
  }
  return arcs;
}

// The methods that are right on all of these maps.
std::string instead(const StabilityData& data, const std::vector<std::pair<std::string, std::string>>& maps) {
  std::vector<std::string> names;
  for (const Contender& method : contenders()) {
    const bool all = std::all_of(maps.begin(), maps.end(), [&](const auto& map) {
      const Cells cells = cells_of(data, map.second, method.key);
      return !cells.empty() && std::all_of(cells.begin(), cells.end(), right);
    });
    if (!all) continue;
    const bool counts = !data.map_named(maps.front().second).y_is_cells;
    if (method.automatic() || counts) names.push_back(method.name());
  }
  const StabilityMap& first = data.map_named(maps.front().second);
  const int arcs = first.y_is_cells ? arcs_for_all(data, first) : 0;
  if (arcs > 0)
    names.push_back(contender("sixth_order").name() + ", " + counted(arcs, "arc") + (arcs == 1 ? "" : " or more"));
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name == contender("fam automatic").name(); });
  return names.empty() ? "–" : fmt::format("{}", fmt::join(names, "; "));
}

}  // namespace

std::string failures_table(const StabilityData& data) {
  Table table({"load number", "what fails, and from where on", "take instead"});
  for (const LoadNumber& line : load_numbers()) {
    std::string fails;
    for (const auto& [word, map] : line.maps) {
      fails += (fails.empty() ? "" : "; ") + (word.empty() ? "" : "*" + word + "* ") +
               failures_in(data, data.map_named(map));
    }
    std::erase(fails, '|');  // it would end the cell
    table.add({fmt::format("{} ({})", line.name, given(data.map_named(line.maps.front().second))), fails,
               instead(data, line.maps)});
  }
  return table.markdown();
}

}  // namespace studies
