#include "studies/report/chart.h"
#include "studies/report/shape_chart.h"
#include "studies/torsion/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

struct Series {
  const char *method, *name;
  std::string colour, dash;
  double TorsionTip::*error;
};

const std::vector<Series> own_series = {
    {"bend_twist_12", "published 12, bend then twist", colour::blue, "", &TorsionTip::own_mm},
    {"twist_bend_12", "published 12, twist then bend", colour::sky, "", &TorsionTip::own_mm},
    {"bend_twist_500", "published 500, bend then twist", colour::blue, "5 3", &TorsionTip::own_mm},
    {"midpoint_12", "midpoint 12", colour::green, "", &TorsionTip::own_mm},
    {"fourth_order_12", "fourth_order 12", colour::orange, "", &TorsionTip::own_mm},
    {"sixth_order_12", "sixth_order 12", colour::black, "", &TorsionTip::own_mm}};

const std::vector<Series> fe_series = {
    {"bend_twist_12", "published 12 − FE", colour::blue, "", &TorsionTip::fe_mm},
    {"twist_bend_12", "twist then bend 12 − FE", colour::sky, "", &TorsionTip::fe_mm},
    {"fourth_order_12", "fourth_order 12 − FE", colour::orange, "", &TorsionTip::fe_mm},
    {"fourth_order_reissner_50", "fourth_order 50 with shear − FE", colour::purple, "", &TorsionTip::fe_mm}};

void draw(Panel& panel, const TorsionData& data, const std::vector<Series>& series, double largest_Nmm) {
  for (const Series& s : series) {
    std::vector<Point> points;
    for (const double torque : data.torques_Nmm) {
      const double error = data.tip(torque, s.method).*(s.error);
      if (torque <= largest_Nmm && std::isfinite(error)) points.push_back({torque, std::max(error, 1e-9)});
    }
    panel.curve(points, {s.colour, 1.6, s.dash});
    panel.dots(points, s.colour, 2.5);
    panel.name(points.back(), s.name, s.colour);
  }
  panel.place_names();
}

std::string error_picture(const TorsionData& data) {
  Svg svg(1330, 930, "Case S1 (our loads) with a follower torque at the tip: tip error",
          "Case S1 (our loads) with a follower torque at the tip: tip error");
  const Axis error{"tip error, mm", 1e-8, 100, true}, small{"torque, N mm", 0, 50}, all{"torque, N mm", 0, 1000};
  Panel own(svg, {80, 66}, 350, 340, small, error), fe(svg, {720, 66}, 350, 340, small, error);
  own.frame("The paper's range, against the exact Kirchhoff rod");
  draw(own, data, own_series, 50);
  fe.frame("The same, against finite elements with shear");
  draw(fe, data, fe_series, 50);
  Panel far(svg, {80, 500}, 350, 340, all, error), far_fe(svg, {720, 500}, 350, 340, all, error);
  far.frame("Beyond it, against the exact Kirchhoff rod");
  draw(far, data, own_series, 1000);
  far_fe.frame("The same, against finite elements with shear");
  draw(far_fe, data, fe_series, 1000);
  return svg.str();
}

std::string order_picture(const TorsionData& data) {
  Svg svg(1010, 470, "Case S1 (our loads): tip error over N, against the exact Kirchhoff rod",
          "Case S1 (our loads): tip error over N, against the exact Kirchhoff rod");
  const std::vector<std::string> colours = {colour::blue, colour::sky, colour::green, colour::orange, colour::black};
  const std::vector<std::string> names = {"bend, twist", "twist, bend", "midpoint", "fourth_order", "sixth_order"};
  double left = 80;
  for (const double torque : {0.0, 50.0}) {
    Panel panel(svg, {left, 66}, 320, 340, {"number of arcs N", 3, 200, true}, {"tip error, mm", 1e-10, 100, true});
    panel.frame(fmt::format("torque {} N mm", torque));
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::vector<Point> points;
      for (const TorsionOrder& o : data.orders) {
        if (o.torque_Nmm == torque && o.law == torsion_laws()[i] && o.own_mm > 1e-9) {
          points.push_back({static_cast<double>(o.arcs), o.own_mm});
        }
      }
      panel.curve(points, {colours[i], 1.6, ""});
      panel.dots(points, colours[i], 2.5);
      panel.name(points.back(), names[i], colours[i]);
    }
    panel.place_names();
    left += 490;
  }
  return svg.str();
}

std::string shapes_picture(const TorsionData& data) {
  const std::map<double, std::string> colours = {
      {0, colour::blue}, {20, colour::green}, {50, colour::orange}, {200, colour::purple}};
  std::vector<Centreline> lines;
  for (const TorsionShape& shape : data.shapes) {
    const bool exact = shape.method == "exact_kirchhoff";
    Centreline line{exact ? "" : fmt::format("{} N mm", shape.torque_Nmm), {}, colours.at(shape.torque_Nmm), "", exact};
    for (std::size_t i = 0; i < shape.positions_mm.size(); i += exact ? 4 : 1) {
      line.positions_B_mm.push_back(shape.positions_mm[i]);
    }
    lines.push_back(std::move(line));
  }
  return shape_chart(lines, {{0, 1}, {0, 2}, {1, 2}}, "Case S1 (our loads) with a torque at the tip",
                     "lines: published law, 12 arcs, bend then twist; dots: exact Kirchhoff rod");
}

}  // namespace

std::map<std::string, std::string> torsion_pictures(const TorsionData& data) {
  return {
      {"errors.svg", error_picture(data)}, {"orders.svg", order_picture(data)}, {"shapes.svg", shapes_picture(data)}};
}

}  // namespace studies
