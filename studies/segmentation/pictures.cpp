#include "studies/report/chart.h"
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

struct Series {
  const char *law, *name;
  std::string colour;
};
const std::vector<Series> series = {{"published", "published", colour::blue},
                                    {"midpoint", "midpoint", colour::green},
                                    {"fourth_order", "fourth_order", colour::orange},
                                    {"sixth_order", "sixth_order", colour::black},
                                    {"fourth_order_reissner", "fourth_order with shear", colour::purple}};

void draw_errors(Panel& panel, const SegmentationData& data, double SweepPoint::*error) {
  for (const Series& s : series) {
    const bool against_exact = error == &SweepPoint::exact_mm;
    if (against_exact && std::string(s.law) == "fourth_order_reissner") continue;
    if (!against_exact && (std::string(s.law) == "midpoint" || std::string(s.law) == "sixth_order")) continue;
    std::vector<Point> points;
    for (const SweepPoint& p : data.curve("P4", s.law)) {
      points.push_back({static_cast<double>(p.arcs), drawn(p.*error)});
    }
    panel.curve(points, {s.colour, 1.6, ""});
    panel.dots(points, s.colour, 2.5);
    panel.name({1e6, std::max(points.back().y, against_exact ? 1e-9 : 0)}, s.name, s.colour);
  }
  panel.place_names();
}

std::string error_picture(const SegmentationData& data) {
  const SweepReference& reference = data.reference("P4");
  Svg svg(1260, 520, "Case P4 (our loads): tip error over the number of arcs",
          "Case P4 (our loads): tip error over the number of arcs");
  const Axis arcs{"number of arcs N", 1, 1e6, true};
  Panel exact(svg, {80, 66}, 430, 390, arcs, {"tip error, mm", 1e-11, 100, true});
  exact.band(1e-11, error_floor_mm, "");
  exact.frame("Against the exact Kirchhoff rod (elastica)");
  svg.text(exact.at({1.3, 1.6e-11}), "shaded: below 1e-12 L, not resolved", Anchor::start, 11, colour::grey);
  draw_errors(exact, data, &SweepPoint::exact_mm);
  draw_printed_trend(svg, exact);
  Panel fe(svg, {680, 66}, 390, 390, arcs, {"tip error, mm", 1e-8, 100, true});
  fe.band(1e-8, reference.fe_estimate_mm, "");
  fe.frame("Against 50 quadratic finite elements, with shear and stretch");
  svg.text(fe.at({1.3, 2e-8}), "shaded: the finite elements' own error", Anchor::start, 11, colour::grey);
  draw_errors(fe, data, &SweepPoint::fe_mm);
  draw_printed_trend(svg, fe);
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

std::string shapes_picture(const SegmentationData& data) {
  const std::vector<std::string> colours = {colour::orange, colour::green, colour::purple, colour::blue, colour::sky};
  Svg svg(1060, 520, "Case P4 (our loads), published law; dots: exact Kirchhoff rod",
          "Case P4 (our loads), published law; dots: exact Kirchhoff rod");
  const Axis x{"x, mm", -2, 30}, y{"y, mm", -1, 31}, near_x{"x, mm", 14.4, 17.4}, near_y{"y, mm", 26.3, 29.3};
  Panel whole(svg, {80, 66}, 390, 390, x, y), tip(svg, {600, 66}, 390, 390, near_x, near_y);
  whole.frame();
  tip.frame("The same, near the tip");
  for (std::size_t i = 0; i < data.shapes.size(); ++i) {
    const SweepShape& shape = data.shapes[i];
    const std::vector<Point> all = inside(shape, x, y), near = inside(shape, near_x, near_y);
    if (shape.name == "exact") {
      whole.dots(all, colour::black, 2.2);
      tip.dots(near, colour::black, 4);
      continue;
    }
    const Stroke stroke{colours[i], 1.8, shape.name == "500 arcs" ? "6 5" : ""};
    whole.curve(all, stroke);
    if (near.empty()) {
      whole.name(all.back(), shape.name, colours[i]);
      continue;
    }
    tip.curve(near, stroke);
    const double shift = shape.name == "500 arcs" ? -8 : shape.name == "12 arcs" ? 8 : 4;
    const Point end = tip.at(near.back());
    svg.text({end.x - 8, end.y + shift}, shape.name, Anchor::end, 12, colours[i]);
  }
  whole.place_names();
  return svg.str();
}

std::string budget_picture(const SegmentationData& data) {
  Svg svg(1180, 450, "How much load N arcs carry: largest |F| L²/EI with a tip error under 0.1 mm",
          "How much load N arcs carry: largest |F| L²/EI with a tip error under 0.1 mm");
  double left = 80;
  for (const std::string load : {"P4 scaled", "transverse force"}) {
    Panel panel(svg, {left, 66}, 390, 320, {"number of arcs N", 1, 500, true}, {"largest |F| L²/EI", 0.01, 100, true});
    panel.frame(load == "P4 scaled" ? "P4, force and moment scaled" : "transverse follower force alone");
    for (const Series& s : series) {
      std::vector<Point> points;
      for (const Budget& b : data.budgets) {
        if (b.load == load && b.law == s.law && b.limit_mm == 0.1) {
          points.push_back({static_cast<double>(b.arcs), b.largest_load});
        }
      }
      if (points.empty()) continue;
      panel.curve(points, {s.colour, 1.6, ""});
      panel.dots(points, s.colour, 2.5);
      panel.name(points.back(), s.name, s.colour);
    }
    panel.place_names();
    left += 570;
  }
  return svg.str();
}

}  // namespace

std::map<std::string, std::string> segmentation_pictures(const SegmentationData& data) {
  return {
      {"errors.svg", error_picture(data)}, {"shapes.svg", shapes_picture(data)}, {"budget.svg", budget_picture(data)}};
}

}  // namespace studies
