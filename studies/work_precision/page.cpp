#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/work_precision/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace studies {
namespace {

constexpr double printed_fam_ms = 3, printed_fe_ms = 1244;  // the paper's abstract, its machine and loads

std::string target_text(double target) {
  return scientific(target, 0) + " L";
}

// Scenes of a group where a resolution was tried and not refused, and where it is within the target.
struct Share {
  int holds = 0, tried = 0;
};

Share share_of(const WorkData& data, const WorkGroup& group, const std::string& series, const std::string& model,
               const std::string& label, double target) {
  Share share;
  for (const std::string& scene : group.scenes) {
    for (const WorkPoint* p : data.of(scene, series, model)) {
      if (p->label != label || p->status == "unsupported") continue;
      ++share.tried;
      if (p->converged() && p->error <= target) ++share.holds;
    }
  }
  return share;
}

// The coarsest resolution within the target on as many scenes of the group as any; "32 [15/16]" where these are not
// all, "–" where there is none.
std::string coarsest(const WorkData& data, const WorkGroup& group, const std::string& series, const std::string& model,
                     double target) {
  std::string best_label;
  Share best;
  for (const std::string& label : data.labels(series, model, group.scenes)) {
    const Share share = share_of(data, group, series, model, label, target);
    if (share.holds <= best.holds) continue;
    best = share;
    best_label = label;
  }
  if (best.holds == 0) return "–";
  if (best.holds == static_cast<int>(group.scenes.size())) return best_label;
  return fmt::format("{} [{}/{}]", best_label, best.holds, best.tried);
}

bool took_part(const WorkData& data, const WorkGroup& group, const std::string& series, const std::string& model) {
  return std::any_of(group.scenes.begin(), group.scenes.end(),
                     [&](const std::string& scene) { return !data.of(scene, series, model).empty(); });
}

std::string group_table(const WorkData& data, const WorkGroup& group) {
  std::vector<std::string> head{"method", "model"};
  for (const double target : work_targets) head.push_back(target_text(target));
  Table table(head);
  for (const std::string& model : work_models) {
    for (const std::string& series : data.series(model)) {
      std::vector<std::string> cells{series, model};
      for (const double target : work_targets) cells.push_back(coarsest(data, group, series, model, target));
      const bool some = std::any_of(cells.begin() + 2, cells.end(), [](const std::string& c) { return c != "–"; });
      if (some) table.add(std::move(cells));
    }
  }
  return table.markdown();
}

std::string single_scenes_table(const WorkData& data, double target) {
  std::vector<std::string> head{"method", "model"};
  for (const WorkGroup& group : data.groups) {
    if (group.scenes.size() == 1) head.push_back(group.name);
  }
  Table table(head);
  for (const std::string& model : work_models) {
    for (const std::string& series : data.series(model)) {
      std::vector<std::string> cells{series, model};
      for (const WorkGroup& group : data.groups) {
        if (group.scenes.size() > 1) continue;
        cells.push_back(took_part(data, group, series, model) ? coarsest(data, group, series, model, target) : "");
      }
      table.add(std::move(cells));
    }
  }
  return table.markdown();
}

// Scenes where the finest resolution of a series fails, by kind.
struct Failures {
  int scenes = 0, unsupported = 0;
  std::string not_converged, lost, worse;
};

// A finer resolution at least twice as far away as a coarser one, above round-off.
bool worsens(const std::vector<const WorkPoint*>& points) {
  constexpr double resolved = 1e-9;
  double least = std::numeric_limits<double>::infinity();
  for (const WorkPoint* p : points) {
    if (p->converged() && p->error > resolved && p->error > 2 * least) return true;
    if (p->converged()) least = std::min(least, p->error);
  }
  return false;
}

Failures failures_of(const WorkData& data, const std::string& series, const std::string& model) {
  Failures failures;
  const auto add = [](std::string& list, const std::string& name) { list += (list.empty() ? "" : ", ") + name; };
  for (const WorkGroup& group : data.groups) {
    for (const std::string& scene : group.scenes) {
      const std::vector<const WorkPoint*> points = data.of(scene, series, model);
      if (points.empty()) continue;
      const WorkPoint& finest = *points.back();
      ++failures.scenes;
      if (worsens(points)) add(failures.worse, scene);
      if (finest.status == "unsupported") ++failures.unsupported;
      else if (!finest.converged()) add(failures.not_converged, scene + " (" + finest.status + ")");
      else if (finest.error > lost_error) add(failures.lost, scene);
    }
  }
  return failures;
}

std::string failures_table(const WorkData& data) {
  Table table({"method", "model", "scenes", "unsupported", "no convergence", "another equilibrium", "finer yet worse"});
  for (const std::string& model : work_models) {
    for (const std::string& series : data.series(model)) {
      const Failures f = failures_of(data, series, model);
      table.add(
          {series, model, std::to_string(f.scenes), std::to_string(f.unsupported), f.not_converged, f.lost, f.worse});
    }
  }
  return table.markdown();
}

// "12.3 (×1.0)", with "[5/16]" where not all scenes of the group reach the target.
std::string time_cell(const GroupTime& time, double best, std::size_t scenes) {
  if (time.reached == 0) return "–";
  const bool all = static_cast<std::size_t>(time.reached) == scenes;
  const std::string share = all ? "" : fmt::format(" [{}/{}]", time.reached, time.tried);
  const double ratio = time.median_us / best;
  return fmt::format("{} (×{}){}", fixed(time.median_us, 1), fixed(ratio, ratio < 1 ? 2 : 1), share);
}

struct Row {
  std::string series;
  bool warm;
};

std::string time_table(const WorkData& data, const WorkGroup& group, const std::string& model) {
  std::vector<std::string> head{model + " rod"};
  for (const double target : work_targets) head.push_back(target_text(target));
  Table table(head);
  std::vector<Row> rows;
  for (const std::string& series : data.series(model)) {
    rows.push_back({series, false});
    if (series == "rk4 shooting") rows.push_back({series, true});
  }
  const auto time = [&](const Row& row, double target) {
    return group_time(data, group, row.series, model, target, row.warm);
  };
  std::vector<double> best(work_targets.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < best.size(); ++k) {
    for (const Row& row : rows) {
      const GroupTime t = time(row, work_targets[k]);
      const bool all = static_cast<std::size_t>(t.reached) == group.scenes.size();
      if (all && !row.warm) best[k] = std::fmin(best[k], t.median_us);
    }
  }
  for (const Row& row : rows) {
    if (!took_part(data, group, row.series, model)) continue;
    std::vector<std::string> cells{row.series + (row.warm ? ", warm" : "")};
    for (std::size_t k = 0; k < best.size(); ++k) {
      cells.push_back(time_cell(time(row, work_targets[k]), best[k], group.scenes.size()));
    }
    table.add(std::move(cells));
  }
  return table.markdown();
}

// Cheapest of all series whose name starts so.
double best_of_us(const WorkData& data, const std::string& scene, const std::string& start, double target) {
  double best = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& series : data.series("Reissner")) {
    if (series.rfind(start, 0) == 0) best = std::fmin(best, time_to_us(data, scene, series, "Reissner", target));
  }
  return best;
}

std::string ratio_text(double ratio) {
  return fixed(ratio, ratio < 1 ? 2 : ratio < 10 ? 1 : 0);
}

// Time of one family over that of FAM: median and range over the scenes where both reach the target.
std::string ratio_cell(const WorkData& data, const WorkGroup& group, const std::string& other, double target) {
  std::vector<double> ratios;
  for (const std::string& scene : group.scenes) {
    const double ratio = best_of_us(data, scene, other, target) / best_of_us(data, scene, "fam", target);
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  if (ratios.empty()) return "–";
  std::sort(ratios.begin(), ratios.end());
  const std::size_t n = ratios.size();
  const double middle = n % 2 ? ratios[n / 2] : (ratios[n / 2 - 1] + ratios[n / 2]) / 2;
  if (group.scenes.size() == 1) return ratio_text(middle);
  const std::string share = n < group.scenes.size() ? fmt::format(" [{}/{}]", n, group.scenes.size()) : "";
  return fmt::format("{} ({} … {}){}", ratio_text(middle), ratio_text(ratios.front()), ratio_text(ratios.back()),
                     share);
}

std::string ratio_table(const WorkData& data, const std::string& other) {
  std::vector<std::string> head{"scenes"};
  for (const double target : work_targets) head.push_back(target_text(target));
  Table table(head);
  for (const WorkGroup& group : data.groups) {
    std::vector<std::string> cells{group.name};
    for (const double target : work_targets) cells.push_back(ratio_cell(data, group, other, target));
    table.add(std::move(cells));
  }
  return table.markdown();
}

const char* fairness = R"(## What is inside the timed region

One thread; warm memory and caches; medians of repeats, quartiles in `timing.csv`. Reading the scene is outside for all.

- **fam** with fixed arcs: the march from tip to clamp (follower loads) or the boundary value solve from no load, with the
  poses of all arc ends; memory allocated beforehand; no error estimate. A prepared boundary value problem starts from no
  load every time it runs, so these times are cold; the library has no warm start to measure.
- **fam automatic**: all of `fam::solve`: spans, choice of model, runs with growing multiples of the first arcs, error estimate, allocation.
- **rk4 shooting**: Newton from zero with one integration and six differences an iteration, poses stored; memory allocated
  beforehand, fixed-size types. *warm*: from the solution under loads smaller by 1 %, that solution itself not timed;
  only resolutions where both solves converge. It ends at a residual of 1e-10 (EI/L², EI/L) at every resolution.
- **exact reference**: all of the solve with its second run for the error estimate; restarts, no prepared state.
- **closed form**: setting up the elastica and its tip alone; no other point of the rod.
- **fe**: all of the solve but the second mesh: model set-up, load steps, Newton, factorisations, stability check.

Tuned: for the finite elements both the project's load stepping (a quarter of the load first, at most 0.6 rad a step) and
*whole load* (all of it first, up to 3 rad, halved where Newton fails), to the same Newton tolerance of 1e-10, which coarse
targets do not need. They are a general code on deal.II, not one tuned for a single rod: a ratio to them is no bound on what
finite elements can do. Nothing was tuned to a scene, for any method. Rows of different rod models do not compete with each
other. A resolution counts as soon as it is within the target; an error that crosses zero by luck counts too. Resolutions lie a
factor of 2 apart (linear elements: 4 on most scenes), and so far, roughly, may times be from the best possible.
)";

}  // namespace

std::string work_precision_page(const WorkData& data) {
  const WorkGroup &follower = data.groups[0], &fixed_loads = data.groups[1];
  return fmt::format(R"(# Work and precision: what each method must spend for an accuracy

Every method at every resolution on {scenes} scenes: the 16 load cases of Study I (loads of our own, the paper's are lost) as
follower and as fixed loads; the catheter of Study II with gravity (density assumed); on a rod of 400 × 4 mm a fixed
transverse tip force with |F|L²/EI = 10, 100, 1000, an end moment that closes a circle, and a twist of 3 rad with a force.

**Error**: distance of the tip from the exact rod of the method's own model, over the length L; with shear and stretch
(Reissner) or without (Kirchhoff). `fam automatic` chooses its model and is held to the Reissner rod. The exact rod's own
error estimate is the last column of [accuracy.csv](accuracy.csv), at most {reference} L here.
**Times, ratios and pictures are in [timing.md](timing.md)**: they differ from run to run, the numbers below do not.

`rk4 shooting` is plain Cosserat shooting as it is common in continuum robotics: classical Runge–Kutta from clamp to tip,
Newton with forward differences on the six components of the base wrench, from zero, without safeguard
(`studies/rk4_shooting.h`). `fe … whole load` tries the full load at once, `fe … adaptive` starts with a quarter.

## Coarsest resolution within a tip error, 16 scenes at once

Arcs, steps, elements, or the tolerance asked for; [scenes within the error/scenes tried] where these are not all 16;
no other resolution tried is within it on more. Finite elements beyond 50, and Kirchhoff ones, were tried on one or two
of the 16 only. Methods that never get there are left out.

Follower loads:

{follower}
Fixed loads:

{fixed}
## Coarsest resolution within 1e-5 L, scene by scene

An empty cell: not tried. On fixed loads the exact reference meets 1e-12 L whatever it is asked for; at 1e-12 L it is the
judge itself. In space the published law has order 1; fixed loads are outside it. The closed form is for tip loads in one
plane.

{single}
## Where methods fail

At the finest resolution of each. Unsupported: refused with a message. Another equilibrium: converged, but more than
{lost} L away; plain Newton keeps to no branch, and its residual cannot tell. Finer yet worse: some resolution is at
least twice as far away as a coarser one (errors above 1e-9 L).

{failures}
## Files

`accuracy.csv`; apart from it `timing.csv`, `timing_to_accuracy.csv`, `timing.md`, `timing_overview.svg` and one
`timing_<scene>.svg` a scene; `provenance.json`. Rerun: `build/release/bin/fam-studies work-precision`.
)",
                     fmt::arg("scenes", 32 + data.groups.size() - 2),
                     fmt::arg("reference",
                              [&] {
                                double largest = 0;
                                for (const WorkPoint& p : data.points) largest = std::max(largest, p.reference_error);
                                return scientific(largest, 0);
                              }()),
                     fmt::arg("follower", group_table(data, follower)),
                     fmt::arg("fixed", group_table(data, fixed_loads)),
                     fmt::arg("single", single_scenes_table(data, 1e-5)), fmt::arg("lost", lost_error),
                     fmt::arg("failures", failures_table(data)));
}

std::string work_precision_headline(const WorkData& data) {
  return fmt::format(
      "## [Work and precision](work_precision/README.md): which method reaches which accuracy first\n\n"
      "For a tip within 1e-5 L on all 16 follower cases (Reissner rod) FAM needs {} sixth-order arcs, plain RK4 "
      "shooting {} "
      "steps, quadratic finite elements {}; on the 16 fixed cases {}, {} and {}. What that costs in time, with ratios "
      "at "
      "equal accuracy and what is inside the timed region: [timing](work_precision/timing.md).\n",
      coarsest(data, data.groups[0], "fam sixth_order", "Reissner", 1e-5),
      coarsest(data, data.groups[0], "rk4 shooting", "Reissner", 1e-5),
      coarsest(data, data.groups[0], "fe quadratic adaptive", "Reissner", 1e-5),
      coarsest(data, data.groups[1], "fam sixth_order", "Reissner", 1e-5),
      coarsest(data, data.groups[1], "rk4 shooting", "Reissner", 1e-5),
      coarsest(data, data.groups[1], "fe quadratic adaptive", "Reissner", 1e-5));
}

std::string work_precision_timing_page(const WorkData& data) {
  std::string tables;
  for (const WorkGroup& group : data.groups) {
    tables += "### " + group.name + "\n\n";
    for (const std::string& model : work_models) tables += time_table(data, group, model) + "\n";
    if (group.scenes.size() == 1) tables += fmt::format("![{0}](timing_{1}.svg)\n\n", group.name, group.scenes[0]);
  }
  return fmt::format(
      R"(# Work and precision: times

{machine}.

![Error over time](timing_overview.svg)

## The project's aims, in one run

Fewest arcs or steps n such that n, n + 1 and 2 n are within the true tip error (Kirchhoff rod); all in one process, one after
the other. S4: spatial, follower loads; P2 as fixed loads: 1 N across a rod of L = 40 mm, EI = 750 N mm². A further aim was to be
20 times as fast as plain shooting on the latter.

{aims}
Time of single kernels: [timing_kernels.csv](timing_kernels.csv) (Google Benchmark, `build/release/bin/kernel_benchmark`).

## FAM and finite elements at equal accuracy

Time of the cheapest finite elements over time of the cheapest FAM that are both within the tip error, Reissner rods; median
(least … largest) over the scenes. As printed, on another machine, for loads that are lost and at accuracies that are not
equal: {fam_ms:.0f} ms (FAM) to {fe_ms:.0f} ms (Abaqus), a ratio of {ratio:.0f}.

{fe}
## FAM and plain shooting at equal accuracy

The same for RK4 shooting from zero, over the scenes that it solves; below 1 the shooting is the faster one. Follower loads
are a march without iteration for FAM and a boundary value problem for the shooting; fixed loads are one for both, and there
FAM pays for load steps and checks that keep it on the branch from no load, which the shooting does without.

{rk4}
{fairness}
## Time to an accuracy

Median over the scenes, µs, of the cheapest resolution within the tip error; in parentheses over the best in the table that
gets there on all scenes, cold; [reached/tried] where not all do, the median then being over those that do.

{tables})",
      fmt::arg("machine", machine_line()), fmt::arg("aims", aims_table(data.aims)), fmt::arg("fam_ms", printed_fam_ms),
      fmt::arg("fe_ms", printed_fe_ms), fmt::arg("ratio", printed_fe_ms / printed_fam_ms),
      fmt::arg("fe", ratio_table(data, "fe")), fmt::arg("rk4", ratio_table(data, "rk4")),
      fmt::arg("fairness", fairness), fmt::arg("tables", tables));
}

}  // namespace studies
