#include "apps/shape_chart.h"

#include "studies/report/chart.h"

#include <algorithm>

namespace apps {
namespace {

using studies::Axis, studies::Panel, studies::Point, studies::Svg;

Axis axis_over(const std::vector<Centreline>& lines, int component) {
  const char* labels[] = {"x, mm", "y, mm", "z, mm"};
  Axis axis{labels[component], 0, 0, false};
  for (const Centreline& line : lines) {
    for (const auto& p : line.positions_B_mm) {
      axis.low = std::min(axis.low, p[component]);
      axis.high = std::max(axis.high, p[component]);
    }
  }
  const double margin = 0.06 * std::max(axis.high - axis.low, 1e-12);
  axis.low -= margin;
  axis.high += margin;
  return axis;
}

}  // namespace

Centreline centreline(const scene::Equilibrium& result, const std::string& name, const std::string& colour) {
  Centreline line{name, {}, colour, "", false};
  for (const scene::Station& station : result.stations) line.positions_B_mm.push_back(station.X_BS.position_B_mm);
  return line;
}

std::string shape_chart(const std::vector<Centreline>& lines, const std::vector<View>& views, const std::string& title,
                        const std::string& subtitle) {
  const double size = views.size() == 1 ? 520 : 360;
  constexpr double left = 70, top = 66, gap = 110;
  Svg svg(left + static_cast<double>(views.size()) * (size + gap) - 20, top + size + 60, title,
          "Deformed centrelines in the base frame, clamp at the origin.", subtitle);
  for (std::size_t v = 0; v < views.size(); ++v) {
    Axis x = axis_over(lines, views[v].right);
    Axis y = axis_over(lines, views[v].up);
    studies::equal_scale(x, y, size, size);
    Panel panel(svg, {left + static_cast<double>(v) * (size + gap), top}, size, size, x, y);
    panel.frame();
    for (const Centreline& line : lines) {
      std::vector<Point> points;
      for (const auto& p : line.positions_B_mm) points.push_back({p[views[v].right], p[views[v].up]});
      if (points.empty()) continue;
      if (line.dotted) panel.dots(points, line.colour, 2.2);
      else panel.curve(points, {line.colour, 1.8, line.dash});
      if (!line.name.empty()) panel.name(points.back(), line.name, line.colour);
    }
    panel.place_names();
  }
  return svg.str();
}

}  // namespace apps
