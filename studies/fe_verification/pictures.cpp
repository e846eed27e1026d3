#include "studies/fe_verification/data.h"

#include "studies/methods/registry.h"
#include "studies/report/chart.h"

#include <algorithm>

namespace studies {
namespace {

const Axis error_axis{"tip error / L", 1e-12, 1, true};

// Green, dashed by order: reduced integration, the one in use; grey, the same dashes: full.
void draw_curve(Panel& panel, const FeVerification& data, const std::string& rod, int order, bool full) {
  const char* keys[] = {"fe_linear", "fe", "fe_cubic"};
  const char* names[] = {"linear", "quadratic", "cubic"};
  const Style& style = method_row(keys[order - 1]).style;
  const std::string colour = full ? colour::grey : style.colour;
  std::vector<Point> points;
  for (const FeConvergence& c : data.convergence) {
    if (c.rod != rod || c.order != order || c.full_integration != full) continue;
    if (c.error_over_L < 0) panel.failure({1.0 * c.elements, 0.5}, colour);
    else points.push_back({1.0 * c.elements, std::clamp(c.error_over_L, fe_floor_over_L, 1.0)});
  }
  panel.curve(points, {colour, 1.6, style.dash});
  panel.dots(points, colour, 2.5);
  // Named at 32 elements, or where the last error clear of round-off is: inside the panel.
  std::size_t at = 0;
  while (at + 1 < points.size() && at < 5 && points[at + 1].y > fe_floor_over_L) ++at;
  if (points.empty()) return;
  panel.name(points[at], names[order - 1] + std::string(full ? ", full" : ""), colour);
}

void draw_rod(Svg& svg, const FeVerification& data, const std::string& rod, const std::string& title, double left) {
  Panel panel(svg, {left, 86}, 355, 340, {"elements", 1, 256, true}, error_axis);
  panel.frame(title);
  panel.band(1e-12, fe_floor_over_L, "round-off");
  for (const bool full : {true, false}) {
    for (int order = 1; order <= 3; ++order) draw_curve(panel, data, rod, order, full);
  }
  panel.place_names();
}

}  // namespace

std::string fe_convergence_picture(const FeVerification& data) {
  Svg svg(900, 486, "Finite elements against the exact rod",
          "Two panels with the same axes, both logarithmic: tip error over the length, 1e-12 to 1, over the number of "
          "elements, 1 to 256. Left the rod of case S4, right one a thousand times stiffer in shear. Six curves each: "
          "linear, quadratic and cubic elements, green with reduced and grey with full integration. A straight fall is "
          "an order of convergence; a grey curve that stays level at the top locks. The grey band at the bottom is "
          "round-off.",
          "Green: reduced integration (in use); grey: full. Dashes: linear; full line: quadratic; dots: cubic");
  draw_rod(svg, data, "thick", "S4, fixed loads, real section", 80);
  draw_rod(svg, data, "thin", "the same loads, EI/(kGA L²) = 1e-6", 525);
  return svg.str();
}

std::string fe_own_error_picture(const FeVerification& data) {
  const Style& style = method_row("fe").style;
  Svg svg(
      560, 470, "50 quadratic elements on Study I: own error and its estimate",
      "A dot a scene of Study I, both axes logarithmic. Horizontal: the tip's true error over the length; vertical: "
      "the estimate from a second solve with half the elements. The grey line is estimate = error: dots above it "
      "are estimated too large, which is safe.",
      "A dot a scene; filled: fixed loads, ring: follower loads; grey line: estimate = error");
  Panel panel(svg, {80, 66}, 440, 340, {"tip error / L", 1e-10, 1e-4, true}, {"estimate / L", 1e-10, 1e-4, true});
  panel.frame();
  panel.curve({{1e-10, 1e-10}, {1e-4, 1e-4}}, {colour::grey, 1, ""});
  for (const FeOwnError& e : data.own_errors) {
    if (e.error_over_L < 0) continue;
    const Point p{std::clamp(e.error_over_L, 1e-10, 1e-4), std::clamp(e.estimate_over_L, 1e-10, 1e-4)};
    panel.dots({p}, style.colour, 4);
    if (e.scene.ends_with("follower")) panel.dots({p}, "white", 2.4);
  }
  return svg.str();
}

}  // namespace studies
