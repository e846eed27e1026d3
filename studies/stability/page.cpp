#include "studies/report/page.h"

#include "studies/report/table.h"
#include "studies/stability/data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace studies {
namespace {

// The load from which on plain shooting fails whatever its steps; empty: there is none.
std::string load_lost_to_shooting(const StabilityData& data, const std::string& map_name) {
  const StabilityMap& map = data.map_named(map_name);
  for (const double load : map.x.values) {
    if (coarsest_right(data, map, "rk4 shooting", load) == nullptr) return for_reader(axis_text(load));
  }
  return "";
}

// The scenes of the maps that say how many arcs are one a column.
int scenes_of(const StabilityData& data) {
  int scenes = 0;
  for (const ReferenceCheck& check : data.checks) scenes += check.scenes;
  return scenes;
}

std::string silent_methods(const StabilityData& data) {
  std::vector<std::string> names;
  for (const std::string& method : data.methods) {
    const int silent = data.count(method, is_silent);
    if (silent > 0) names.push_back(fmt::format("{} {}", contender(method).name(), silent));
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

void set_judge(Page& page, const StabilityData& data) {
  ReferenceCheck sum{"", 0, 0, 0, 0, 0, 0};
  for (const ReferenceCheck& c : data.checks) {
    sum.by_closed_form += c.by_closed_form;
    sum.by_march += c.by_march;
    sum.unchecked += c.unchecked;
    sum.unsolved += c.unsolved;
    sum.largest_difference = std::max(sum.largest_difference, c.largest_difference);
  }
  page.set("by_closed_form", std::to_string(sum.by_closed_form));
  page.set("by_march", std::to_string(sum.by_march));
  page.set("unchecked", std::to_string(sum.unchecked));
  page.set("unsolved", std::to_string(sum.unsolved));
  page.set("judge_difference", for_reader(scientific(sum.largest_difference, 0)));
}

void set_mechanisms(Page& page, const StabilityData& data) {
  for (const std::string map : {"follower", "fixed"}) {
    page.set("growth_" + map, growth_of_right_cells(data, map));
    page.set("shooting_" + map, load_lost_to_shooting(data, map));
    page.check("shooting_fails_" + map, !load_lost_to_shooting(data, map).empty());
  }
  page.set("turns", turns_of_elements(data));
  page.check("circles", exact_for_circles(data));
  page.check("straight", straight_stays_straight(data));
  page.set("slender_linear", errors_over_slenderness(data, "fem linear"));
  page.set("slender_quadratic", errors_over_slenderness(data, "fem quadratic"));
  page.set("double", error_over_arcs(data, "midpoint in double precision"));
  page.set("single", error_over_arcs(data, "midpoint in single precision"));
}

}  // namespace

std::string where_each_fails(const StabilityData& data) {
  std::vector<std::string> parts;
  for (const std::string& method : data.methods) {
    if (!contender(method).only_in.empty()) continue;
    const int all = data.count(method, [](Verdict) { return true; }), good = data.count(method, is_right);
    parts.push_back(
        fmt::format("{} {}/{}/{}", contender(method).name(), all, all - good, data.count(method, is_silent)));
  }
  return fmt::format("{} scenes; solves/not right/of these wrong and silent: {}.", scenes_of(data),
                     fmt::join(parts, ", "));
}

std::string silent_by_map(const StabilityData& data) {
  std::vector<std::string> parts;
  for (const StabilityMap& map : data.maps) {
    const auto silent = std::count_if(data.cells.begin(), data.cells.end(), [&](const StabilityCell& c) {
      return c.map == map.name && is_silent(c.judgement.verdict);
    });
    if (silent > 0) parts.push_back(fmt::format("[{}]({}.csv) {}", map.name, map.name, silent));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string stable_as_exact(const StabilityData& data) {
  int asked = 0, same = 0;
  std::string others;
  for (const StabilityCell& cell : data.cells) {
    const ExactIndex* index = data.index_at(data.map_named(cell.map), cell.x, cell.y);
    if (cell.method == "exact" || !is_right(cell.judgement.verdict) || !cell.stable || !index || !index->falling)
      continue;
    ++asked;
    const bool is_same = *cell.stable == (*index->falling == 0);
    same += is_same;
    if (!is_same)
      others += fmt::format("{}{} at {}, {}", others.empty() ? "" : "; ", contender(cell.method).name(),
                            axis_text(cell.x), axis_text(cell.y));
  }
  return fmt::format("{} of {}{}", same, asked, others.empty() ? "" : " (not " + others + ")");
}

std::string unstable_by_map(const StabilityData& data) {
  std::vector<std::string> parts;
  for (const StabilityMap& map : data.maps) {
    const auto unstable = std::count_if(data.indices.begin(), data.indices.end(), [&](const ExactIndex& i) {
      return i.map == map.name && i.falling.value_or(0) > 0;
    });
    if (unstable > 0) parts.push_back(fmt::format("{} {}", map.name, unstable));
  }
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string stability_page(const StabilityData& data, const std::filesystem::path& page_md) {
  Page page;
  page.set("where", where_each_fails(data));
  page.set("solves", std::to_string(data.cells.size()));
  page.set("silent_methods", silent_methods(data));
  page.set("silent_by_map", silent_by_map(data));
  page.check("any_silent", !silent_by_map(data).empty());
  page.set("with_energy", std::to_string(data.indices.size()));
  page.set("unstable_by_map", unstable_by_map(data));
  page.set("stable_as_exact", stable_as_exact(data));
  page.set("load_steps", std::to_string(most_load_steps));
  page.set("largest_fe_load", axis_text(contender("fem linear").largest_x));
  page.set("failures", failures_table(data));
  page.set("counts", counts_table(data));
  page.set("growth", growth_table(data));
  page.set("breaking", breaking_table(data));
  set_judge(page, data);
  set_mechanisms(page, data);
  return page.fill(page_md);
}

Answers stability_answers(const StabilityData& data) {
  return {{"where", where_each_fails(data)}, {"failures", failures_table(data)}};
}

}  // namespace studies
