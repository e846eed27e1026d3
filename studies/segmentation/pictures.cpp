#include "studies/report/chart.h"
#include "studies/report/table.h"
#include "studies/segmentation/data.h"
#include "studies/segmentation/printed_trend.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// One digit where round-off begins to show, so that the picture does not follow it.
double drawn(double error_mm) {
  if (error_mm > 1e-8) return error_mm;
  const double power = std::pow(10, std::floor(std::log10(std::max(error_mm, error_floor_mm))));
  return std::round(std::max(error_mm, error_floor_mm) / power) * power;
}

Stroke stroke_of(const SweepLaw& law) {
  return {law.row.style.colour, 1.8, law.shears() ? "5 3" : law.row.style.dash};
}

void draw_curve(Panel& panel, const SweepLaw& law, const std::vector<Point>& points, double named_at) {
  panel.curve(points, stroke_of(law));
  panel.dots(points, law.row.style.colour, 2.5);
  const auto at = std::find_if(points.begin(), points.end(), [&](const Point& p) { return p.x >= named_at; });
  panel.name(at == points.end() ? points.back() : *at, law.label(), law.row.style.colour);
}

void draw_errors(Panel& panel, const SegmentationData& data, const std::vector<std::string>& laws,
                 double SweepPoint::*error) {
  for (const std::string& law : laws) {
    std::vector<Point> points;
    for (const SweepPoint& p : data.curve("P4", law)) {
      points.push_back({static_cast<double>(p.arcs), drawn(p.*error)});
    }
    const double named_at = law == "sixth_order" ? 12 : law == "fourth_order" ? 50 : law == "midpoint" ? 500 : 5000;
    draw_curve(panel, sweep_law(law), points, error == &SweepPoint::exact_mm ? named_at : 1e6);
  }
  panel.place_names();
}

std::string error_picture(const SegmentationData& data) {
  const SweepReference& reference = data.reference("P4");
  Svg svg(880, 900, "Tip error over the number of arcs, case P4 (our loads)",
          "Two charts of the tip error in mm over the number of arcs from 1 to a million, both logarithmic. Above, "
          "against the exact rod: FAM published and midpoint fall in straight lines, fourth and sixth order fall "
          "steeper until round-off. Below, against finite elements: FAM published levels out where "
          "shear, which it leaves out, is all that is left; arcs with shear fall on to the finite elements' own error. "
          "A black dashed line in both shows what the paper prints: least at 12, under 3 mm to 500, rising beyond.",
          "black, dashed: what the paper prints in words for its own loads");
  const Axis arcs{"number of arcs N", 1, 1e6, true};
  Panel exact(svg, {80, 86}, 620, 330, arcs, {"tip error, mm", 1e-11, 100, true});
  exact.band(1e-11, error_floor_mm, "");
  exact.frame("Against the exact Kirchhoff rod");
  svg.text(exact.at({1.2, 1.5e-11}), "shaded: below 1e-12 L, not resolved", Anchor::start, 12, colour::grey);
  draw_printed_trend(svg, exact);
  draw_errors(exact, data, {"published", "midpoint", "fourth_order", "sixth_order"}, &SweepPoint::exact_mm);
  Panel fe(svg, {80, 510}, 620, 330, arcs, {"tip error, mm", 1e-8, 100, true});
  fe.band(1e-8, reference.fe_estimate_mm, "");
  fe.frame("Against 50 quadratic finite elements, with shear and stretch");
  svg.text(fe.at({1.2, 1.7e-8}), "shaded: the finite elements' own error, as they estimate it", Anchor::start, 12,
           colour::grey);
  draw_printed_trend(svg, fe);
  draw_errors(fe, data, {"published", "fourth_order_reissner"}, &SweepPoint::fe_mm);
  return svg.str();
}

// The points of a shape that lie in a window.
std::vector<Point> inside(const SweepShape& shape, const Axis& x, const Axis& y) {
  std::vector<Point> points;
  for (const Eigen::Vector3d& p : shape.positions_mm) {
    if (p[0] >= x.low && p[0] <= x.high && p[1] >= y.low && p[1] <= y.high) points.push_back({p[0], p[1]});
  }
  return points;
}

struct Window {
  Axis x, y;
};

// Both axes to the same scale: all shapes, or a square round the exact tip.
Window whole_window(const SegmentationData& data, double pixels) {
  Window window{{"x, mm", 0, 0}, {"y, mm", 0, 0}};
  for (const SweepShape& shape : data.shapes) {
    for (const Eigen::Vector3d& p : shape.positions_mm) {
      window.x.low = std::min(window.x.low, p[0] - 2), window.x.high = std::max(window.x.high, p[0] + 2);
      window.y.low = std::min(window.y.low, p[1] - 2), window.y.high = std::max(window.y.high, p[1] + 2);
    }
  }
  equal_scale(window.x, window.y, pixels, pixels);
  return window;
}

Window tip_window(const SegmentationData& data) {
  const Eigen::Vector3d tip = data.shapes.back().positions_mm.back();
  return {{"x, mm", tip[0] - 1.6, tip[0] + 1.6}, {"y, mm", tip[1] - 2.2, tip[1] + 1}};
}

void draw_shapes(Svg& svg, double left, const std::string& title, const SegmentationData& data, const Window& window,
                 const std::vector<std::string>& named) {
  Panel panel(svg, {left, 86}, 330, 330, window.x, window.y);
  panel.frame(title);
  const std::map<std::string, std::string> dashes = {
      {"1 arc", "1 3"}, {"2 arcs", "2 3"}, {"3 arcs", "5 3"}, {"12 arcs", ""}, {"500 arcs", ""}};
  const std::string published = method_row("fam_published").style.colour;
  for (const SweepShape& shape : data.shapes) {
    const std::vector<Point> points = inside(shape, window.x, window.y);
    if (points.empty()) continue;
    if (shape.name == "exact") {
      panel.dots(points, method_row("exact").style.colour, 2.5);
      continue;
    }
    panel.curve(points, {published, 1.6, dashes.at(shape.name)});
    if (std::find(named.begin(), named.end(), shape.name) != named.end()) {
      panel.name(points.back(), shape.name, published);
    }
  }
  panel.place_names();
}

std::string shapes_picture(const SegmentationData& data) {
  Svg svg(
      880, 480, "P4 (our loads) with 1, 2, 3, 12 and 500 arcs",
      "The bent rod in the x-y plane, whole on the left, its tip enlarged on the right. Orange lines: FAM published "
      "with 1 arc (dotted), 2 and 3 (dashed), 12 and 500 (full). Black dots: the exact rod. One arc is a circle "
      "far from it; from 3 arcs on the curves can be told apart only in the enlarged view.",
      "orange: FAM published, the finer the more arcs; black dots: exact, Kirchhoff");
  draw_shapes(svg, 80, "", data, whole_window(data, 330), {"1 arc", "2 arcs"});
  draw_shapes(svg, 510, "near the tip", data, tip_window(data), {"2 arcs", "3 arcs", "12 arcs"});
  return svg.str();
}

std::string budget_picture(const SegmentationData& data) {
  Svg svg(880, 860, "How much load N arcs carry with a tip error under 0.1 mm",
          "Two charts of the largest dimensionless load, force times length squared over EI, over the number of arcs "
          "from 1 to 500, both logarithmic: above P4 with force and moment scaled together, below a transverse force "
          "alone. All curves rise from below 3 to the limit of the search at 100; fourth and sixth order rise well "
          "before published and midpoint.",
          "load: |F| L²/EI, searched up to 100; a rod with 1 bends visibly");
  double top = 86;
  for (const std::string load : {"P4 scaled", "transverse force"}) {
    Panel panel(svg, {80, top}, 620, 310, {"number of arcs N", 1, 200, true}, {"largest |F| L²/EI", 0.01, 200, true});
    panel.frame(load == "P4 scaled" ? "P4, force and moment scaled together" : "A transverse follower force alone");
    for (const SweepLaw& law : kirchhoff_laws()) {
      std::vector<Point> points;
      for (const Budget& b : data.budgets) {
        if (b.load == load && b.law == law.key && b.limit_mm == 0.1 && (points.empty() || points.back().y < 100)) {
          points.push_back({static_cast<double>(b.arcs), b.largest_load});
        }
      }
      const bool at_few = law.key == "sixth_order" || law.key == "published";
      draw_curve(panel, law, points, at_few ? 2 : law.key == "midpoint" ? 8 : 20);
    }
    panel.place_names();
    top += 400;
  }
  return svg.str();
}

}  // namespace

std::map<std::string, std::string> segmentation_pictures(const SegmentationData& data) {
  return {
      {"errors.svg", error_picture(data)}, {"shapes.svg", shapes_picture(data)}, {"budget.svg", budget_picture(data)}};
}

}  // namespace studies
