#include "studies/stability/folds.h"

#include "exact_reference/path.h"
#include "fam/path.h"
#include "studies/report/chart.h"
#include "studies/report/table.h"

#include <cmath>
#include <numbers>

namespace studies {
namespace {

using scene::PathPoint;
using Kind = PathPoint::Kind;

constexpr double loads[] = {2.48, 2.6, 2.8, 3.2, 4, 5, 7, 10, 14, 20, 30, 50, 100};
constexpr std::size_t judged_every = 3;  // by the exact reference
constexpr double rod_length_mm = 100, in_plane_Nmm2 = 1000, degree_rad = std::numbers::pi / 180;
constexpr double round_like = 1, strip_like = 1000;  // stiffness out of the plane over that in it

scene::PathRequest turned_force(double load, double out_of_plane) {
  scene::Stiffness stiffness;
  stiffness.bending_Nmm2 = {out_of_plane * in_plane_Nmm2, in_plane_Nmm2};
  stiffness.torsion_Nmm2 = 0.7 * in_plane_Nmm2;
  scene::PathRequest request;
  request.scene = {
      "",
      {{rod_length_mm, stiffness, Eigen::Vector3d::Zero()}},
      {scene::Force{
          rod_length_mm, scene::Frame::fixed, {0, load * in_plane_Nmm2 / (rod_length_mm * rod_length_mm), 0}}}};
  request.parameter = scene::PathParameter::turn_rad;
  request.axis_B = Eigen::Vector3d::UnitZ();
  request.to = 3 * std::numbers::pi;
  return request;
}

// Where the answer that it had is stable last: the first fold or branch point.
std::optional<double> lost_deg(const scene::Path& path) {
  for (const PathPoint& point : path.points) {
    if (point.kind == Kind::fold || point.kind == Kind::branch) return 90 + point.parameter / degree_rad;
  }
  return std::nullopt;
}

std::optional<double> fold_deg(const scene::Path& path) {
  for (const PathPoint& point : path.points) {
    if (point.kind == Kind::fold) return 90 + point.parameter / degree_rad;
  }
  return std::nullopt;
}

std::string cell(const std::optional<double>& angle_deg) {
  return angle_deg ? fixed(*angle_deg, 4) : "–";
}

using Angle = std::optional<double> FoldPoint::*;

std::vector<Point> curve_of(const std::vector<FoldPoint>& points, Angle angle_deg) {
  std::vector<Point> curve;
  for (const FoldPoint& p : points) {
    if (p.*angle_deg) curve.push_back({*(p.*angle_deg), p.load});
  }
  return curve;
}

std::string picture(const std::vector<FoldPoint>& points) {
  Svg svg(640, 500, "Turned past the axis: where two answers are stable",
          "Angle of the force against its size: where the answer that lags behind stops being stable.",
          "a force across the rod (90°) is turned to press on it (180°) and on; dots: exact");
  Panel panel(svg, {80, 66}, 500, 370, {"angle to the rod, degrees", 170, 360, false}, {"|F| L²/EI", 2, 120, true});
  panel.frame();
  const auto draw = [&](Angle angle_deg, const std::string& name, const std::string& colour, const std::string& dash) {
    const std::vector<Point> curve = curve_of(points, angle_deg);
    panel.curve(curve, {colour, 1.8, dash});
    if (!curve.empty()) panel.name(curve[curve.size() / 2], name, colour);
  };
  draw(&FoldPoint::round_deg, "round: swings about its axis", colour::blue, "");
  draw(&FoldPoint::strip_deg, "strip: leaves its plane", colour::green, "");
  draw(&FoldPoint::fold_deg, "held in the plane: snaps through", colour::orange, "5 4");
  panel.dots(curve_of(points, &FoldPoint::strip_exact_deg), colour::black, 3);
  panel.place_names();
  return svg.str();
}

}  // namespace

std::vector<FoldPoint> fold_curves() {
  fam::Options options;
  options.tolerance_mm = 1e-6 * rod_length_mm;
  std::vector<FoldPoint> points;
  for (const double load : loads) {
    const scene::Path of_round = fam::Path::follow(turned_force(load, round_like), options).points();
    const scene::Path of_strip = fam::Path::follow(turned_force(load, strip_like), options).points();
    FoldPoint point{load, lost_deg(of_round), lost_deg(of_strip), std::nullopt, fold_deg(of_strip)};
    if (points.size() % judged_every == 0)
      point.strip_exact_deg = lost_deg(exact_reference::follow(turned_force(load, strip_like)));
    points.push_back(point);
  }
  return points;
}

std::map<std::string, std::string> fold_files(const std::vector<FoldPoint>& points) {
  Table table({"load", "round_lost_deg", "strip_lost_deg", "strip_lost_exact_deg", "fold_deg"});
  for (const FoldPoint& p : points)
    table.add(
        {significant(p.load, 3), cell(p.round_deg), cell(p.strip_deg), cell(p.strip_exact_deg), cell(p.fold_deg)});
  return {
      {"direction_folds.csv",
       table.csv({"A tip force of |F| L^2/EI turned past the axis of a clamped rod (180 degrees): where the answer it",
                  "had is stable last, of a round rod and of one 1000 times stiffer out of its plane, and where it",
                  "folds in the plane."})},
      {"direction_folds.svg", picture(points)}};
}

}  // namespace studies
