#include "studies/study1/pictures.h"

#include "studies/report/chart.h"
#include "studies/report/shape_chart.h"

#include <algorithm>
#include <tuple>

namespace studies {

std::string shapes_picture(const Study1Data& data, bool planar) {
  const std::vector<std::string> colours = {colour::blue,   colour::orange, colour::green, colour::purple,
                                            colour::yellow, colour::sky,    colour::black, colour::grey};
  std::vector<Centreline> lines;
  const std::vector<std::string> cases = study1_cases(planar);
  for (const Study1Shape& shape : data.shapes) {
    if (shape.frame != "follower" || is_planar(shape.load_case) != planar) continue;
    const bool fe = shape.method == "fe";
    const auto index = static_cast<std::size_t>(shape.load_case[1] - '1');
    Centreline line{fe ? "" : shape.load_case, shape.positions_mm, colours[index], "", fe};
    if (fe) {  // a dot every fourth millimetre
      line.positions_B_mm.clear();
      for (std::size_t s = 0; s < shape.positions_mm.size(); s += 4)
        line.positions_B_mm.push_back(shape.positions_mm[s]);
    }
    lines.push_back(std::move(line));
  }
  return shape_chart(lines, planar ? std::vector<View>{{0, 1}} : std::vector<View>{{0, 1}, {0, 2}, {1, 2}},
                     std::string("Study I, ") + (planar ? "planar" : "spatial") + " cases, follower loads (ours)",
                     "lines: FAM, published law, 12 arcs; dots: FE, 50 quadratic elements with shear and stretch");
}

std::string errors_picture(const Study1Data& data) {
  struct Series {
    const char *a, *b, *name;
    std::string colour;
  };
  const std::vector<Series> series = {
      {"fam_published_12", "fe", "published 12 − FE", colour::orange},
      {"fam_published_12", "fe_kirchhoff", "published 12 − FE Kirchhoff (own error)", colour::blue},
      {"fam_published_50", "fe_kirchhoff", "published 50 − FE Kirchhoff", colour::sky},
      {"fam_fourth_order_50", "fe_kirchhoff", "fourth_order 50 − FE Kirchhoff", colour::green},
      {"fam_fourth_order_50_reissner", "fe", "fourth_order 50 Reissner − FE", colour::purple}};
  Svg svg(1000, 470, "Study I, follower loads (ours): distance of the tips, case by case",
          "Study I, follower loads (ours): distance of the tips, case by case");
  Panel panel(svg, {80, 50}, 600, 350, {"load case", 0.5, 16.5, false}, {"distance of the tips, mm", 1e-9, 10, true});
  panel.frame();
  svg.rectangle({81, 402}, 620, 18, "white");
  const std::vector<std::string> cases = study1_cases();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    svg.text({panel.at({static_cast<double>(i) + 1, 1}).x, 416}, cases[i], Anchor::middle, 11);
  }
  for (const Series& s : series) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (const auto* d = difference(data, cases[i], "follower", s.a, s.b)) {
        points.push_back({static_cast<double>(i) + 1, std::max(d->tip_mm.norm(), 1e-9)});
      }
    }
    if (points.empty()) continue;
    panel.dots(points, s.colour, 4);
    panel.curve(points, {s.colour, 0.4, ""});
    panel.name({16.5, points.back().y}, s.name, s.colour);
  }
  panel.place_names();
  return svg.str();
}

// Stacked: the lengths of the three parts; a dot where their vector sum, FAM - FE, ends.
std::string split_picture(const Study1Data& data) {
  Svg svg(1000, 470, "Study I, follower loads (ours): what FAM (published, 12 arcs) − FE is made of",
          "Study I, follower loads (ours): what FAM (published, 12 arcs) − FE is made of");
  Panel panel(svg, {80, 50}, 640, 350, {"load case", 0.5, 16.5, false}, {"length of each part, mm", 0, 3, false});
  panel.frame();
  svg.rectangle({81, 402}, 660, 18, "white");
  const std::vector<std::string> cases = study1_cases();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double x = static_cast<double>(i) + 1;
    svg.text({panel.at({x, 0}).x, 416}, cases[i], Anchor::middle, 11);
    double top = 0;
    for (const auto& [a, b, fill] : {std::tuple{fam12, std::string("exact_kirchhoff"), colour::blue},
                                     std::tuple{std::string("exact_kirchhoff"), std::string("exact"), colour::orange},
                                     std::tuple{std::string("exact"), std::string("fe"), colour::black}}) {
      const Study1Difference* d = difference(data, cases[i], "follower", a, b);
      if (!d) continue;
      const double length = d->tip_mm.norm();
      const Point corner = panel.at({x - 0.3, top + length});
      const Point base = panel.at({x + 0.3, top});
      svg.rectangle(corner, base.x - corner.x, base.y - corner.y, fill);
      top += length;
    }
    if (const auto* d = difference(data, cases[i], "follower", fam12, "fe")) {
      const Point total = panel.at({x, d->tip_mm.norm()});
      svg.circle(total, 4.5, "white");
      svg.circle(total, 3, colour::green);
    }
  }
  const double left = 740;
  svg.text({left, 120}, "● |FAM − FE|, the vector sum", Anchor::start, 12, colour::green);
  svg.text({left, 145}, "■ exact Reissner − FE: below 1e-6 mm,", Anchor::start, 12, colour::black);
  svg.text({left + 14, 161}, "too thin to see", Anchor::start, 12, colour::black);
  svg.text({left, 186}, "■ exact Kirchhoff − exact Reissner", Anchor::start, 12, colour::orange);
  svg.text({left, 211}, "■ FAM − exact Kirchhoff", Anchor::start, 12, colour::blue);
  return svg.str();
}

}  // namespace studies
