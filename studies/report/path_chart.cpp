#include "studies/report/path_chart.h"

#include "scene/load_visitor.h"
#include "studies/report/chart.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

using scene::PathPoint;

struct Diagram {
  Eigen::Vector3d start_B_mm;
  double displacement_mm(const PathPoint& p) const { return (p.tip_position_B_mm - start_B_mm).norm(); }
  Point at(const PathPoint& p) const { return {p.parameter, displacement_mm(p)}; }
};

Stroke stroke_of(const PathPoint& point) {
  if (!point.stable) return {colour::grey, 1.8, ""};
  return *point.stable ? Stroke{colour::blue, 2.2, ""} : Stroke{colour::blue, 1.6, "5 4"};
}

// Pieces of one branch and one kind of stability, each up to the first point of the next.
void draw_path(Panel& panel, const Diagram& diagram, const scene::Path& path) {
  const std::vector<PathPoint>& points = path.points;
  for (std::size_t first = 0; first + 1 < points.size();) {
    std::size_t last = first + 1;
    const auto goes_on = [&](std::size_t i) { return points[i].branch == points[first].branch; };
    while (last + 1 < points.size() && goes_on(last) && points[last].stable == points[first + 1].stable) ++last;
    std::vector<Point> line;
    for (std::size_t i = first; i <= last && goes_on(i); ++i) line.push_back(diagram.at(points[i]));
    if (line.size() > 1) panel.curve(line, stroke_of(points[first + 1]));
    first = last;
  }
}

void mark(Panel& panel, const Diagram& diagram, const scene::Path& path) {
  for (const PathPoint& point : path.points) {
    const bool fold = point.kind == PathPoint::Kind::fold;
    if (!fold && point.kind != PathPoint::Kind::branch) continue;
    const std::string& shown = fold ? colour::orange : colour::purple;
    panel.dots({diagram.at(point)}, shown, 4.5);
    panel.name(diagram.at(point), fmt::format("{} {:.6g}", fold ? "fold" : "branch point", point.parameter), shown);
  }
}

Axis range(const std::string& label, double low, double high) {
  const double margin = 0.05 * std::max(high - low, 1e-12);
  return {label, low - margin, high + margin, false};
}

View widest_view(const std::vector<Centreline>& shapes) {
  Eigen::Array3d reach = Eigen::Array3d::Zero();
  for (const Centreline& shape : shapes) {
    for (const Eigen::Vector3d& p : shape.positions_B_mm) reach = reach.max(p.array().abs());
  }
  return {0, reach[2] > reach[1] ? 2 : 1};
}

}  // namespace

std::string parameter_label(const scene::PathRequest& request) {
  switch (request.parameter) {
    case scene::PathParameter::load_factor: return "load factor";
    case scene::PathParameter::turn_rad: return "turn, rad";
    case scene::PathParameter::rest_curvature_factor: return "rest curvature factor";
    case scene::PathParameter::value: break;
  }
  const scene::Load& load = request.scene.loads[request.loads.front()];
  const char* unit = scene::visit_load(
      load, [](const scene::Force&) { return "N"; }, [](const scene::Moment&) { return "N mm"; },
      [](const scene::DistributedForce&) { return "N/mm"; }, [](const scene::Gravity&) { return "m/s²"; },
      [](const scene::Tendon&) { return "N"; });
  if (scene::tendon_of(load)) return fmt::format("tension, {}", unit);
  return fmt::format("{} {}, {}", scene::kind_name(load), "xyz"[request.component], unit);
}

std::string path_chart(const scene::PathRequest& request, const scene::Path& path,
                       const std::vector<Centreline>& shapes, const std::vector<PathDots>& others) {
  constexpr double left = 70, top = 66, width = 520, size = 420, gap = 80;
  Svg svg(left + width + gap + size + 40, top + size + 60, request.scene.title,
          "An equilibrium path: the parameter against the tip's displacement, and shapes on the way.",
          "stable full, unstable dashed, without an energy grey");
  const Diagram diagram{path.points.front().tip_position_B_mm};
  double low = request.from, high = request.from, most_mm = 0;
  for (const PathPoint& p : path.points) {
    low = std::min(low, p.parameter);
    high = std::max(high, p.parameter);
    most_mm = std::max(most_mm, diagram.displacement_mm(p));
  }
  Panel panel(svg, {left, top}, width, size, range(parameter_label(request), low, high),
              range("tip displacement from the start, mm", 0, most_mm));
  panel.frame();
  draw_path(panel, diagram, path);
  for (const PathDots& other : others) {
    std::vector<Point> dots;
    for (const PathPoint& p : other.points) dots.push_back(diagram.at(p));
    panel.dots(dots, other.colour, 2.4);
    if (!dots.empty()) panel.name(dots[dots.size() / 2], other.name, other.colour);
  }
  mark(panel, diagram, path);
  panel.place_names();
  draw_shapes(svg, {left + width + gap, top}, size, shapes, widest_view(shapes));
  return svg.str();
}

}  // namespace studies
