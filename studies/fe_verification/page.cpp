#include "studies/fe_verification/page.h"

#include "studies/report/chart.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr double floor_over_L = 1e-11;  // errors below are shown as this: round-off of solves of this condition
constexpr const char* order_names[] = {"", "linear", "quadratic", "cubic"};

double shown(double error) {
  return std::max(error, floor_over_L);
}

std::string error_text(double error) {
  return error < 0 ? "×" : scientific(shown(error), 1);
}

std::string convergence_csv(const FeVerification& data) {
  Table table({"rod", "order", "integration", "elements", "tip_error_over_L"});
  for (const FeConvergence& c : data.convergence) {
    table.add({c.rod, std::to_string(c.order), c.full_integration ? "full" : "reduced", std::to_string(c.elements),
               error_text(c.error_over_L)});
  }
  return table.csv({"Against the exact rod. Errors below 1e-11 are written as 1e-11; x: not converged."});
}

std::string own_error_csv(const FeVerification& data) {
  Table table({"scene", "tip_error_over_L", "estimate_over_L", "kirchhoff_tip_error_over_L", "load_steps",
               "newton_iterations"});
  for (const FeOwnError& e : data.own_errors) {
    table.add({e.scene, error_text(e.error_over_L), error_text(e.estimate_over_L), error_text(e.kirchhoff_error_over_L),
               std::to_string(e.load_steps), std::to_string(e.newton_iterations)});
  }
  return table.csv({"50 quadratic elements, reduced integration, against the exact rod of the same model."});
}

std::string work_csv(const FeVerification& data) {
  Table table({"model", "F_L2_over_EI", "status", "load_steps", "newton_iterations"});
  for (const FeWork& w : data.work) {
    table.add({w.model, fmt::format("{:g}", w.load), w.status, std::to_string(w.load_steps),
               std::to_string(w.newton_iterations)});
  }
  return table.csv({"Fixed transverse tip force, 50 quadratic elements."});
}

const FeConvergence& convergence(const FeVerification& data, const std::string& rod, int order, bool full,
                                 int elements) {
  return *std::find_if(data.convergence.begin(), data.convergence.end(), [&](const FeConvergence& c) {
    return c.rod == rod && c.order == order && c.full_integration == full && c.elements == elements;
  });
}

std::string convergence_table(const FeVerification& data, const std::string& rod) {
  std::vector<std::string> columns{"elements"};
  for (const char* integration : {"reduced", "full"}) {
    for (int order = 1; order <= 3; ++order) {
      columns.push_back(fmt::format("{}, {}", order_names[order], integration));
      columns.push_back("order");
    }
  }
  Table table(columns);
  for (int elements = 1; elements <= 256; elements *= 2) {
    std::vector<std::string> cells{std::to_string(elements)};
    for (const bool full : {false, true}) {
      for (int order = 1; order <= 3; ++order) {
        const double error = convergence(data, rod, order, full, elements).error_over_L;
        cells.push_back(error_text(error));
        const double coarse = elements > 1 ? convergence(data, rod, order, full, elements / 2).error_over_L : -1;
        const bool resolved = coarse > 0 && error > 10 * floor_over_L;
        cells.push_back(resolved ? fixed(std::log2(coarse / error), 1) : "–");
      }
    }
    table.add(cells);
  }
  return table.markdown();
}

std::string own_error_table(const FeVerification& data) {
  Table table({"scene", "error / L", "estimate / L", "estimate / error", "Kirchhoff model: error / L", "load steps",
               "Newton iterations"});
  for (const FeOwnError& e : data.own_errors) {
    table.add({e.scene, error_text(e.error_over_L), error_text(e.estimate_over_L),
               fixed(e.estimate_over_L / e.error_over_L, 1), error_text(e.kirchhoff_error_over_L),
               std::to_string(e.load_steps), std::to_string(e.newton_iterations)});
  }
  return table.markdown();
}

std::string work_table(const FeVerification& data) {
  Table table({"F L²/EI", "model", "status", "load steps", "Newton iterations"});
  for (const FeWork& w : data.work) {
    table.add({fmt::format("{:g}", w.load), w.model, w.status, std::to_string(w.load_steps),
               std::to_string(w.newton_iterations)});
  }
  return table.markdown();
}

double largest_own_error(const FeVerification& data) {
  double largest = 0;
  for (const FeOwnError& e : data.own_errors) largest = std::max(largest, e.error_over_L);
  return largest;
}

std::string page(const FeVerification& data) {
  return fmt::format(
      R"(# How good is the finite element reference?

The finite elements (`fem_reference/`) stand in for the commercial code that the paper compares with. Here they are judged
themselves, by the exact rod equations (`exact_reference/`). An element of order p has p + 1 nodes; *reduced* integration
samples it at p Gauss points, *full* at p + 1.

## Order of convergence

Tip error over L; order = log₂ of the ratio to the row above. Case S4 of Study I with fixed loads, real section (6 mm thick,
40 mm long). Errors below 1e-11 are shown as 1e-11, × means not converged.

{}
With reduced integration the tip converges with order 2p: 2, 4 and 6.

![Convergence, thick and thin rod](convergence.svg)

## Locking

The same loads on a rod as stiff in bending but a thousand times stiffer in shear and stretch (EI/(kGA L²) = 1e-6). With
full integration an element cannot bend without shearing at one of its points, so it hardly bends at all until the
elements are as short as the rod is thin: linear elements of full integration are {} L off with 16 elements, of
reduced integration {} L. This is why reduced integration is the default.

{}
## Its own error at 50 quadratic elements

All 32 scenes of Study I, against the exact rod of the same model: at most {} L. The estimate comes from a second solve
with half the elements. The Kirchhoff model leaves shear and stretch out exactly (no penalty), and is as accurate.

{}
## Load steps and Newton iterations

A fixed transverse force at the tip, 50 quadratic elements; steps adapt so that no node turns by more than 0.6 rad in one.
Counts may differ by one or two on another machine.

{}
Files: `convergence.csv`, `own_error.csv`, `work.csv`, `provenance.json`. Rerun with
`build/release/bin/fam-studies fe-verification`.
)",
      convergence_table(data, "thick"), scientific(convergence(data, "thin", 1, true, 16).error_over_L, 1),
      scientific(convergence(data, "thin", 1, false, 16).error_over_L, 1), convergence_table(data, "thin"),
      scientific(largest_own_error(data), 1), own_error_table(data), work_table(data));
}

std::string headline(const FeVerification& data) {
  return fmt::format(
      "## [Finite element verification](fe_verification/README.md): how good is the reference?\n\n"
      "Against the exact rod equations the tip of linear, quadratic and cubic elements converges with order 2, 4 and "
      "6; "
      "50 quadratic elements are within {} L on all 32 scenes of Study I. Full integration locks on thin rods; the "
      "reference integrates reduced.\n\n![Convergence](fe_verification/convergence.svg)\n",
      scientific(largest_own_error(data), 1));
}

void draw(Svg& svg, const FeVerification& data, const std::string& rod, const std::string& title, double left) {
  const std::string colours[] = {"", colour::orange, colour::blue, colour::green};
  Panel panel(svg, {left, 66}, 360, 320, {"elements", 1, 256, true}, {"tip error / L", 1e-12, 1, true});
  panel.frame(title);
  panel.band(1e-12, floor_over_L, "shaded: round-off");
  for (const bool full : {false, true}) {
    for (int order = 1; order <= 3; ++order) {
      std::vector<Point> points;
      for (const FeConvergence& c : data.convergence) {
        if (c.rod != rod || c.order != order || c.full_integration != full) continue;
        const double elements = c.elements;
        if (c.error_over_L < 0) panel.failure({elements, 0.5}, colours[order]);
        else points.push_back({elements, std::min(1.0, shown(c.error_over_L))});
      }
      panel.curve(points, {colours[order], 1.6, full ? "4 3" : ""});
      panel.dots(points, colours[order], 2.5);
      if (!points.empty()) {
        panel.name(points.back(), std::string(order_names[order]) + (full ? ", full" : ""), colours[order]);
      }
    }
  }
  panel.place_names();
}

std::string convergence_picture(const FeVerification& data) {
  Svg svg(1130, 450, "Finite elements against the exact rod: full lines reduced, dashed full integration",
          "Finite elements against the exact rod: full lines reduced, dashed full integration");
  draw(svg, data, "thick", "S4, fixed loads, real section", 80);
  draw(svg, data, "thin", "the same loads, EI/(kGA L²) = 1e-6", 640);
  return svg.str();
}

}  // namespace

std::map<std::string, std::string> fe_verification_files(const FeVerification& data) {
  return {{"README.md", page(data)},
          {"headline.md", headline(data)},
          {"convergence.csv", convergence_csv(data)},
          {"own_error.csv", own_error_csv(data)},
          {"work.csv", work_csv(data)},
          {"convergence.svg", convergence_picture(data)}};
}

}  // namespace studies
