#include "studies/sweep/workspace.h"

#include "studies/report/chart.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

constexpr double panel_px = 340, left_px = 76, top_px = 70, across_px = 450;

struct View {
  int right, up;
};

Axis axis_of(const std::vector<Eigen::Vector3d>& tips, int component, double length_mm) {
  Axis axis{std::string("tip ") + "xyz"[component] + ", mm", 0, 0, false};
  axis.low = axis.high = tips.empty() ? 0 : tips.front()[component];
  for (const Eigen::Vector3d& tip : tips) {
    axis.low = std::min(axis.low, tip[component]);
    axis.high = std::max(axis.high, tip[component]);
  }
  const double margin = std::max(0.05 * (axis.high - axis.low), 0.01 * length_mm);
  return {axis.label, axis.low - margin, axis.high + margin, false};
}

bool spreads(const std::vector<Eigen::Vector3d>& tips, int component, double length_mm) {
  return std::any_of(tips.begin(), tips.end(), [&](const Eigen::Vector3d& tip) {
    return std::abs(tip[component] - tips.front()[component]) > 1e-6 * length_mm;
  });
}

std::vector<View> views_of(const std::vector<Eigen::Vector3d>& tips, double length_mm) {
  const bool y = spreads(tips, 1, length_mm), z = spreads(tips, 2, length_mm);
  if (y && z) return {{0, 1}, {0, 2}, {1, 2}};
  return {{0, z ? 2 : 1}};
}

}  // namespace

std::string workspace_svg(const std::vector<Eigen::Vector3d>& tips_B_mm, double length_mm, std::uint64_t all) {
  const std::size_t every = (tips_B_mm.size() + most_dots - 1) / most_dots;
  std::vector<Eigen::Vector3d> drawn;
  for (std::size_t i = 0; i < tips_B_mm.size(); i += std::max<std::size_t>(every, 1)) drawn.push_back(tips_B_mm[i]);
  const std::vector<View> views = views_of(drawn, length_mm);
  std::string words = fmt::format("{} points, {} with an answer", all, tips_B_mm.size());
  if (every > 1) words += fmt::format("; one of {} is drawn", every);
  Svg svg(left_px + across_px * static_cast<double>(views.size()), top_px + panel_px + 70, "Where the tip can be",
          "The tips of all points of a sweep that have an answer, in the base frame, a dot each.", words);
  for (std::size_t k = 0; k < views.size(); ++k) {
    Axis x = axis_of(drawn, views[k].right, length_mm), y = axis_of(drawn, views[k].up, length_mm);
    equal_scale(x, y, panel_px, panel_px);
    Panel panel(svg, {left_px + across_px * static_cast<double>(k), top_px}, panel_px, panel_px, x, y);
    panel.frame();
    std::vector<Point> points;
    for (const Eigen::Vector3d& tip : drawn) points.push_back({tip[views[k].right], tip[views[k].up]});
    panel.dots(points, colour::blue, drawn.size() > 500 ? 1.2 : 2.5);
  }
  return svg.str();
}

}  // namespace studies
