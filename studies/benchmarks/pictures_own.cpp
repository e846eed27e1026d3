#include "studies/benchmarks/marks.h"

#include <cmath>

namespace studies {
namespace {

const std::vector<std::string> source_colours = {colour::green, colour::purple, colour::sky, colour::yellow};

}  // namespace

void square(Svg& svg, Point p, const std::string& colour) {
  const double r = 6.5;
  svg.polyline({{p.x - r, p.y - r}, {p.x + r, p.y - r}, {p.x + r, p.y + r}, {p.x - r, p.y + r}, {p.x - r, p.y - r}},
               {colour, 1.4, ""});
}

void triangle(Svg& svg, Point p, const std::string& colour) {
  const double r = 9;
  svg.polyline({{p.x, p.y - r}, {p.x + 0.87 * r, p.y + r / 2}, {p.x - 0.87 * r, p.y + r / 2}, {p.x, p.y - r}},
               {colour, 1.4, ""});
}

std::string source_colour(const BenchmarkResult& result, const std::string& key) {
  for (std::size_t i = 0; i < result.benchmark.sources.size(); ++i) {
    if (result.benchmark.sources[i].key == key) return source_colours[i % source_colours.size()];
  }
  return colour::grey;
}

std::string shapes_picture(const BenchmarkResult& result) {
  Axis x{"x, cm", -22, 105, false}, y{"y, cm (the published loads push to −y: mirrored)", -60, 85, false};
  Svg svg(620, 650, "Follower force: shapes of Argyris & Symeonidis 1981",
          "Follower force: shapes of Argyris & Symeonidis 1981");
  svg.text({26, 44}, "lines: exact, EI = 3.5e7 N cm²; dots: digitised from the published figure", Anchor::start, 12,
           colour::grey);
  equal_scale(x, y, 500, 525);
  Panel panel(svg, {80, 66}, 500, 525, x, y);
  panel.frame();
  for (const BenchmarkLine& line : result.lines) {
    if (!line.family.starts_with("shape_")) continue;
    std::vector<Point> points;
    for (const auto& sample : line.samples) points.push_back({sample[1], sample[2]});
    panel.curve(points, {colour::black, 1.2, ""});
    // Beside the tip, on the side to which the rod points.
    const Point before = points[points.size() - 3];
    const bool leftwards = points.back().x - before.x < -0.4 * std::abs(points.back().y - before.y);
    const Point tip = panel.at(points.back());
    svg.text({tip.x + (leftwards ? -7 : 7), tip.y + 4}, line.family.substr(6) + " kN",
             leftwards ? Anchor::end : Anchor::start);
  }
  for (const BenchmarkRow& row : result.rows) {
    if (row.point.source != "argyris") continue;
    panel.dots({{row.point.published[0].value, row.point.published[1].value}}, source_colour(result, "argyris"), 3);
  }
  return svg.str();
}

// The published tips at F = 600, and the exact ones for torsion constants between the two.
std::string bend45_picture(const BenchmarkResult& result) {
  Svg svg(860, 600, "45° bend, F = 600: where the published tips lie, and where the torsion constant puts them",
          "45° bend, F = 600: where the published tips lie, and where the torsion constant puts them");
  svg.text({26, 44},
           "line: exact, J from 0.141 to 1/6; squares: FE; triangles: FAM (blue cross: no value); dots: published; the "
           "tip moves 60",
           Anchor::start, 12, colour::grey);
  Panel panel(svg, {80, 70}, 560, 470, {"x of the tip, length units", 46.85, 47.27, false},
              {"z of the tip, length units", 53.34, 53.66, false});
  panel.frame();
  for (const BenchmarkLine& line : result.lines) {
    std::vector<Point> points;
    for (const auto& sample : line.samples) points.push_back({sample[1], sample[3]});
    panel.curve(points, {colour::black, 2, ""});
    panel.name({points.front().x, points.front().y + 0.018}, "exact, J = 0.141", colour::black);
    panel.name({points.back().x + 0.004, points.back().y + 0.008}, "exact, J = 1/6", colour::black);
  }
  for (const BenchmarkRow& row : result.rows) {
    if (row.point.parameter != 600) continue;
    const std::string& source = row.point.source;
    const Point p{row.point.published[0].value, row.point.published[2].value};
    if (source == "published_polar") {
      panel.dots({p}, colour::green, 4);
      panel.name({p.x + 0.013, p.y}, row.point.label.substr(0, row.point.label.find(", F")), colour::green);
    } else if (source != "published_st_venant") {
      if (!row.found[fe].values.empty()) {
        square(svg, panel.at({row.found[fe].values[0], row.found[fe].values[2]}), method_colours[fe]);
      }
      if (row.found[fam].values.empty()) panel.failure({p.x, 53.34}, method_colours[fam]);
      else triangle(svg, panel.at({row.found[fam].values[0], row.found[fam].values[2]}), method_colours[fam]);
    }
  }
  panel.place_names();
  return svg.str();
}

std::string critical_picture(const BenchmarkResult& result) {
  Svg svg(860, 430, "Critical loads: the exact reference's `stable` below and above the classical load",
          "Critical loads: the exact reference's `stable` below and above the classical load");
  svg.text({26, 44}, "blue: stable; orange: not stable; grey cross: not decided", Anchor::start, 12, colour::grey);
  for (const bool above : {false, true}) {
    const double left = above ? 500 : 160;
    Axis x{above ? "load / classical − 1" : "1 − load / classical (leftwards: nearer)", 1e-10, 1, true};
    Panel panel(svg, {left, 80}, 300, 280, x, {"", 0, 6, false});
    const Stroke axis{colour::black, 1, ""};
    svg.line({left, 360}, {left + 300, 360}, axis);
    for (int k = 1; k <= 9; k += 2) {
      const double px = panel.at({std::pow(10, -k), 0}).x;
      svg.line({px, 80}, {px, 360}, {colour::faint, 1, ""});
      svg.text({px, 376}, "1e-" + std::to_string(k), Anchor::middle, 11);
    }
    svg.text({left + 150, 396}, x.label, Anchor::middle);
    svg.text({left, 72}, above ? "above the classical load" : "below the classical load", Anchor::start, 13);
    for (std::size_t i = 0; i < result.lines.size(); ++i) {
      const double y = 5.2 - static_cast<double>(i);
      for (const auto& sample : result.lines[i].samples) {
        if ((sample[0] > 0) != above) continue;
        const Point p{std::abs(sample[0]), y};
        if (sample[1] < 0) panel.failure(p, colour::grey);
        else panel.dots({p}, sample[1] > 0 ? colour::blue : colour::orange, 5);
      }
      if (!above) svg.text({left - 8, panel.at({1, y}).y + 4}, result.rows[i].point.label, Anchor::end, 12);
    }
  }
  return svg.str();
}

}  // namespace studies
