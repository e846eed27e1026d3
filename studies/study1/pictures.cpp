#include "studies/compare/error_measures.h"
#include "studies/report/chart.h"
#include "studies/report/table.h"
#include "studies/study1/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace studies {
namespace {

// Axes that hold all shapes of a set: along x, and along y or z.
Axis axis_over(const std::vector<const Study1Shape*>& shapes, int component) {
  Axis axis{std::string(1, "xyz"[component]) + ", mm", 0, 0, false};
  for (const Study1Shape* shape : shapes) {
    for (const auto& p : shape->positions_mm) {
      axis.low = std::min(axis.low, p[component] - 2);
      axis.high = std::max(axis.high, p[component] + 2);
    }
  }
  return axis;
}

// FAM a line, FE a dot every fourth millimetre.
void draw_shape(Panel& panel, const Study1Shape& shape, int up) {
  const bool fe = shape.method == "fe";
  std::vector<Point> points;
  for (std::size_t s = 0; s < shape.positions_mm.size(); s += fe ? 4 : 1) {
    points.push_back({shape.positions_mm[s][0], shape.positions_mm[s][up]});
  }
  const std::string& colour = method_row(study1_method(shape.method).row).style.colour;
  if (fe) return panel.dots(points, colour, 2.4);
  panel.curve(points, {colour, 1.8, ""});
  panel.name(points.back(), shape.load_case, colour::black);
}

std::string shapes_description(bool planar) {
  return fmt::format(
      "Deformed centrelines of the eight {} cases in mm, clamp at the origin, undeformed rod along x, four cases a "
      "panel{}. Orange lines: FAM published with 12 arcs. Green dots on or near them: finite elements. Where the dots "
      "leave the line, the two differ.",
      planar ? "planar" : "spatial", planar ? "" : ": seen along z on the left, along y on the right");
}

// Names of the cases in place of the ticks of an axis from 0.5 to 16.5.
void name_cases(Svg& svg, const Panel& panel, Point corner, double width, double height) {
  svg.rectangle({corner.x - 6, corner.y + height + 2}, width + 12, 18, "white");
  const std::vector<std::string> cases = study1_cases();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    svg.text({panel.at({static_cast<double>(i) + 1, 1}).x, corner.y + height + 16}, cases[i], Anchor::middle, 11);
  }
}

struct Series {
  std::string method, a, b, dash;
};

// A dot a case, those below `floor` on it; lines between neighbours that are above.
void draw_series(Panel& panel, const Study1Data& data, const Series& series, double floor) {
  const std::string& colour = method_row(study1_method(series.method).row).style.colour;
  std::vector<Point> all, line;
  const std::vector<std::string> cases = study1_cases();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto* d = difference(data, cases[i], "follower", series.a, series.b);
    const bool above = d && d->tip_mm.norm() > floor;
    if (d) all.push_back({static_cast<double>(i) + 1, above ? d->tip_mm.norm() : floor});
    if (above) line.push_back(all.back());
    if (above && i + 1 < cases.size()) continue;
    if (line.size() > 1) panel.curve(line, {colour, 1, series.dash});
    line.clear();
  }
  panel.dots(all, colour, 3.2);
  if (!all.empty()) panel.name({16.5, all.back().y}, study1_label(series.method), colour);
}

// "FE 1.0e-7, …": the medians.
std::string medians_text(const Study1Data& data, const std::vector<Series>& series) {
  std::string text;
  for (const Series& s : series) {
    const std::vector<double> distances = distances_mm(data, study1_cases(), "follower", s.a, s.b);
    if (distances.empty()) continue;
    text += (text.empty() ? "" : "; ") + study1_label(s.method) + " " + scientific(quantile(distances, 0.5), 1);
  }
  return text;
}

}  // namespace

std::string shapes_picture(const Study1Data& data, bool planar) {
  std::vector<const Study1Shape*> shapes;
  for (const Study1Shape& shape : data.shapes) {
    if (shape.frame == "follower" && is_planar(shape.load_case) == planar) shapes.push_back(&shape);
  }
  constexpr double size = 350, left = 70, top = 84, across = 440, down = 440;
  const int rows = planar ? 1 : 2;
  Svg svg(890, top + rows * down - 30,
          std::string("Study I: the eight ") + (planar ? "planar" : "spatial") + " cases, follower loads of our own",
          shapes_description(planar), "lines: FAM published, 12 arcs; dots: FE, 50 quadratic elements");
  for (int half = 0; half < 2; ++half) {
    for (int view = 0; view < rows; ++view) {
      const int up = 1 + view;
      Axis x = axis_over(shapes, 0), y = axis_over(shapes, up);
      equal_scale(x, y, size, size);
      Panel panel(svg, {left + (planar ? half : view) * across, top + (planar ? 0 : half) * down}, size, size, x, y);
      panel.frame(fmt::format("{0}{1} to {0}{2}", planar ? "P" : "S", 4 * half + 1, 4 * half + 4));
      for (const Study1Shape* shape : shapes) {
        if ((shape->load_case[1] - '1') / 4 == half) draw_shape(panel, *shape, up);
      }
      panel.place_names();
    }
  }
  return svg.str();
}

std::string errors_picture(const Study1Data& data) {
  constexpr double floor = 1e-9, width = 600, height = 390;
  constexpr Point corner{80, 64};
  const std::vector<Series> series = {{fam12, fam12, "exact", ""},
                                      {"fam_published_50", "fam_published_50", "exact", "5 3"},
                                      {"exact_kirchhoff", "exact_kirchhoff", "exact", "5 3"},
                                      {"fam", "fam", "exact", "2 3"},
                                      {sixth12, sixth12, "exact", ""},
                                      {"fe", "exact", "fe", ""}};
  Svg svg(900, 520, "Study I, follower loads of our own: distance of the tip from the exact tip",
          "Logarithmic vertical axis: distance of the tip from the exact tip in mm. Horizontal axis: the sixteen load "
          "cases, P1 to P8 planar, S1 to S8 spatial. One row of dots a method. Medians in mm: " +
              medians_text(data, series) + ".",
          "dots on the lowest line: less than 1e-9 mm");
  double most = 10;
  for (const Series& s : series) {
    for (const double d : distances_mm(data, study1_cases(), "follower", s.a, s.b)) most = std::max(most, d);
  }
  Panel panel(svg, corner, width, height, {"load case", 0.5, 16.5, false}, {"distance, mm", floor, most, true});
  panel.frame();
  name_cases(svg, panel, corner, width, height);
  for (const Series& s : series) draw_series(panel, data, s, floor);
  panel.place_names();
  return svg.str();
}

std::string split_picture(const Study1Data& data) {
  struct Part {
    std::string a, b, name, fill;
  };
  const std::vector<Part> parts = {
      {fam12, "exact_kirchhoff", "the law with 12 arcs", method_row("fam_published").style.colour},
      {"exact_kirchhoff", "exact", "no shear, no stretch", colour::grey}};
  constexpr double width = 640, height = 350;
  constexpr Point corner{80, 64};
  double most = 1e-3;
  for (const std::string& load_case : study1_cases()) {
    double sum = 0;
    for (const Part& part : parts) {
      if (const auto* d = difference(data, load_case, "follower", part.a, part.b)) sum += d->tip_mm.norm();
    }
    most = std::max(most, sum);
  }
  Svg svg(900, 480, "Study I, follower loads of our own: what FAM published − FE is made of",
          "A bar for each of the sixteen load cases, P1 to P8 planar, S1 to S8 spatial; heights in mm. Lower part, "
          "orange: the error of the published law with 12 arcs; upper part, grey: what leaving out shear and stretch "
          "moves the tip. A black dot marks the distance of the tips of FAM and FE, which is their sum as vectors.",
          "bars: lengths of the two parts; dots: their sum as vectors, the distance FAM − FE");
  Panel panel(svg, corner, width, height, {"load case", 0.5, 16.5, false}, {"length, mm", 0, 1.08 * most, false});
  panel.frame();
  name_cases(svg, panel, corner, width, height);
  const std::vector<std::string> cases = study1_cases();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double x = static_cast<double>(i) + 1;
    double top = 0;
    for (const Part& part : parts) {
      const Study1Difference* d = difference(data, cases[i], "follower", part.a, part.b);
      if (!d) continue;
      const Point from = panel.at({x - 0.3, top + d->tip_mm.norm()}), to = panel.at({x + 0.3, top});
      svg.rectangle(from, to.x - from.x, to.y - from.y, part.fill);
      top += d->tip_mm.norm();
    }
    const Study1Difference* all = difference(data, cases[i], "follower", fam12, "fe");
    if (!all) continue;
    svg.circle(panel.at({x, all->tip_mm.norm()}), 5, "white");
    svg.circle(panel.at({x, all->tip_mm.norm()}), 3.5, colour::black);
  }
  const double left = corner.x + width + 14;
  svg.text({left, 140}, "● FAM − FE", Anchor::start, 12, colour::black);
  svg.text({left, 165}, "■ " + parts[1].name, Anchor::start, 12, parts[1].fill);
  svg.text({left, 190}, "■ " + parts[0].name, Anchor::start, 12, parts[0].fill);
  return svg.str();
}

}  // namespace studies
