// The page and the chart of the promise (promise.h).
#include "studies/chart.h"
#include "studies/promise.h"
#include "studies/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::string chart(const std::vector<Promise>& promises) {
  Svg svg(620, 520);
  Panel panel(svg, {80, 40}, 500, 410, {"error promised (tolerance / L)", 3e-10, 3e-2, true},
              {"true tip error / L", 1e-16, 1, true});
  panel.frame("Promised and true error of the automatic choice");
  std::vector<Point> kept, broken;
  for (const Promise& promise : promises) {
    if (!promise.converged) continue;
    // Scenes of one tolerance are spread over its column by their seed.
    const double spread = std::pow(10, 0.7 * (static_cast<double>(promise.seed / 8 % 97) / 96 - 0.5));
    const Point point{promise.tolerance * spread, std::clamp(promise.error, 1e-16, 1.0)};
    if (promise.error <= promise.tolerance) kept.push_back(point);
    else broken.push_back(point);
  }
  panel.dots(kept, colour::sky, 0.8);
  panel.curve({{3e-10, 3e-10}, {3e-2, 3e-2}}, {colour::black, 1.5, ""});
  for (const Point& point : broken) panel.failure(point, colour::orange);
  panel.name({1e-8, 1e-2}, "kept: below the line; broken: ×", colour::black);
  panel.place_names();
  return svg.str();
}

std::string table(const std::vector<Promise>& promises) {
  Table table({"tolerance / L", "solved", "kept", "other equilibrium", "worst error / tolerance",
               "median error / tolerance", "arcs used / needed, median", "90 %"});
  for (int decade = 2; decade <= 9; ++decade) {
    std::vector<Promise> some;
    std::vector<double> ratios;
    for (const Promise& promise : promises) {
      if (std::lround(-std::log10(promise.tolerance)) != decade) continue;
      some.push_back(promise);
      if (promise.converged && promise.same_branch) ratios.push_back(promise.error / promise.tolerance);
    }
    if (some.empty()) continue;
    std::sort(ratios.begin(), ratios.end());
    const PromiseCounts counts = count(some);
    table.add({fmt::format("1e-{}", decade), std::to_string(counts.solved), std::to_string(counts.kept),
               std::to_string(counts.other_branch), ratios.empty() ? "–" : fixed(ratios.back(), 2),
               ratios.empty() ? "–" : fixed(ratios[ratios.size() / 2], 3), fixed(counts.median_waste, 2),
               fixed(counts.waste_90, 2)});
  }
  return table.markdown();
}

}  // namespace

std::map<std::string, std::string> promise_files(const std::vector<Promise>& promises) {
  const PromiseCounts counts = count(promises);
  Table list(
      {"seed", "tolerance_over_L", "converged", "same_branch", "estimate_over_L", "error_over_L", "arcs", "needed"});
  for (const Promise& p : promises) {
    if (p.converged && p.error <= p.tolerance) continue;
    list.add({std::to_string(p.seed), scientific(p.tolerance, 0), p.converged ? "1" : "0", p.same_branch ? "1" : "0",
              scientific(p.estimate, 1), scientific(p.error, 1), std::to_string(p.arcs), std::to_string(p.needed)});
  }
  const std::string page =
      fmt::format(R"(# Is the promise kept?

`fam solve` without options chooses plane or space, shear or none, law, solver and the number of arcs for a tolerance, and
returns an error estimate. Here it solves {scenes} random scenes (`studies/random_scene.cpp`: all load kinds, 1 to 20 sections,
stiffnesses over 12 decades, loads up to 1000 EI/L²), with tolerances from 1e-2 to 1e-9 L in turn; the exact reference judges the
tip.

- Kept: {kept} of {solved} solved, {share:.2f} %. On the same equilibrium as the exact reference: {same_share:.3f} %.
- Where it was broken on the same equilibrium, the error was at most {worst:.1f} times the tolerance.
- Another equilibrium than the exact reference's: {other}. FAM said that it did not converge: {failed}.
- Arcs used over arcs needed (the fewest, shared out by length, with a true error within the tolerance; looked for on a
  quarter of the scenes): median {waste:.2f}, nine
  in ten below {waste90:.2f}. Below 1: by length alone more are needed.

![Promised and true error](promise.svg)

{table}
Promises not kept, with the seeds (`random_scenes scene SEED` prints the scene): [promise.csv](promise.csv).
)",
                  fmt::arg("scenes", promises.size()), fmt::arg("kept", counts.kept), fmt::arg("solved", counts.solved),
                  fmt::arg("share", 100.0 * counts.kept / counts.solved),
                  fmt::arg("same_share", 100.0 * counts.kept / (counts.solved - counts.other_branch)),
                  fmt::arg("worst", std::max(1.0, counts.worst_excess)), fmt::arg("other", counts.other_branch),
                  fmt::arg("failed", counts.not_converged), fmt::arg("waste", counts.median_waste),
                  fmt::arg("waste90", counts.waste_90), fmt::arg("table", table(promises)));
  return {{"README.md", page}, {"promise.csv", list.csv()}, {"promise.svg", chart(promises)}};
}

}  // namespace studies
