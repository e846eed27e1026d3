#include "studies/report/path_chart.h"

#include "studies/report/chart.h"

#include <algorithm>
#include <array>

namespace studies {
namespace {

using scene::PathPoint;

constexpr double panel_size = 420, panel_left = 76, panel_top = 66, panel_gap = 110;
const std::array<std::string, 3> shape_colours{colour::blue, colour::green, colour::sky}, shape_names{"A", "B", "C"};

// How far the tip is from where it is at the path's first point.
Point point_of(const scene::Path& path, const PathPoint& p) {
  return {p.parameter, (p.tip_position_B_mm - path.points.front().tip_position_B_mm).norm()};
}

Axis axis_over(const std::string& label, const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double margin = 0.06 * std::max(*high - *low, 1e-12);
  return {label, *low - margin, *high + margin, false};
}

// From a point to the next: stable where both are, as a fold or a branch point is on the stable side.
bool is_stable_after(const scene::Path& path, std::size_t i) {
  return path.points[i].stable.value_or(true) && path.points[i + 1].stable.value_or(true);
}

// Runs that are alike.
void draw_curve(const scene::Path& path, Panel& panel) {
  const auto goes_on = [&](std::size_t i) {
    return i + 1 < path.points.size() && path.points[i + 1].branch == path.points[i].branch;
  };
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    while (goes_on(i)) {
      const bool stable = is_stable_after(path, i);
      std::vector<Point> run{point_of(path, path.points[i])};
      while (goes_on(i) && is_stable_after(path, i) == stable) run.push_back(point_of(path, path.points[++i]));
      panel.curve(run, {colour::black, 1.6, stable ? "" : "5 4"});
    }
  }
}

void mark_points(const scene::Path& path, Panel& panel) {
  for (const PathPoint& point : path.points) {
    const bool fold = point.kind == PathPoint::Kind::fold;
    if (!fold && point.kind != PathPoint::Kind::branch) continue;
    const std::string& of_kind = fold ? colour::orange : colour::purple;
    panel.dots({point_of(path, point)}, of_kind, 4);
    panel.name(point_of(path, point), scene::name(point.kind), of_kind);
  }
}

// Start, the first fold (or else the middle), and the end; of a path with branches the middle of the first of these.
std::array<std::size_t, 3> chosen_points(const scene::Path& path) {
  const auto first = [&](const auto& is) {
    return static_cast<std::size_t>(std::find_if(path.points.begin(), path.points.end(), is) - path.points.begin());
  };
  const std::size_t count = path.points.size();
  const std::size_t branch = first([](const PathPoint& p) { return p.branch == 1; });
  const std::size_t next_branch = first([](const PathPoint& p) { return p.branch > 1; });
  const std::size_t fold = first([](const PathPoint& p) { return p.kind == PathPoint::Kind::fold; });
  return {0, fold < count ? fold : branch / 2, branch < count ? (branch + next_branch) / 2 : count - 1};
}

// Along x and, of y and z, the one that the shapes reach farther along.
void draw_shapes(Svg& svg, const std::array<std::vector<Eigen::Vector3d>, 3>& shapes) {
  std::array<std::vector<double>, 3> along;  // by axis
  for (const auto& shape : shapes) {
    for (const Eigen::Vector3d& p : shape) {
      for (std::size_t axis = 0; axis < 3; ++axis) along[axis].push_back(p[static_cast<Eigen::Index>(axis)]);
    }
  }
  const auto width = [&](std::size_t axis) {
    const auto [low, high] = std::minmax_element(along[axis].begin(), along[axis].end());
    return *high - *low;
  };
  const std::size_t up = width(2) > width(1) ? 2 : 1;
  Axis x = axis_over("x, mm", along[0]), y = axis_over(up == 2 ? "z, mm" : "y, mm", along[up]);
  equal_scale(x, y, panel_size, panel_size);
  Panel panel(svg, {panel_left + panel_size + panel_gap, panel_top}, panel_size, panel_size, x, y);
  panel.frame();
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<Point> line;
    for (const Eigen::Vector3d& p : shapes[k]) line.push_back({p[0], p[static_cast<Eigen::Index>(up)]});
    panel.curve(line, {shape_colours[k], 1.8, ""});
    panel.name(line.back(), shape_names[k], shape_colours[k]);
  }
  panel.place_names();
}

std::string legend(const std::vector<PathMarks>& others) {
  std::string text = "full: stable, or not decided; dashed: unstable";
  for (const PathMarks& other : others) text += "; " + other.name;
  return text;
}

}  // namespace

std::string path_chart(const scene::Path& path, const CentrelineOf& centreline_mm, const std::string& title,
                       const std::string& parameter, const std::vector<PathMarks>& others) {
  Svg svg(panel_left + 2 * (panel_size + panel_gap) - 20, panel_top + panel_size + 60, title,
          "The rod's equilibria: the parameter against how far the tip has moved, and three shapes.", legend(others));
  std::vector<double> parameters, ways;
  for (const PathPoint& point : path.points) {
    parameters.push_back(point_of(path, point).x);
    ways.push_back(point_of(path, point).y);
  }
  Panel curve(svg, {panel_left, panel_top}, panel_size, panel_size, axis_over(parameter, parameters),
              axis_over("way of the tip, mm", ways));
  curve.frame();
  for (const PathMarks& other : others) {
    std::vector<Point> marks;
    for (const PathPoint& point : other.points) marks.push_back(point_of(path, point));
    curve.dots(marks, other.colour, other.radius);
  }
  draw_curve(path, curve);
  mark_points(path, curve);

  const std::array<std::size_t, 3> chosen = chosen_points(path);
  std::array<std::vector<Eigen::Vector3d>, 3> shapes;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point at = point_of(path, path.points[chosen[k]]);
    shapes[k] = centreline_mm(chosen[k]);
    curve.dots({at}, shape_colours[k], 4);
    curve.name(at, shape_names[k], shape_colours[k]);
  }
  curve.place_names();
  draw_shapes(svg, shapes);
  return svg.str();
}

}  // namespace studies
