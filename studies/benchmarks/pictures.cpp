#include "studies/benchmarks/data.h"

#include "studies/report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace studies {
namespace {

constexpr double floor_difference = 1e-11;  // smaller ones are drawn here: beyond the ten digits that are compared
const double radii[] = {5.2, 3.9, 2.5};     // methods that agree lie on each other: the later, the smaller

// The methods' marks and names, in one line.
void draw_key(Svg& svg, double y) {
  double x = 30;
  for (std::size_t m = 0; m < benchmark_methods().size(); ++m) {
    const MethodRow& row = benchmark_methods()[m].row;
    svg.circle({x, y}, radii[m], row.style.colour);
    svg.text({x + 10, y + 4}, row.name, Anchor::start, 12, row.style.colour);
    x += 40 + text_width(row.name, 12);
  }
}

// --- Differences over the parameter ---------------------------------------------------------------------------------

bool has_panel(const BenchmarkResult& result, const std::string& source) {
  std::set<double> parameters;
  for (const BenchmarkRow* row : rows_of(result, source)) parameters.insert(row->point.parameter);
  return parameters.size() > 2;
}

const std::string& parameter_of(const BenchmarkResult& result, const BenchmarkRows& rows) {
  const std::vector<BenchmarkFamily>& families = result.benchmark.families;
  return std::find_if(families.begin(), families.end(),
                      [&](const BenchmarkFamily& f) { return f.name == rows.front()->point.family; })
      ->parameter;
}

double shown(double difference) {
  return std::max(difference, floor_difference);
}

Axis parameter_axis(const std::string& label, const BenchmarkRows& rows) {
  double low = INFINITY, high = 0;
  for (const BenchmarkRow* row : rows) {
    low = std::min(low, row->point.parameter);
    high = std::max(high, row->point.parameter);
  }
  if (low > 0 && high > 30 * low) return {label, low / 1.3, high * 1.3, true};
  return {label, low - 0.04 * (high - low), high + 0.04 * (high - low), false};
}

// Whole decades around all that is drawn.
Axis difference_axis(const std::string& label, const BenchmarkRows& rows) {
  double low = INFINITY, high = floor_difference;
  const auto include = [&](double value) {
    low = std::min(low, shown(value));
    high = std::max(high, shown(value));
  };
  for (const BenchmarkRow* row : rows) {
    include(printed_difference(*row));
    for (std::size_t m = 0; m < row->found.size(); ++m) {
      if (row->found[m].solved()) include(largest_difference(*row, m));
    }
  }
  return {label, std::pow(10, std::floor(std::log10(low) - 0.1)), std::pow(10, std::ceil(std::log10(high) + 0.1)),
          true};
}

// Grey up to the difference below which a value rounds to the print, from place to place; of prints that share a place
// the finest.
void draw_band(Svg& svg, const Panel& panel, const Axis& x, const Axis& y, const BenchmarkRows& rows) {
  std::map<double, double> limits;
  for (const BenchmarkRow* row : rows) {
    double& limit = limits.emplace(row->point.parameter, INFINITY).first->second;
    limit = std::min(limit, printed_difference(*row));
  }
  std::vector<Point> edge{panel.at({x.low, y.low}), panel.at({x.low, limits.begin()->second})};
  for (const auto& [parameter, limit] : limits) edge.push_back(panel.at({parameter, limit}));
  edge.push_back(panel.at({x.high, limits.rbegin()->second}));
  edge.push_back(panel.at({x.high, y.low}));
  svg.polygon(edge, "#e3e3e3");
}

void draw_source(Svg& svg, const BenchmarkResult& result, const BenchmarkSource& source, Point corner, double width,
                 double height) {
  const BenchmarkRows rows = rows_of(result, source.key);
  const bool over_length = source.worth == "digitised";
  const Axis x = parameter_axis(parameter_of(result, rows), rows);
  const Axis y = difference_axis(over_length ? "difference / L" : "difference / |printed|", rows);
  Panel panel(svg, corner, width, height, x, y);
  draw_band(svg, panel, x, y, rows);
  panel.frame(source.title);
  for (std::size_t m = 0; m < benchmark_methods().size(); ++m) {
    const std::string& colour = benchmark_methods()[m].row.style.colour;
    for (const BenchmarkRow* row : rows) {
      if (row->found[m].solved()) {
        panel.dots({{row->point.parameter, shown(largest_difference(*row, m))}}, colour, radii[m]);
      } else {
        panel.failure({row->point.parameter, y.high / 1.5}, colour);
      }
    }
  }
}

}  // namespace

std::string differences_picture(const BenchmarkResult& result) {
  std::vector<BenchmarkSource> sources;
  for (const BenchmarkSource& source : result.benchmark.sources) {
    if (has_panel(result, source.key)) sources.push_back(source);
  }
  const std::size_t columns = std::min<std::size_t>(2, sources.size()), lines = (sources.size() + 1) / 2;
  const double width = columns == 1 ? 560 : 350, height = 190, gap = 90, top = 104, pitch = height + 80;
  std::string titles;
  for (const BenchmarkSource& s : sources) titles += (titles.empty() ? "" : "; ") + s.title;
  const std::string description = fmt::format(
      "{} panels, one a source ({}). Horizontal: the load or what else was varied. Vertical, logarithmic: difference "
      "of "
      "a method's value to the source's, over what the source gives. Dots: black exact, green FE, blue FAM automatic; "
      "where they lie on each other the methods agree and the difference is to the source. Dots in the grey band at "
      "the bottom round to what is printed.",
      sources.size(), titles);
  Svg svg(80 + static_cast<double>(columns) * (width + gap) - gap + 20, top + static_cast<double>(lines) * pitch - 16,
          result.benchmark.title + ": method − source", description,
          "Grey: rounds to the print. Dots on each other: the methods agree. Below 1e-11: drawn there.");
  draw_key(svg, 62);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Point corner{80 + static_cast<double>(i % 2) * (width + gap), top + static_cast<double>(i / 2) * pitch};
    draw_source(svg, result, sources[i], corner, width, height);
  }
  return svg.str();
}

// --- Matching digits, a line a source -------------------------------------------------------------------------------

namespace {

constexpr double digits_left = 390, digit_width = 46, line_height = 18;

double digits_x(double digits) {
  return digits_left + digit_width * digits;
}

void draw_digits(Svg& svg, const BenchmarkSource& source, const BenchmarkRows& rows, double y) {
  const DigitSummary exact = digit_summary(rows, by_exact);
  svg.rectangle({digits_left, y - 8}, digit_width * exact.most_carried, 16, "#eeeeee");
  svg.rectangle({digits_left, y - 8}, digit_width * exact.fewest_carried, 16, "#dddddd");
  svg.text({digits_left - 10, y + 4}, source.title, Anchor::end, 12);
  for (std::size_t m = 0; m < benchmark_methods().size(); ++m) {
    const std::string& colour = benchmark_methods()[m].row.style.colour;
    const DigitSummary s = digit_summary(rows, m);
    const double at = y + 5 * (static_cast<double>(m) - 1);
    if (s.solved > 0) {
      svg.line({digits_x(s.lowest), at}, {digits_x(s.median), at}, {colour, 1.2, ""});
      svg.circle({digits_x(s.median), at}, 3, colour);
    }
    if (s.solved < s.points) svg.cross({digits_x(10.4) + 12 * static_cast<double>(m), y}, 4, {colour, 1.6, ""});
  }
}

}  // namespace

std::string digits_picture(const std::vector<BenchmarkResult>& results) {
  std::size_t lines = 0;
  for (const BenchmarkResult& result : results) lines += result.benchmark.sources.size() + 1;
  const double top = 90, height = line_height * static_cast<double>(lines);
  Svg svg(
      900, top + height + 46, "Matching digits, by source",
      "A line a source, grouped by case. Horizontal: matching digits, 0 to 10. Grey bar: the digits that the source "
      "carries (lighter: on some of its points). A dot a method at the median over the source's points, a line down "
      "to the lowest: black exact, green FE, blue FAM automatic. Where the three dots stand one above the other left "
      "of the bar's end, the source deviates; where black ends the bar and green and blue stay left, it is the "
      "methods' own error.",
      "Dot: median over the points; line: down to the lowest; grey: digits that the source carries; ×: points "
      "without a value");
  draw_key(svg, 62);
  for (int digits = 0; digits <= 10; ++digits) {
    svg.line({digits_x(digits), top - 8}, {digits_x(digits), top + height}, {colour::faint, 1, ""});
    svg.text({digits_x(digits), top + height + 16}, std::to_string(digits), Anchor::middle, 11);
  }
  svg.text({digits_x(5), top + height + 34}, "matching digits", Anchor::middle);
  double y = top;
  for (const BenchmarkResult& result : results) {
    svg.text({26, y + 6}, result.benchmark.title, Anchor::start, 12, "#666");
    y += line_height;
    for (const BenchmarkSource& source : result.benchmark.sources) {
      draw_digits(svg, source, rows_of(result, source.key), y);
      y += line_height;
    }
  }
  return svg.str();
}

}  // namespace studies
