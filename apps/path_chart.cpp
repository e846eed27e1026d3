#include "apps/path_chart.h"

#include "studies/report/chart.h"

#include <algorithm>
#include <array>

namespace apps {
namespace {

using scene::PathPoint;
using studies::Point;
namespace colour = studies::colour;

constexpr double size = 420, left = 76, top = 66, gap = 110;

// How far the tip is from where it is at the path's first point.
Point point_of(const scene::Path& path, std::size_t i) {
  const PathPoint& p = path.points[i];
  return {p.parameter, (p.tip_position_B_mm - path.points.front().tip_position_B_mm).norm()};
}

studies::Axis axis_over(const std::string& label, const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double margin = 0.06 * std::max(*high - *low, 1e-12);
  return {label, *low - margin, *high + margin, false};
}

// From a point to the next: stable where both are, as a fold or a branch point is on the stable side.
bool is_stable_after(const scene::Path& path, std::size_t i) {
  return path.points[i].stable.value_or(true) && path.points[i + 1].stable.value_or(true);
}

// Runs that are alike.
void draw_curve(const scene::Path& path, studies::Panel& panel) {
  const auto goes_on = [&](std::size_t i) {
    return i + 1 < path.points.size() && path.points[i + 1].branch == path.points[i].branch;
  };
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    while (goes_on(i)) {
      const bool stable = is_stable_after(path, i);
      std::vector<Point> run{point_of(path, i)};
      while (goes_on(i) && is_stable_after(path, i) == stable) run.push_back(point_of(path, ++i));
      panel.curve(run, {colour::black, 1.6, stable ? "" : "5 4"});
    }
  }
}

void mark_points(const scene::Path& path, studies::Panel& panel) {
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint::Kind kind = path.points[i].kind;
    if (kind != PathPoint::Kind::fold && kind != PathPoint::Kind::branch) continue;
    panel.dots({point_of(path, i)}, kind == PathPoint::Kind::fold ? colour::orange : colour::purple, 4);
    panel.name(point_of(path, i), scene::name(kind), kind == PathPoint::Kind::fold ? colour::orange : colour::purple);
  }
}

// Start, end, and the first fold between them, or else the middle.
std::array<std::size_t, 3> chosen_points(const scene::Path& path) {
  const auto fold = std::find_if(path.points.begin(), path.points.end(),
                                 [](const PathPoint& p) { return p.kind == PathPoint::Kind::fold; });
  const std::size_t last = path.points.size() - 1;
  const auto middle = fold == path.points.end() ? last / 2 : static_cast<std::size_t>(fold - path.points.begin());
  return {0, middle, last};
}

}  // namespace

std::string path_chart(const fam::Path& path, const std::string& title, const std::string& parameter) {
  const scene::Path& points = path.points();
  studies::Svg svg(left + 2 * (size + gap) - 20, top + size + 60, title,
                   "The rod's equilibria: the parameter against how far the tip has moved, and three shapes.",
                   "full: stable, or not decided; dashed: unstable");
  std::vector<double> parameters, ways;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    parameters.push_back(point_of(points, i).x);
    ways.push_back(point_of(points, i).y);
  }
  studies::Panel curve(svg, {left, top}, size, size, axis_over(parameter, parameters),
                       axis_over("way of the tip, mm", ways));
  curve.frame();
  draw_curve(points, curve);
  mark_points(points, curve);

  const std::array<std::string, 3> colours{colour::blue, colour::green, colour::sky}, names{"A", "B", "C"};
  const std::array<std::size_t, 3> chosen = chosen_points(points);
  std::array<std::vector<Eigen::Vector3d>, 3> shapes;
  std::array<std::vector<double>, 3> along;  // by axis
  for (std::size_t k = 0; k < 3; ++k) {
    shapes[k] = path.centreline_mm(chosen[k]);
    for (const Eigen::Vector3d& p : shapes[k]) {
      for (std::size_t axis = 0; axis < 3; ++axis) along[axis].push_back(p[static_cast<Eigen::Index>(axis)]);
    }
    curve.dots({point_of(points, chosen[k])}, colours[k], 4);
    curve.name(point_of(points, chosen[k]), names[k], colours[k]);
  }
  curve.place_names();
  const auto width = [&](std::size_t axis) {
    const auto [low, high] = std::minmax_element(along[axis].begin(), along[axis].end());
    return *high - *low;
  };
  const std::size_t up = width(2) > width(1) ? 2 : 1;
  studies::Axis x = axis_over("x, mm", along[0]), y = axis_over(up == 2 ? "z, mm" : "y, mm", along[up]);
  studies::equal_scale(x, y, size, size);
  studies::Panel shape(svg, {left + size + gap, top}, size, size, x, y);
  shape.frame();
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<Point> line;
    for (const Eigen::Vector3d& p : shapes[k]) line.push_back({p[0], p[static_cast<Eigen::Index>(up)]});
    shape.curve(line, {colours[k], 1.8, ""});
    shape.name(line.back(), names[k], colours[k]);
  }
  shape.place_names();
  return svg.str();
}

}  // namespace apps
