// The page and the chart of the promise (promise.h).
#include "studies/compare/error_measures.h"
#include "studies/random/promise.h"
#include "studies/report/chart.h"
#include "studies/report/table.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace studies {
namespace {

std::string chart(const std::vector<Promise>& promises) {
  Svg svg(660, 520, "Error of the automatic choice over the error asked for",
          "Error of the automatic choice over the error asked for");
  Panel panel(svg, {80, 40}, 540, 410, {"tolerance / L", 3e-9, 3e-2, true},
              {"largest error along the rod / tolerance", 1e-6, 10, true});
  panel.frame();
  std::vector<Point> kept, broken;
  for (const Promise& promise : promises) {
    if (!promise.solved()) continue;
    // Scenes of one tolerance are spread over its column by their seed.
    const double spread = std::pow(10, 0.7 * (static_cast<double>(promise.seed / 7 % 97) / 96 - 0.5));
    const Point point{promise.tolerance * spread, std::clamp(promise.error / promise.tolerance, 1.1e-6, 9.0)};
    (promise.error <= promise.tolerance ? kept : broken).push_back(point);
  }
  panel.dots(kept, colour::sky, 0.8);
  panel.curve({{3e-9, 1}, {3e-2, 1}}, {colour::black, 1.5, ""});
  for (const Point& point : broken) panel.failure(point, colour::orange);
  panel.name({6e-9, 3}, "broken: ×", colour::orange);
  panel.place_names();
  return svg.str();
}

std::vector<std::string> head(const std::string& first) {
  return {first,
          "scenes",
          "solved",
          "whole shape kept",
          "tip kept",
          "base wrench kept",
          "other equilibrium",
          "worst error / tolerance",
          "worst wrench error / tolerance",
          "estimate < error / 2",
          "arcs used / needed, median",
          "90 %"};
}

void add_row(Table& table, const std::string& first, const std::vector<Promise>& some) {
  if (some.empty()) return;
  const PromiseCounts c = count(some);
  table.add({first, std::to_string(c.scenes), std::to_string(c.solved), std::to_string(c.kept),
             std::to_string(c.tips_kept), std::to_string(c.wrenches_kept), std::to_string(c.other_branch),
             fixed(c.worst, 2), fixed(c.worst_wrench, 2), std::to_string(c.low_estimates), fixed(c.median_waste, 2),
             fixed(c.waste_90, 2)});
}

template <class Keep>
std::vector<Promise> those(const std::vector<Promise>& promises, Keep&& keep) {
  std::vector<Promise> some;
  std::copy_if(promises.begin(), promises.end(), std::back_inserter(some), keep);
  return some;
}

Table by_tolerance(const std::vector<Promise>& promises) {
  Table table(head("tolerance / L"));
  for (int decade = 2; decade <= 8; ++decade) {
    add_row(table, fmt::format("1e-{}", decade),
            those(promises, [&](const Promise& p) { return std::lround(-std::log10(p.tolerance)) == decade; }));
  }
  return table;
}

Table by_kind(const std::vector<Promise>& promises) {
  Table table(head("kind of scene"));
  std::vector<std::string> kinds{"general", "buckling"};
  kinds.insert(kinds.end(), families.begin(), families.end());
  for (const std::string& kind : kinds) {
    add_row(table, kind, those(promises, [&](const Promise& p) { return kind_of(p.seed) == kind; }));
  }
  return table;
}

// Scenes without an answer of FAM, by status and kind, judged or not.
Table unsolved(const std::vector<Promise>& promises) {
  std::map<std::array<std::string, 2>, std::array<int, 2>> counts;
  for (const Promise& p : promises) {
    if (p.status != "converged") ++counts[{p.status, kind_of(p.seed)}][p.judged ? 0 : 1];
  }
  Table table({"status", "kind of scene", "solved by the exact reference", "by neither"});
  for (const auto& [key, value] : counts) {
    table.add({key[0], key[1], std::to_string(value[0]), std::to_string(value[1])});
  }
  return table;
}

Table list_of(const std::vector<Promise>& promises) {
  Table list({"seed", "kind", "tolerance_over_L", "status", "judged", "same_branch", "estimate_over_L", "error_over_L",
              "tip_error_over_L", "wrench_error", "arcs", "needed"});
  for (const Promise& p : promises) {
    list.add({std::to_string(p.seed), kind_of(p.seed), scientific(p.tolerance, 0), p.status, p.judged ? "1" : "0",
              p.same_branch ? "1" : "0", scientific(p.estimate, 1), scientific(p.error, 1), scientific(p.tip_error, 1),
              scientific(p.wrench_error, 1), std::to_string(p.arcs), std::to_string(p.needed)});
  }
  return list;
}

bool is_low(const Promise& p) {
  return p.solved() && p.error > smallest_judged_error && p.estimate < p.error / 2;
}

}  // namespace

std::map<std::string, std::string> estimate_files(const std::vector<Promise>& promises) {
  const std::vector<Promise> low = those(promises, is_low);
  const PromiseCounts c = count(promises);
  const std::string page = fmt::format(
      R"(# Does the error estimate tell the error?

**On {} of {} strips and heavy rods the estimate is below half the largest error along the rod** (of those solved, {}, and
where that error exceeds 3e-9 L; the exact reference judges). These two families broke estimates from two or three arcs
that agreed by chance: strips bent up to three times beyond their lateral buckling load, and rods under their own weight up
to q L³/EI = 1000 clamped at any angle; tolerances from 1e-2 to 1e-8 L in turn.

{}
Every low one: [estimates_low.csv](estimates_low.csv); the table: [estimates.csv](estimates.csv). Again:
`build/release/bin/random_scenes estimates {} FOLDER`.
)",
      low.size(), promises.size(), c.solved, by_kind(promises).markdown(), promises.size());
  return {
      {"estimates.md", page}, {"estimates.csv", by_kind(promises).csv()}, {"estimates_low.csv", list_of(low).csv()}};
}

std::map<std::string, std::string> promise_files(const std::vector<Promise>& promises) {
  const PromiseCounts c = count(promises);
  const int unjudged = static_cast<int>(std::count_if(
      promises.begin(), promises.end(), [](const Promise& p) { return !p.judged && p.status == "converged"; }));
  const Table list = list_of(those(promises, [](const Promise& p) {
    return !p.solved() || p.error > p.tolerance || p.wrench_error > p.tolerance || is_low(p);
  }));
  const auto percent = [](int part, int all) { return fixed(100.0 * part / std::max(1, all), 2); };
  const std::string page = fmt::format(
      R"(# Is the promise kept?

**Whole shape within the tolerance: {kept} of {solved} solved scenes ({kept_solved} %), {kept_all} % of all {scenes} judged ones;
worst {worst} times the tolerance. Base wrench: {wrenches} ({wrenches_solved} %), worst {worst_wrench} times. Tip: {tips}.
Another equilibrium: {other}.**

`fam solve` without options chooses plane or space, shear or none, law, solver and the number of arcs for a tolerance, and
returns an error estimate. Here it solves {all} random scenes (`studies/random_scene.cpp`): half of them general (all load
kinds, 1 to 20 sections, stiffnesses over 12 decades, loads up to 1000 EI/L²), a tenth that buckle, the rest of six
families in which estimates and the choice of arcs proved hardest. Tolerances from 1e-2 to 1e-8 L in turn; the exact
reference judges every station ({unjudged} solved scenes have no judge, since it gave up). A base wrench is kept where
force and moment over L, relative to the largest along the rod, are off by no more than the tolerance over L.

![Error over tolerance](promise.svg)

{tolerances}
{kinds}
Waste: arcs used over the fewest, shared out by length, whose true error is within the tolerance (looked for on a quarter
of the scenes): median {waste}, nine in ten below {waste90}. Below 1: by length alone more are needed.

## Without an answer

{failed} of {all} scenes ({failed_percent} %):

{unsolved}
- *load_step_too_small*: no equilibrium continues the one reached: the rod snaps, or branches meet.
- *tendon_collapsed*: a tendon's path shrinks to nothing, |v + u × r| = 0.
- *work_limit*: the arcs marched while the load grew.

Scenes not solved, not kept or not judged, with their seeds (`random_scenes scene SEED` prints the scene):
[promise.csv](promise.csv). The tables as data: [tolerances.csv](tolerances.csv), [kinds.csv](kinds.csv),
[unsolved.csv](unsolved.csv).
)",
      fmt::arg("kept", c.kept), fmt::arg("solved", c.solved), fmt::arg("kept_solved", percent(c.kept, c.solved)),
      fmt::arg("kept_all", percent(c.kept, c.scenes)), fmt::arg("scenes", c.scenes),
      fmt::arg("worst", fixed(c.worst, 2)), fmt::arg("wrenches", c.wrenches_kept),
      fmt::arg("wrenches_solved", percent(c.wrenches_kept, c.solved)),
      fmt::arg("worst_wrench", fixed(c.worst_wrench, 2)), fmt::arg("tips", c.tips_kept),
      fmt::arg("other", c.other_branch), fmt::arg("all", promises.size()), fmt::arg("unjudged", unjudged),
      fmt::arg("tolerances", by_tolerance(promises).markdown()), fmt::arg("kinds", by_kind(promises).markdown()),
      fmt::arg("waste", fixed(c.median_waste, 2)), fmt::arg("waste90", fixed(c.waste_90, 2)),
      fmt::arg("failed", std::count_if(promises.begin(), promises.end(),
                                       [](const Promise& p) { return p.status != "converged"; })),
      fmt::arg("failed_percent",
               percent(static_cast<int>(std::count_if(promises.begin(), promises.end(),
                                                      [](const Promise& p) { return p.status != "converged"; })),
                       static_cast<int>(promises.size()))),
      fmt::arg("unsolved", unsolved(promises).markdown()));
  return {{"README.md", page},
          {"promise.csv", list.csv()},
          {"tolerances.csv", by_tolerance(promises).csv()},
          {"kinds.csv", by_kind(promises).csv()},
          {"unsolved.csv", unsolved(promises).csv()},
          {"promise.svg", chart(promises)}};
}

}  // namespace studies
