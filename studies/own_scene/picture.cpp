#include "studies/own_scene/comparison.h"
#include "studies/report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Between panels there is room for the names of curves that reach the right edge.
constexpr double panel_size = 340, panel_left = 76, panel_top = 84, panel_across = 560, panel_down = 450;

struct DrawnCurve {
  std::string name;
  Stroke stroke;
  bool dotted;
  std::vector<Eigen::Vector3d> positions_mm;
  std::vector<Distance> distances;
};

// The most accurate first and widest, so that all show where they lie on each other.
std::vector<DrawnCurve> curves_of(const Comparison& comparison) {
  std::vector<DrawnCurve> curves;
  const auto add = [&](const ComparedMethod& method) {
    DrawnCurve curve{method.name, {method.style.colour, 1.6, method.style.dash}, false, {}, method.distances};
    for (const scene::Station& station : method.result.stations)
      curve.positions_mm.push_back(station.X_BS.position_B_mm);
    curves.push_back(std::move(curve));
  };
  const ComparedMethod* truth = comparison.truth();
  if (!truth) return curves;
  add(*truth);
  for (const ComparedMethod& method : comparison.methods) {
    if (&method != truth && method.result.converged()) add(method);
  }
  for (std::size_t i = 0; i < curves.size(); ++i)
    curves[i].stroke.width = 1.4 + 1.4 * static_cast<double>(curves.size() - 1 - i);
  if (const auto& file = comparison.file) {
    curves.push_back({"file", {colour::sky, 1.4, ""}, true, {}, file->distances});
    for (const CentrelinePoint& point : file->points) curves.back().positions_mm.push_back(point.position_B_mm);
  }
  return curves;
}

Axis axis_of(const std::vector<DrawnCurve>& curves, int component) {
  Axis axis{std::string(1, "xyz"[component]) + ", mm", 0, 0, false};
  for (const DrawnCurve& curve : curves) {
    for (const auto& p : curve.positions_mm) {
      axis.low = std::min(axis.low, p[component]);
      axis.high = std::max(axis.high, p[component]);
    }
  }
  const double margin = 0.06 * std::max(axis.high - axis.low, 1e-12);
  axis.low -= margin;
  axis.high += margin;
  return axis;
}

// Axes to look at over x: y, z or both; y where the rod stays straight.
std::vector<int> views_of(const std::vector<DrawnCurve>& curves, double length_mm) {
  std::vector<int> views;
  for (const int up : {1, 2}) {
    const bool leaves = std::any_of(curves.begin(), curves.end(), [&](const DrawnCurve& curve) {
      return std::any_of(curve.positions_mm.begin(), curve.positions_mm.end(),
                         [&](const Eigen::Vector3d& p) { return std::abs(p[up]) > 1e-6 * length_mm; });
    });
    if (leaves) views.push_back(up);
  }
  return views.empty() ? std::vector<int>{1} : views;
}

void draw_shapes(Svg& svg, Point corner, const std::vector<DrawnCurve>& curves, int up) {
  Axis x = axis_of(curves, 0), y = axis_of(curves, up);
  equal_scale(x, y, panel_size, panel_size);
  Panel panel(svg, corner, panel_size, panel_size, x, y);
  panel.frame();
  for (const DrawnCurve& curve : curves) {
    std::vector<Point> points;
    for (const auto& p : curve.positions_mm) points.push_back({p[0], p[up]});
    if (curve.dotted) panel.dots(points, curve.stroke.colour, 2);
    else panel.curve(points, curve.stroke);
    panel.name(points.back(), curve.name, curve.stroke.colour);
  }
  panel.place_names();
}

// Decades that hold the curves' largest distances, three below the smallest of these, and the gate.
Axis distance_axis(const std::vector<DrawnCurve>& curves, const std::string& truth, double length_mm, double gate_mm) {
  const double floor_mm = 1e-12 * length_mm;
  double low = INFINITY, high = floor_mm;
  const auto hold = [&](double mm) {
    low = std::min(low, std::max(mm, floor_mm));
    high = std::max(high, mm);
  };
  if (gate_mm > 0) hold(gate_mm);
  for (const DrawnCurve& curve : curves) {
    if (!curve.distances.empty()) hold(farthest(curve.distances).mm);
  }
  const double bottom = std::max(std::pow(10, std::floor(std::log10(low)) - 2), floor_mm);
  return {"distance from " + truth + ", mm", bottom, 2 * std::pow(10, std::ceil(std::log10(high))), true};
}

void draw_distances(Svg& svg, Point corner, const std::vector<DrawnCurve>& curves, const Comparison& comparison,
                    double gate_mm) {
  const double length_mm = scene::length_mm(comparison.scene);
  const Axis y = distance_axis(curves, comparison.truth()->name, length_mm, gate_mm);
  Panel panel(svg, corner, panel_size, panel_size, {"s, mm", 0, length_mm, false}, y);
  panel.frame();
  if (gate_mm > 0) {
    panel.curve({{0, gate_mm}, {length_mm, gate_mm}}, {colour::grey, 1.2, "6 4"});
    panel.name({length_mm, gate_mm}, fmt::format("gate, {:g} mm", gate_mm), colour::grey);
  }
  for (const DrawnCurve& curve : curves) {
    std::vector<Point> points;
    for (const Distance& d : curve.distances) {
      if (d.s_mm > 0) points.push_back({d.s_mm, std::max(d.mm, y.low)});
    }
    if (points.empty()) continue;
    if (curve.dotted) panel.dots(points, curve.stroke.colour, 2);
    else panel.curve(points, {curve.stroke.colour, 1.6, curve.stroke.dash});
    panel.name(points.back(), curve.name, curve.stroke.colour);
  }
  panel.place_names();
}

}  // namespace

std::string comparison_picture(const std::vector<Comparison>& comparisons, double gate_mm) {
  std::vector<std::vector<DrawnCurve>> curves;
  std::size_t most_views = 1;
  for (const Comparison& comparison : comparisons) {
    curves.push_back(curves_of(comparison));
    most_views = std::max(most_views, views_of(curves.back(), scene::length_mm(comparison.scene)).size());
  }
  Svg svg(
      panel_left + static_cast<double>(most_views + 1) * panel_across - 140,
      panel_top + panel_down * static_cast<double>(comparisons.size()) - 20, "Methods beside each other",
      "For each scene the centrelines by all methods in the base frame, clamp at the origin, and how far each lies "
      "from the most accurate one along the rod, on a logarithmic axis.",
      "left: centrelines, clamp at the origin, wider lines below narrower ones; right: distance at equal arc length");
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const Comparison& comparison = comparisons[i];
    Point corner{panel_left, panel_top + panel_down * static_cast<double>(i)};
    svg.text({corner.x, corner.y - 12}, comparison.scene.title.empty() ? comparison.source : comparison.scene.title,
             Anchor::start, 13);
    if (!comparison.truth()) {
      svg.text({corner.x, corner.y + 20}, "no method solved it", Anchor::start, 12, colour::grey);
      continue;
    }
    for (const int up : views_of(curves[i], scene::length_mm(comparison.scene))) {
      draw_shapes(svg, corner, curves[i], up);
      corner.x += panel_across;
    }
    draw_distances(svg, corner, curves[i], comparison, gate_mm);
  }
  return svg.str();
}

}  // namespace studies
