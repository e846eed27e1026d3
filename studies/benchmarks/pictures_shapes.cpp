// The two pictures that are no differences: shapes under follower forces, and the map of the 45° bend's tips.
#include "studies/benchmarks/data.h"

#include "studies/report/chart.h"

namespace studies {
namespace {

const std::string& colour_of(std::size_t method) {
  return benchmark_methods()[method].row.style.colour;
}

std::vector<Point> points_of(const BenchmarkLine& line, std::size_t right, std::size_t up) {
  std::vector<Point> points;
  for (const auto& sample : line.samples) points.push_back({sample[right], sample[up]});
  return points;
}

}  // namespace

std::string shapes_picture(const BenchmarkResult& result) {
  Axis x{"x, cm", -22, 105, false}, y{"y, cm (the published loads push to −y: mirrored)", -60, 85, false};
  Svg svg(
      620, 650, "Follower force: shapes of Argyris & Symeonidis 1981",
      "Centrelines of a cantilever of 100 cm in its plane, clamped at the origin, under follower forces from 3.7 to "
      "120 kN: with the load the rod bends up, back over the clamp and through below it. Lines: exact; grey dots: "
      "points read off the published figure; one that lies beside its line tells of the figure or its reading.",
      "Lines: exact, EI = 3.5e7 N cm²; dots: read off the published figure; numbers: kN");
  equal_scale(x, y, 500, 525);
  Panel panel(svg, {80, 66}, 500, 525, x, y);
  panel.frame();
  for (const BenchmarkLine& line : result.lines) {
    const std::vector<Point> points = points_of(line, 1, 2);
    panel.curve(points, {colour_of(by_exact), 1.2, ""});
    if (!points.empty()) panel.name(points.back(), line.family.substr(line.family.find('_') + 1), colour::black);
  }
  for (const BenchmarkRow* row : rows_of(result, "argyris")) {
    panel.dots({{row->point.published[0].value, row->point.published[1].value}}, colour::grey, 3);
  }
  panel.place_names();
  return svg.str();
}

// The published tips at F = 600, and the exact ones for torsion constants between the two.
std::string bend45_picture(const BenchmarkResult& result) {
  Svg svg(
      860, 580, "45° bend, F = 600: where the published tips lie, and where the torsion constant puts them",
      "Tips in the x-z plane, length units. A black line: the exact tip for torsion constants J from 0.141 (lower "
      "x, higher z) to 1/6; at its ends the dots of FE and FAM automatic lie on the exact one. Grey dots: published "
      "tips with their sources' names; one at an end of the line agrees with that constant.",
      "Line: exact, J from 0.141 to 1/6; at its ends FE (green) and FAM automatic (blue); grey: published");
  Panel panel(svg, {80, 70}, 740, 450, {"x of the tip, length units", 46.85, 47.27, false},
              {"z of the tip, length units", 53.34, 53.66, false});
  panel.frame();
  for (const BenchmarkLine& line : result.lines) {
    const std::vector<Point> points = points_of(line, 1, 3);
    panel.curve(points, {colour_of(by_exact), 2, ""});
  }
  for (const BenchmarkRow& row : result.rows) {
    if (row.point.parameter != 600) continue;
    const Point p{row.point.published[0].value, row.point.published[2].value};
    if (row.point.source == "published_polar") {
      panel.dots({p}, colour::grey, 4);
      panel.name(p, row.point.label.substr(0, row.point.label.find(", F")), "#555555");
    } else if (row.point.source != "published_st_venant") {
      for (const std::size_t m : {by_fe, by_fam}) {
        const double radius = m == by_fe ? 6 : 3.5;
        if (row.found[m].solved()) panel.dots({{row.found[m].values[0], row.found[m].values[2]}}, colour_of(m), radius);
        else panel.failure(p, colour_of(m));
      }
    }
  }
  for (const BenchmarkLine& line : result.lines) {
    if (line.samples.empty()) continue;
    panel.name(points_of(line, 1, 3).front(), "exact, J = 0.141", colour::black);
    panel.name(points_of(line, 1, 3).back(), "exact, J = 1/6", colour::black);
  }
  panel.place_names();
  return svg.str();
}

}  // namespace studies
