// The tables and the chart of the random scenes.
#include "studies/random/tables.h"
#include "studies/methods/registry.h"
#include "studies/random/page.h"
#include "studies/report/chart.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace studies {
namespace {

std::string chart(const std::vector<Promise>& promises) {
  Svg svg(700, 540, "Is the tolerance kept? Error over the tolerance asked for",
          "A dot for each random scene: the largest error along the rod, divided by the tolerance, over the tolerance. "
          "Nearly all dots lie below the line at 1, where the promise is kept; crosses above it break it.",
          "a dot a scene; columns: tolerances 1e-8 to 1e-2 L; below the line the promise is kept");
  Panel panel(svg, {80, 60}, 580, 410, {"tolerance / L", 3e-9, 3e-2, true},
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
  panel.dots(kept, method_row("fam").style.colour, 0.8);
  panel.curve({{3e-9, 1}, {3e-2, 1}}, {colour::black, 1.5, ""});
  for (const Point& point : broken) panel.failure(point, colour::orange);
  panel.name({2e-2, 1}, "the tolerance", colour::black);
  if (!broken.empty()) panel.name(broken.front(), "broken", colour::orange);
  panel.place_names();
  return svg.str();
}

std::vector<std::string> head(const std::string& first) {
  return {first,
          "scenes",
          "solved",
          "shape kept",
          "tip kept",
          "wrench kept",
          "other equilibrium",
          "worst error / tolerance",
          "worst wrench / tolerance",
          "estimate < error / 2",
          "arcs used / needed",
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

}  // namespace

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

bool is_low_estimate(const Promise& p) {
  return p.solved() && p.error > smallest_judged_error && p.estimate < p.error / 2;
}

std::map<std::string, std::string> outcome_tables(const std::vector<RandomOutcome>& outcomes) {
  std::map<std::array<std::string, 3>, int> counts;
  Table failures({"seed", "loads", "method", "outcome", "error_over_L", "estimate_over_L"});
  for (const RandomOutcome& o : outcomes) {
    ++counts[{o.loads, o.method, o.outcome}];
    if (!is_listed(o)) continue;
    failures.add({std::to_string(o.seed), o.loads, o.method, o.outcome, scientific(o.error, 0),
                  o.estimate < 1e-7 ? "<1e-07" : scientific(o.estimate, 0)});
  }
  Table table({"loads", "method", "outcome", "scenes"});
  for (const auto& [key, count] : counts) table.add({key[0], key[1], key[2], std::to_string(count)});
  return {{"counts.csv", table.csv()}, {"failures.csv", failures.csv()}};
}

std::map<std::string, std::string> promise_tables(const std::vector<Promise>& promises) {
  return {{"promise.csv", list_of(promises).csv()},
          {"tolerances.csv", by_tolerance(promises).csv()},
          {"kinds.csv", by_kind(promises).csv()},
          {"unsolved.csv", unsolved(promises).csv()},
          {"promise.svg", chart(promises)}};
}

std::map<std::string, std::string> estimate_tables(const std::vector<Promise>& promises) {
  return {{"estimates.csv", by_kind(promises).csv()},
          {"estimates_low.csv", list_of(those(promises, is_low_estimate)).csv()}};
}

// Where an outcome of outcomes.h stands in the table, and its column.
std::string column_of(const std::string& outcome) {
  static const std::map<std::string, std::string> columns = {{"wrong and not flagged", "wrong, silent"},
                                                             {"wrong branch", "wrong, silent"},
                                                             {"not converged", "no answer"},
                                                             {"work limit", "no answer"},
                                                             {"unsupported", "no answer"},
                                                             {"no judge", "no judge"},
                                                             {"not converged either", "no judge"},
                                                             {"crash", "no answer"}};
  const auto found = columns.find(outcome);
  return found == columns.end() ? outcome : found->second;
}

Table outcomes_by_method(const std::vector<RandomOutcome>& outcomes) {
  const std::vector<std::string> columns = {"right to 1e-6",     "right to 1e-4", "right to 1e-2", "tolerance missed",
                                            "wrong but flagged", "wrong, silent", "no answer",     "no judge"};
  std::map<std::array<std::string, 2>, std::map<std::string, int>> counts;
  for (const RandomOutcome& o : outcomes) {
    const char* kind = o.seed < first_buckling_seed ? "general" : o.seed < first_family_seed ? "buckling" : "families";
    if (o.method == "fam" || o.method == "fem") ++counts[{kind, o.method}][column_of(o.outcome)];
    if (stopped_the_judge(o)) ++counts[{kind, "fam"}]["no judge"];
  }
  std::vector<std::string> names = {"scenes", "method", "asked"};
  names.insert(names.end(), columns.begin(), columns.end());
  Table table(names);
  for (const char* method : {"fam", "fem"}) {
    for (const char* kind : {"general", "buckling", "families"}) {
      std::map<std::string, int>& of = counts[{kind, method}];
      int all = 0;
      for (const auto& [column, count] : of) all += count;
      std::vector<std::string> cells = {kind, method_row(std::string(method) == "fam" ? "fam" : "fe").name,
                                        std::to_string(all)};
      for (const std::string& column : columns) cells.push_back(std::to_string(of[column]));
      table.add(cells);
    }
  }
  return table;
}

}  // namespace studies
