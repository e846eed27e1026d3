#include "studies/report/chart.h"
#include "studies/report/table.h"
#include "studies/scenes/cases.h"
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
  const double margin = 0.14 * (axis.high - axis.low);
  axis.low -= margin;
  axis.high += margin;
  return axis;
}

// The lateral forces along y as arrows that start at the curve of the forces alone, with their values.
void draw_forces(Svg& svg, Panel& panel, const Study2Data& data, const Axis& axis) {
  const Study2Row& exact = row(data, "study2", "exact");
  for (const scene::Load& load : data.forces_alone.loads) {
    const auto* force = known_load<scene::Force>(load);
    if (!force || exact.s_mm.empty()) continue;
    std::size_t i = 0;
    while (i + 1 < exact.s_mm.size() && exact.s_mm[i] < force->at_mm - 1e-6) ++i;
    const double up = force->value_N[1] > 0 ? 1 : -1;
    const Point from{exact.s_mm[i], exact.positions_mm[i][1]};
    const Point to{from.x, from.y + 0.1 * up * (axis.high - axis.low)};
    panel.curve({from, to}, {colour::purple, 1.6, ""});
    const Point tip = panel.at(to);
    svg.polygon({{tip.x, tip.y - 6 * up}, {tip.x - 4, tip.y + 3 * up}, {tip.x + 4, tip.y + 3 * up}}, colour::purple);
    panel.name(to, for_reader(fmt::format("{:.3g} N", force->value_N[1])), colour::purple);
  }
}

std::string tips_text(const Study2Data& data) {
  std::string text;
  for (const Curve& c : curves) {
    const std::vector<Point> points = deflections(row(data, c.scene, "exact"), c.axis);
    if (!points.empty()) text += fmt::format("{}{} {}", text.empty() ? "" : "; ", c.name, fixed(points.back().y, 0));
  }
  return text;
}

}  // namespace

std::string deflection_picture(const Study2Data& data) {
  Svg svg(900, 480, "Study II: deflection along the catheter, forces of our own",
          "Deflection in mm over arc length in mm. Black lines, the exact rod: y under the three forces alone; y with "
          "the catheter's weight along −y; y and z with the weight along −z. At the tip, mm: " +
              tips_text(data) +
              ". Orange dots on the first line: FAM published with 12 arcs. Arrows: the three forces.",
          "lines: exact; dots: FAM published, 12 arcs, frames given; arrows: the forces");
  const double length_mm = scene::length_mm(data.forces_alone);
  const Axis axis = deflection_axis(data);
  Panel panel(svg, {80, 64}, 620, 350, {"arc length s, mm", 0, length_mm, false}, axis);
  panel.frame();
  for (const Curve& c : curves) {
    const std::vector<Point> points = deflections(row(data, c.scene, "exact"), c.axis);
    if (points.empty()) continue;
    panel.curve(points, {method_row("exact").style.colour, 1.6, c.dash});
    panel.name(points.back(), c.name, method_row("exact").style.colour);
  }
  panel.dots(deflections(row(data, "study2", "fam_published_12"), 1, 2), method_row("fam_published").style.colour, 3);
  draw_forces(svg, panel, data, axis);
  panel.place_names();
  return svg.str();
}

std::string errors_picture(const Study2Data& data) {
  constexpr double floor = 1e-8;
  const std::vector<std::pair<std::string, std::string>> series = {
      {"fam_published_12", ""}, {"fam_published_50", "5 3"}, {"fam", "2 3"},
      {"fam_1e-3", "9 3 2 3"},  {"exact_kirchhoff", "5 3"},  {"fe", ""}};
  std::string largest;
  for (const auto& [method, dash] : series) {
    largest += fmt::format("{}{} {}", largest.empty() ? "" : "; ", study2_label(method),
                           scientific(largest_error_mm(row(data, "study2", method)), 1));
  }
  Svg svg(900, 460, "Study II, forces alone: distance from the exact rod along the catheter",
          "Distance from the exact rod in mm, logarithmic, over arc length in mm, a curve a method. Largest, mm: " +
              largest + ".",
          "FAM published is given the forces in the frames of the bent sections");
  Panel panel(svg, {80, 64}, 600, 330, {"arc length s, mm", 0, scene::length_mm(data.forces_alone), false},
              {"distance, mm", floor, 1, true});
  panel.frame();
  for (const auto& [method, dash] : series) {
    const Study2Row& r = row(data, "study2", method);
    std::vector<Point> points;
    for (std::size_t i = 1; i < r.s_mm.size(); ++i) points.push_back({r.s_mm[i], std::max(r.errors_mm[i], floor)});
    if (points.empty()) continue;
    const std::string& colour = method_row(study2_method(method).row).style.colour;
    panel.curve(points, {colour, 1.6, dash});
    panel.name(points.back(), study2_label(method), colour);
  }
  panel.place_names();
  return svg.str();
}

}  // namespace studies
