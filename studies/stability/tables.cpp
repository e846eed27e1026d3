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

// Fewest arcs or elements from which on the answer is right, over the loads.
std::string needed_csv(const StabilityData& data) {
  Table table({"map", "method", "x", "fewest_right"});
  for (const StabilityMap& map : data.maps) {
    if (!map.y_is_cells) continue;
    for (const std::string& method : data.methods) {
      for (const double x : map.x.values) {
        if (data.find(map.name, method, x, map.y.values.front()) == nullptr) continue;
        const StabilityCell* cell = coarsest_right(data, map, method, x);
        table.add({map.name, method, axis_text(x), cell == nullptr ? "none" : std::to_string(cell->cells)});
      }
    }
  }
  return table.csv({"Arcs or elements from which on all that were tried are right; 0: the method chooses."});
}

std::string growth_csv(const StabilityData& data) {
  Table table({"load", "measured_growth", "cosh_of_sqrt_load"});
  for (const Sensitivity& s : data.sensitivities) {
    table.add({axis_text(s.load), scientific(s.growth, 1), scientific(std::cosh(std::sqrt(s.load)), 1)});
  }
  return table.csv(
      {"load: |F| L^2/EI across the tip, fixed. Growth of a turn of the tip's direction towards the clamp."});
}

std::string judge_csv(const StabilityData& data) {
  Table table({"map", "scenes", "by_closed_form", "by_march", "unchecked", "unsolved", "largest_difference_over_L"});
  for (const ReferenceCheck& c : data.checks) {
    table.add({c.map, std::to_string(c.scenes), std::to_string(c.by_closed_form), std::to_string(c.by_march),
               std::to_string(c.unchecked), std::to_string(c.unsolved),
               c.largest_difference < 1e-8 ? "<1e-08" : scientific(c.largest_difference, 0)});
  }
  return table.csv({"The exact reference beside what checks it."});
}

std::string index_csv(const StabilityData& data) {
  Table table({"map", "x", "y", "index"});
  for (const ExactIndex& i : data.indices) {
    const bool by_cells = data.map_named(i.map).y_is_cells;
    table.add(
        {i.map, axis_text(i.x), by_cells ? "" : axis_text(i.y), i.falling ? std::to_string(*i.falling) : "neutral"});
  }
  return table.csv({"Of the scenes whose loads have an energy: how many directions the exact answer is unstable in."});
}

std::function<bool(Verdict)> one_of(Verdict verdict) {
  return [verdict](Verdict v) { return v == verdict; };
}

}  // namespace

const StabilityCell* StabilityData::find(const std::string& map, const std::string& method, double x, double y) const {
  const auto found = std::find_if(cells.begin(), cells.end(), [&](const StabilityCell& c) {
    return c.map == map && c.method == method && c.x == x && c.y == y;
  });
  return found == cells.end() ? nullptr : &*found;
}

std::vector<const StabilityCell*> StabilityData::find_all(const std::string& map, const std::string& method) const {
  std::vector<const StabilityCell*> found;
  for (const StabilityCell& c : cells) {
    if (c.map == map && c.method == method) found.push_back(&c);
  }
  return found;
}

const ExactIndex* StabilityData::index_at(const StabilityMap& map, double x, double y) const {
  const auto found = std::find_if(indices.begin(), indices.end(), [&](const ExactIndex& i) {
    return i.map == map.name && i.x == x && (map.y_is_cells || i.y == y);
  });
  return found == indices.end() ? nullptr : &*found;
}

const StabilityMap& StabilityData::map_named(const std::string& name) const {
  return *std::find_if(maps.begin(), maps.end(), [&](const StabilityMap& map) { return map.name == name; });
}

int StabilityData::count(const std::string& method, const std::function<bool(Verdict)>& is) const {
  return static_cast<int>(std::count_if(cells.begin(), cells.end(), [&](const StabilityCell& c) {
    return c.method == method && is(c.judgement.verdict);
  }));
}

std::string axis_text(double value) {
  return fmt::format("{:g}", value);
}

std::string counts_table(const StabilityData& data) {
  Table table({"method", "solves", "right to 1e-2 L", "of them to 1e-6 L", "wrong, says so", "no answer", "refused",
               "wrong and silent"});
  for (const std::string& method : data.methods) {
    const auto cell = [&](const std::function<bool(Verdict)>& is) { return std::to_string(data.count(method, is)); };
    const auto no_answer = [](Verdict v) { return v == Verdict::not_converged || v == Verdict::work_limit; };
    table.add({contender(method).name(), cell([](Verdict) { return true; }), cell(is_right),
               cell(one_of(Verdict::right_to_1e6)), cell(one_of(Verdict::flagged)), cell(no_answer),
               cell(one_of(Verdict::unsupported)), cell(is_silent)});
  }
  return table.markdown();
}

std::string growth_table(const StabilityData& data) {
  Table table({"F L²/EI", "w", "measured growth", "cosh w"});
  for (const Sensitivity& s : data.sensitivities) {
    const double w = std::sqrt(s.load);
    table.add({axis_text(s.load), fixed(w, 1), significant(s.growth, 2), significant(std::cosh(w), 2)});
  }
  return table.markdown();
}

std::string breaking_table(const StabilityData& data) {
  Table table({"method", "map and place", "what happens", "error / L", "its own estimate / L", "options"});
  for (const BreakingScene& b : data.breaking) {
    const bool converged = b.cell.status == "converged";
    table.add({contender(b.cell.method).name(), b.place, name(b.cell.judgement.verdict),
               converged ? scientific(b.cell.judgement.error, 0) : "",
               converged ? scientific(b.cell.judgement.estimate, 0) : "",
               "[`" + b.name + ".json`](scenes/" + b.name + ".json) `" + b.command + "`"});
  }
  return table.markdown();
}

std::map<std::string, std::string> stability_tables(const StabilityData& data) {
  std::map<std::string, std::string> files;
  for (const StabilityMap& map : data.maps) files[map.name + ".csv"] = map_csv(data, map);
  files["index.csv"] = index_csv(data);
  files["needed.csv"] = needed_csv(data);
  files["growth.csv"] = growth_csv(data);
  files["judge.csv"] = judge_csv(data);
  return files;
}

}  // namespace studies
