#include "studies/stability_data.h"
#include "studies/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

int count(const StabilityData& data, const std::string& method, const std::function<bool(Verdict)>& is) {
  return static_cast<int>(std::count_if(data.cells.begin(), data.cells.end(), [&](const StabilityCell& c) {
    return c.method == method && is(c.judgement.verdict);
  }));
}

std::function<bool(Verdict)> one_of(std::initializer_list<Verdict> list) {
  return [set = std::vector<Verdict>(list)](Verdict v) { return std::find(set.begin(), set.end(), v) != set.end(); };
}

std::string counts_table(const StabilityData& data) {
  Table table({"method", "cells", "right to 1e-2 L", "of them to 1e-6 L", "wrong but flagged", "not converged",
               "work limit", "unsupported", "wrong and not flagged", "wrong branch"});
  for (const std::string& method : data.methods) {
    const auto cell = [&](const std::function<bool(Verdict)>& is) { return std::to_string(count(data, method, is)); };
    table.add({method, cell([](Verdict) { return true; }), cell(is_right), cell(one_of({Verdict::right_to_1e6})),
               cell(one_of({Verdict::flagged})), cell(one_of({Verdict::not_converged})),
               cell(one_of({Verdict::work_limit})), cell(one_of({Verdict::unsupported})),
               cell(one_of({Verdict::wrong})), cell(one_of({Verdict::wrong_branch}))});
  }
  return table.markdown();
}

std::string checks_table(const StabilityData& data) {
  Table table(
      {"map", "scenes", "against a closed form", "against a march", "neither", "not solved", "largest difference / L"});
  for (const ReferenceCheck& c : data.checks) {
    table.add({c.map, std::to_string(c.scenes), std::to_string(c.by_closed_form), std::to_string(c.by_march),
               std::to_string(c.unchecked), std::to_string(c.unsolved),
               c.largest_difference < 1e-8 ? "< 1e-8" : scientific(c.largest_difference, 0)});
  }
  return table.markdown();
}

// Growth of the load along one cell, w = sqrt(|F| L^2/EI) / cells.
double growth_per_cell(const StabilityCell& cell) {
  return std::sqrt(cell.x) / cell.cells;
}

// Fewest cells from which on every finer row of a column is right; 0: none.
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

std::string needed_table(const StabilityData& data, const StabilityMap& map) {
  std::vector<std::string> head{"method"};
  for (const double x : map.x.values) head.push_back(axis_text(x));
  Table table(head);
  for (const std::string& method : data.methods) {
    std::vector<std::string> cells{method};
    bool any = false;
    for (const double x : map.x.values) {
      const StabilityCell* cell = coarsest_right(data, map, method, x);
      any |= cell != nullptr && cell->cells > 0;
      cells.push_back(cell == nullptr ? "–" : std::to_string(cell->cells));
    }
    if (any) table.add(cells);
  }
  return table.markdown();
}

// The least growth a cell at which a method was silent in the two load maps: below it none was.
std::string silent_sentence(const StabilityData& data) {
  double least = INFINITY, most_right = 0;
  for (const StabilityCell& c : data.cells) {
    if (c.cells == 0 || (c.map != "follower" && c.map != "fixed")) continue;
    if (is_silent(c.judgement.verdict)) least = std::min(least, growth_per_cell(c));
    if (is_right(c.judgement.verdict)) most_right = std::max(most_right, growth_per_cell(c));
  }
  return std::isinf(least)
             ? "None was silent."
             : fmt::format("No answer was silent below w/N = {:.1f}; none was right above {:.1f}.", least, most_right);
}

std::string sensitivity_table(const StabilityData& data) {
  Table table({"F L²/EI", "w", "measured growth", "cosh w"});
  for (const Sensitivity& s : data.sensitivities) {
    const double w = std::sqrt(s.load);
    table.add({axis_text(s.load), fixed(w, 1), scientific(s.growth, 1), scientific(std::cosh(w), 1)});
  }
  return table.markdown();
}

std::string breaking_table(const StabilityData& data) {
  Table table({"method", "map and place", "what happens", "error / L", "its own estimate / L", "command"});
  for (const BreakingScene& b : data.breaking) {
    const bool converged = b.cell.status == "converged";
    table.add({b.cell.method, b.place, name(b.cell.judgement.verdict),
               converged ? scientific(b.cell.judgement.error, 0) : "",
               converged ? scientific(b.cell.judgement.estimate, 0) : "",
               "`fam-studies solve results/stability/scenes/" + b.name + ".json " + b.command + "`"});
  }
  return table.markdown();
}

std::string silent_list(const StabilityData& data) {
  Table table({"method", "map", "x", "y", "verdict", "error / L", "its own estimate / L"});
  for (const std::string& method : data.methods) {
    for (const StabilityCell& c : data.cells) {
      if (c.method != method || !is_silent(c.judgement.verdict)) continue;
      table.add({method, c.map, axis_text(c.x), axis_text(c.y), name(c.judgement.verdict),
                 scientific(c.judgement.error, 0), scientific(c.judgement.estimate, 0)});
    }
  }
  return table.markdown();
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
           "unstable one between them: the finite elements shorten their load step there until the work is used up, "
           "and "
           "between 2.46 and 2.48 a mesh errs in the Euler load itself, so that two coarse meshes can agree; at 180° "
           "exactly every method stays on the straight rod.";
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

std::string maps_text(const StabilityData& data) {
  std::string text;
  for (const StabilityMap& map : data.maps) {
    text += fmt::format("### {}\n\n![{}]({}.svg)\n\n{} [Table]({}.csv).\n\n", map.title, map.title, map.name,
                        mechanism(map.name), map.name);
    if (map.name == "follower" || map.name == "fixed") {
      text += "Fewest arcs or elements (powers of two) from which on the answer is right, over |F| L²/EI:\n\n" +
              needed_table(data, map) + "\n";
    }
  }
  return text;
}

}  // namespace

std::string stability_page(const StabilityData& data) {
  return fmt::format(
      R"(# Where each method breaks

{} solves of clamped rods, each judged by the exact tip: **right** within 1e-2 L (1e-4, 1e-6); **flagged** where it is
farther off and the method's own error estimate is at least a third of the error; **not flagged** where it is less;
**wrong branch** where a not flagged answer is another equilibrium (its stability is another, or four times the
resolution does not move it). With fixed resolution the methods estimate their error from two resolutions; *fam
automatic* chooses its arcs for 1e-4 L; finite elements may try {} load steps and are not asked
beyond |F| L²/EI = 1000. Empty cells: not asked, or not solved by the exact reference. The tip's position alone decides,
not its rotation.

{}
## Wrong and not flagged

{}

{}
Both resolutions of such an estimate are too coarse to see the load's length. With the number of arcs chosen by
tolerance (*fam automatic*) no answer in these maps is silent; random scenes: [random](random/README.md).

## Maps

{}## Why one shoots in segments

A turn of the tip under a fixed transverse force grows towards the clamp like cosh w, w = sqrt(|F| L²/EI). In double
precision single shooting from the tip loses all digits at w = 36; a table of the growth, measured by marching:

{}
## The smallest breaking scenes

{}
## The judge

The exact reference (tolerance 1e-12 L) stands beside the elastica in closed form where there is one, else beside a
march of 4096 fourth-order arcs from the tip that it found (with the fixed loads turned into follower loads there), as
far as that march is not too sensitive:

{})",
      data.cells.size(), most_load_steps, counts_table(data), silent_sentence(data), silent_list(data), maps_text(data),
      sensitivity_table(data), breaking_table(data), checks_table(data));
}

std::string stability_headline(const StabilityData& data) {
  int silent = 0;
  for (const std::string& method : data.methods) silent += count(data, method, is_silent);
  return fmt::format(
      "## [Stability](stability/README.md): where each method breaks\n\n{} solves over loads, directions, turns and "
      "sections: {} answers are wrong and not flagged, all of them with a fixed number of arcs or elements that is far "
      "too small for the load; of FAM with automatic arcs {}, of the exact reference {}.\n\n![Follower force over "
      "arcs](stability/follower.svg)\n",
      data.cells.size(), silent, count(data, "fam automatic", is_silent), count(data, "exact", is_silent));
}

}  // namespace studies
