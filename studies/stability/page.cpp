#include "studies/report/table.h"
#include "studies/stability/data.h"

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

const std::string plain_shooting = "rk4 shooting";

int silent_of(const StabilityData& data, const std::string& method) {
  return count(data, method, is_silent);
}

int silent_of_ours(const StabilityData& data) {
  int silent = 0;
  for (const std::string& method : data.methods) silent += method == plain_shooting ? 0 : silent_of(data, method);
  return silent;
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

FAM, finite elements, exact reference: {}. Plain RK4 shooting, which nothing holds to a branch: {}. Random scenes:
[random](random/README.md).

{}
## Any cell again

    build/release/bin/fam-studies cell direction 170 10 | build/release/bin/fam-studies solve - --method rk4 --steps 16

prints the scene of a cell, named by its map and the values on the axes (y left out where it is a number of arcs or elements),
and solves it; `--method fam --law sixth_order --arcs N`, `--method fem --order 1 --elements N`, `--method exact` for the others.

## Maps

{}## The mechanisms, checked

{}
## Why one shoots in segments

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
      data.cells.size(), most_load_steps, counts_table(data), silent_of_ours(data), silent_of(data, plain_shooting),
      silent_list(data), maps_text(data), mechanism_checks(data), sensitivity_table(data), breaking_table(data),
      checks_table(data));
}

std::string stability_headline(const StabilityData& data) {
  return fmt::format(
      "## [Stability](stability/README.md): where each method breaks\n\n{} solves over loads, directions, turns and "
      "sections. Wrong and not flagged: FAM, finite elements and exact reference {}, plain RK4 shooting {}. The same "
      "for "
      "10 000 [random scenes](random/README.md).\n\n![Follower force over arcs](stability/follower.svg)\n",
      data.cells.size(), silent_of_ours(data), silent_of(data, plain_shooting));
}

}  // namespace studies
