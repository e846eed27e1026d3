#include "studies/report/chart.h"
#include "studies/report/table.h"
#include "studies/study2/page.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

std::vector<Point> deflections(const Study2Row& row, int axis, std::size_t step = 1) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < row.s_mm.size(); i += step) points.push_back({row.s_mm[i], row.positions_mm[i][axis]});
  return points;
}

struct Curve {
  const char *scene, *name;
  int axis;
  const char* dash;
};
const std::vector<Curve> curves = {{"study2", "y, forces alone", 1, ""},
                                   {"study2_gravity_y", "y, weight along −y", 1, "9 4"},
                                   {"study2_gravity_z", "y, weight along −z", 1, "2 3"},
                                   {"study2_gravity_z", "z, weight along −z", 2, "9 3 2 3"}};

Axis deflection_axis(const Study2Data& data) {
  Axis axis{"deflection, mm", -10, 10, false};
  for (const Curve& c : curves) {
    for (const Point& p : deflections(row(data, c.scene, "exact"), c.axis)) {
      axis.low = std::min(axis.low, p.y);
      axis.high = std::max(axis.high, p.y);
    }
  }
  const double margin = 0.12 * (axis.high - axis.low);
  axis.low -= margin;
  axis.high += margin;
  return axis;
}

// The lateral forces along y as arrows that end at the curve of the forces alone, with their values.
void draw_forces(Svg& svg, const Panel& panel, const Study2Data& data) {
  const Study2Row& exact = row(data, "study2", "exact");
  for (const scene::Load& load : data.forces_alone.loads) {
    const auto* force = std::get_if<scene::Force>(&load);
    if (!force || exact.s_mm.empty()) continue;
    std::size_t i = 0;
    while (i + 1 < exact.s_mm.size() && exact.s_mm[i] < force->at_mm - 1e-6) ++i;
    const double up = force->value_N[1] > 0 ? 1 : -1;
    const Point end = panel.at({exact.s_mm[i], exact.positions_mm[i][1]});
    const Point tip{end.x, end.y + 5 * up};
    svg.line({tip.x, tip.y + 30 * up}, tip, {colour::purple, 1.6, ""});
    svg.polygon({tip, {tip.x - 4, tip.y + 9 * up}, {tip.x + 4, tip.y + 9 * up}}, colour::purple);
    svg.text({tip.x, tip.y + (up > 0 ? 44.0 : -36.0)}, for_reader(fmt::format("{:.3g} N", force->value_N[1])),
             Anchor::middle, 12, colour::purple);
  }
}

}  // namespace

std::string deflection_picture(const Study2Data& data) {
  Svg svg(900, 480, "Study II: deflection along the catheter, forces of our own",
          "Deflection in mm over arc length in mm. Black lines, the exact rod: y under the three forces alone; y with "
          "the catheter's weight along −y, which bends it down by more than a hundred millimetres; y and z with the "
          "weight along −z. Orange dots on the first line: FAM published with 12 arcs. Arrows: the three forces.",
          "lines: exact; dots: FAM published, 12 arcs, frames given; arrows: the forces");
  const double length_mm = scene::length_mm(data.forces_alone);
  Panel panel(svg, {80, 64}, 620, 350, {"arc length s, mm", 0, length_mm, false}, deflection_axis(data));
  panel.frame();
  for (const Curve& c : curves) {
    const std::vector<Point> points = deflections(row(data, c.scene, "exact"), c.axis);
    if (points.empty()) continue;
    panel.curve(points, {method_row("exact").style.colour, 1.6, c.dash});
    panel.name(points.back(), c.name, method_row("exact").style.colour);
  }
  panel.dots(deflections(row(data, "study2", "fam_published_12"), 1, 2), method_row("fam_published").style.colour, 3);
  draw_forces(svg, panel, data);
  panel.place_names();
  return svg.str();
}

std::string errors_picture(const Study2Data& data) {
  struct Series {
    const char *method, *dash;
  };
  constexpr double floor = 1e-8;
  Svg svg(900, 460, "Study II, forces alone: distance from the exact rod along the catheter",
          "Distance from the exact rod in mm, logarithmic, over arc length in mm. FAM published with 12 arcs lies "
          "highest and with 50 arcs below it; then the automatic choices of FAM, the exact rod without shear and "
          "stretch, and FE. All errors grow in the first third and stay of that size to the tip.",
          "the published law is given the forces in the frames of the bent sections");
  Panel panel(svg, {80, 64}, 600, 330, {"arc length s, mm", 0, scene::length_mm(data.forces_alone), false},
              {"distance, mm", floor, 1, true});
  panel.frame();
  for (const Series& s : {Series{"fam_published_12", ""}, Series{"fam_published_50", "5 3"}, Series{"fam", "2 3"},
                          Series{"fam_1e-3", "9 3 2 3"}, Series{"exact_kirchhoff", "5 3"}, Series{"fe", ""}}) {
    const Study2Row& r = row(data, "study2", s.method);
    std::vector<Point> points;
    for (std::size_t i = 1; i < r.s_mm.size(); ++i) points.push_back({r.s_mm[i], std::max(r.errors_mm[i], floor)});
    if (points.empty()) continue;
    const std::string& colour = method_row(study2_method(s.method).row).style.colour;
    panel.curve(points, {colour, 1.6, s.dash});
    panel.name(points.back(), study2_label(s.method), colour);
  }
  panel.place_names();
  return svg.str();
}

}  // namespace studies
