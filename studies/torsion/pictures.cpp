#include "studies/report/chart.h"
#include "studies/report/table.h"
#include "studies/torsion/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// The published law's second order of rotations is dashed.
Stroke stroke_of(const TorsionLaw& law) {
  return {law.row.style.colour, 1.8, law.twist_first ? "5 3" : law.row.style.dash};
}

double missing_shear_mm(const TorsionData& data, double torque_Nmm) {
  return (data.tip(torque_Nmm, "exact_reissner").position_mm - data.tip(torque_Nmm, "exact_kirchhoff").position_mm)
      .norm();
}

void draw_errors(Svg& svg, double top, const std::string& title, const TorsionData& data, double largest_Nmm,
                 double named_at_Nmm) {
  constexpr double lowest_mm = 1e-9, highest_mm = 1000;
  Panel panel(svg, {80, top}, 590, 300, {"torque at the tip, N mm", 0, largest_Nmm},
              {"tip error, mm", lowest_mm, highest_mm, true});
  panel.frame(title);
  std::vector<Point> shear;
  for (const double torque : data.torques_Nmm) {
    if (torque <= largest_Nmm) shear.push_back({torque, std::max(missing_shear_mm(data, torque), lowest_mm)});
  }
  panel.curve(shear, {colour::grey, 1.5, "2 3"});
  if (largest_Nmm == largest_printed_Nmm) panel.name(shear.back(), "shear and stretch", colour::grey);
  for (const TorsionLaw& law : torsion_laws()) {
    std::vector<Point> points;
    for (const double torque : data.torques_Nmm) {
      const double error = data.own_mm(torque, law.key + "_12");
      if (torque > largest_Nmm) continue;
      if (std::isfinite(error)) points.push_back({torque, std::max(error, lowest_mm)});
      else panel.failure({torque, highest_mm}, law.row.style.colour);
    }
    panel.curve(points, stroke_of(law));
    panel.dots(points, law.row.style.colour, 2.5);
    const auto named = std::find_if(points.begin(), points.end(),
                                    [&](const Point& p) { return p.x >= named_at_Nmm + (law.twist_first ? 200 : 0); });
    panel.name(named == points.end() ? points.back() : *named, law.label(), law.row.style.colour);
  }
  panel.place_names();
}

std::string error_picture(const TorsionData& data) {
  Svg svg(880, 820, "Tip error with 12 arcs over the torque at the tip, case S1 (our loads)",
          "Two charts of the tip error in mm, logarithmic, over the follower torque: above from 0 to 50 N mm, the "
          "paper's range, below to 1000 N mm. Curves: FAM published in both orders of its "
          "rotations, midpoint, fourth order, sixth order, each with 12 arcs, and a dotted line for what shear and "
          "stretch move the tip. Look at the distance between the published law and the others.",
          "against the exact Kirchhoff rod; dotted grey: what shear and stretch, left out, would move the tip; "
          "x: no answer");
  draw_errors(svg, 80, "The paper's range", data, largest_printed_Nmm, largest_printed_Nmm);
  draw_errors(svg, 470, "On to where something fails", data, data.torques_Nmm.back(), 300);
  return svg.str();
}

std::string order_picture(const TorsionData& data) {
  Svg svg(880, 450, "Tip error over the number of arcs, 50 N mm at the tip of S1 (our loads)",
          "One chart of the tip error in mm over the number of arcs from 3 to 192, both logarithmic. Straight falling "
          "lines, the steeper the higher the order: FAM published in both orders of its rotations falls slowest, then "
          "midpoint, fourth order and, steepest, sixth order.",
          "against the exact Kirchhoff rod; a law of order p falls by 2^p at each doubling");
  Panel panel(svg, {80, 80}, 590, 310, {"number of arcs N", 2.5, 220, true}, {"tip error, mm", 1e-9, 100, true});
  panel.frame();
  for (const TorsionLaw& law : torsion_laws()) {
    std::vector<Point> points;
    for (const TorsionOrder& o : data.orders) {
      if (o.torque_Nmm == largest_printed_Nmm && o.law == law.key && o.own_mm > 1e-9) {
        points.push_back({static_cast<double>(o.arcs), o.own_mm});
      }
    }
    if (points.empty()) continue;
    panel.curve(points, stroke_of(law));
    panel.dots(points, law.row.style.colour, 2.5);
    panel.name(points.back(), law.label(), law.row.style.colour);
  }
  panel.place_names();
  return svg.str();
}

std::vector<Point> projected(const TorsionShape& shape, int right, int up) {
  std::vector<Point> points;
  for (const Eigen::Vector3d& p : shape.positions_mm) points.push_back({p[right], p[up]});
  return points;
}

void draw_shapes(Svg& svg, double left, const TorsionData& data, int right, int up) {
  const char* axes[] = {"x, mm", "y, mm", "z, mm"};
  Axis x{axes[right], 0, 0}, y{axes[up], 0, 0};
  for (const TorsionShape& shape : data.shapes) {
    for (const Point& p : projected(shape, right, up)) {
      x.low = std::min(x.low, p.x - 3), x.high = std::max(x.high, p.x + 3);
      y.low = std::min(y.low, p.y - 3), y.high = std::max(y.high, p.y + 3);
    }
  }
  equal_scale(x, y, 330, 330);
  Panel panel(svg, {left, 80}, 330, 330, x, y);
  panel.frame();
  const Style& published = method_row("fam_published").style;
  for (const TorsionShape& shape : data.shapes) {
    std::vector<Point> points = projected(shape, right, up);
    if (shape.method == "exact_kirchhoff") {
      std::vector<Point> few;
      for (std::size_t i = 0; i < points.size(); i += 4) few.push_back(points[i]);
      panel.dots(few, method_row("exact").style.colour, 2.4);
    } else {
      panel.curve(points, {published.colour, 1.8, published.dash});
      panel.name(points.back(), fmt::format("{} N mm", shape.torque_Nmm), published.colour);
    }
  }
  panel.place_names();
}

std::string shapes_picture(const TorsionData& data) {
  Svg svg(880, 470, "S1 (our loads) with a torque of 0, 20 and 50 N mm at the tip",
          "Two views of the bent rod, x-y beside y-z, the clamp at the origin, for 0, 20 and 50 N mm. The torque "
          "swings the tip round the rod's axis. Lines: FAM published with 12 arcs. Dots: the exact rod. Look at the "
          "gap between line and dots towards the tip: it widens with the torque.",
          "orange lines: FAM published, 12 arcs, bending first; black dots: exact, Kirchhoff");
  draw_shapes(svg, 80, data, 0, 1);
  draw_shapes(svg, 510, data, 1, 2);
  return svg.str();
}

}  // namespace

std::map<std::string, std::string> torsion_pictures(const TorsionData& data) {
  return {
      {"errors.svg", error_picture(data)}, {"orders.svg", order_picture(data)}, {"shapes.svg", shapes_picture(data)}};
}

}  // namespace studies
