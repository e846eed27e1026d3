#include "studies/report/chart.h"

#include "studies/report/table.h"
#include "studies/work_precision/competitors.h"
#include "studies/work_precision/data.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace studies {
namespace {

const Axis error_axis{"tip error / L", 3e-11, 0.3, true};
const Axis time_axis{"", 0.05, 2e6, true};
const std::vector<double> decades = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};

// Accuracy to time, as far as half of the scenes get there.
std::vector<Point> curve_of(const WorkData& data, WorkGroup group, const Contestant& contestant) {
  std::vector<Point> points;
  for (const double target : decades) {
    const double time = times_to_us(data, group, contestant, target).median;
    if (std::isfinite(time)) points.push_back({target, time});
  }
  return points;
}

const std::vector<std::string>& methods_of(WorkGroup group) {
  static const std::vector<std::string> followers = {"fam_sixth_order", "fam", "fam_published", "rk4", "exact", "fe"};
  static const std::vector<std::string> others = {"fam_sixth_order", "fam", "rk4", "exact", "fe"};
  return group == WorkGroup::follower ? followers : others;
}

std::string title_of(const WorkData& data, WorkGroup group) {
  return fmt::format("{}, {} scenes: median time of a solve, µs", title(group), data.names(group).size());
}

void draw_panel(Svg& svg, Point corner, const WorkData& data, WorkGroup group) {
  Panel panel(svg, corner, 780, 350, error_axis, time_axis);
  panel.frame(title_of(data, group));
  for (const std::string& method : methods_of(group)) {
    const Contestant& c = contestant(method);
    const std::vector<Point> points = curve_of(data, group, c);
    if (points.empty()) continue;
    const Style& style = method_row(method).style;
    panel.curve(points, {style.colour, 1.8, style.dash});
    panel.dots(points, style.colour, 2.6);
    // With fixed loads the automatic choice runs along its kernel where it is accurate.
    panel.name(method == "fam" && group != WorkGroup::follower ? points.front() : points.back(),
               c.name() + (c.model == "Kirchhoff" ? ", without shear" : ""), style.colour);
  }
  panel.place_names();
}

// The curves in words.
std::string told(const WorkData& data, WorkGroup group) {
  std::string text = " " + title_of(data, group) + ":";
  for (const std::string& method : methods_of(group)) {
    const std::vector<Point> points = curve_of(data, group, contestant(method));
    if (points.empty()) continue;
    text += fmt::format(" {}: {} at {}, {} at {};", method_row(method).name, time_text(points.front().y),
                        target_text(points.front().x), time_text(points.back().y), target_text(points.back().x));
  }
  text.back() = '.';
  return text;
}

}  // namespace

std::string work_precision_picture(const WorkData& data) {
  std::string text =
      "Three panels, follower loads, fixed loads, robots: tip error over the rod's length along, finer to the left; "
      "median time of a solve upwards; both logarithmic. Lower is faster.";
  for (const WorkGroup group : work_groups) text += told(data, group);
  Svg svg(890, 1336, "Time that a tip error takes, a curve a method", text,
          "Cheapest resolution within the error; FAM automatic (fam solve) is asked for it. A curve ends where half of "
          "the scenes fail.");
  double top = 84;
  for (const WorkGroup group : work_groups) draw_panel(svg, {74, std::exchange(top, top + 426)}, data, group);
  return svg.str();
}

}  // namespace studies
