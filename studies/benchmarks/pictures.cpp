#include "studies/benchmarks/marks.h"
#include "studies/benchmarks/page.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

bool failed_anywhere(const BenchmarkResult& result, std::size_t method) {
  return std::any_of(result.rows.begin(), result.rows.end(),
                     [=](const BenchmarkRow& row) { return row.found[method].values.empty(); });
}

// The key above the panels: one line for the methods, one for the sources.
void draw_key(Svg& svg, const BenchmarkResult& result) {
  double x = 30;
  const auto entry = [&](double y, const std::string& text, const std::string& text_colour) {
    svg.text({x + 12, y + 4}, text, Anchor::start, 12, text_colour);
    x += 34 + 6.6 * static_cast<double>(text.size());
  };
  svg.line({x - 8, 44}, {x + 8, 44}, {colour::black, 1.6, ""});
  entry(44, "exact", colour::black);
  square(svg, {x, 44}, method_colours[fe]);
  entry(44, "FE", method_colours[fe]);
  triangle(svg, {x, 44}, method_colours[fam]);
  entry(44, "FAM", method_colours[fam]);
  if (failed_anywhere(result, fam)) {
    svg.cross({x, 44}, 4, {method_colours[fam], 1.8, ""});
    entry(44, "FAM: no value (status in the table)", method_colours[fam]);
  }
  x = 30;
  for (const BenchmarkSource& source : result.benchmark.sources) {
    svg.circle({x, 64}, 4, source_colour(result, source.key));
    entry(64, source.title, source_colour(result, source.key));
  }
}

// One panel of a picture: a component of some families over their parameter.
struct View {
  std::vector<std::pair<std::string, std::string>> families;  // with the name of their line
  std::size_t component;
  Axis x;
  std::string y_label;
};

bool shown(const View& view, const std::string& family) {
  return std::any_of(view.families.begin(), view.families.end(), [&](const auto& f) { return f.first == family; });
}

bool in_range(const View& view, const BenchmarkRow& row) {
  return shown(view, row.point.family) && row.point.parameter >= view.x.low && row.point.parameter <= view.x.high;
}

Axis y_axis(const BenchmarkResult& result, const View& view) {
  Axis y{view.y_label, 1e300, -1e300, false};
  const auto include = [&](double value) {
    y.low = std::min(y.low, value);
    y.high = std::max(y.high, value);
  };
  for (const BenchmarkRow& row : result.rows) {
    if (in_range(view, row)) include(row.point.published[view.component].value);
  }
  for (const BenchmarkLine& line : result.lines) {
    if (!shown(view, line.family)) continue;
    for (const auto& sample : line.samples) include(sample[view.component + 1]);
  }
  const double margin = 0.07 * (y.high - y.low);
  y.low -= margin;
  y.high += margin;
  return y;
}

void draw_marks(Svg& svg, Panel& panel, const View& view, const Axis& y, const BenchmarkResult& result) {
  std::vector<const BenchmarkRow*> rows;
  for (const BenchmarkRow& row : result.rows) {
    if (in_range(view, row)) rows.push_back(&row);
  }
  for (const auto& sample : result.benchmark.dotted) {
    panel.dots({{sample[0], sample[view.component + 1]}}, source_colour(result, result.benchmark.sources[0].key), 2);
  }
  double radius = 6;  // sources lie on each other: the later, the smaller
  for (const BenchmarkSource& source : result.benchmark.sources) {
    for (const BenchmarkRow* row : rows) {
      if (row->point.source != source.key) continue;
      const Point p{row->point.parameter, row->point.published[view.component].value};
      panel.dots({p}, source_colour(result, source.key), radius);
    }
    radius -= 1.3;
  }
  const std::size_t step = 1 + rows.size() / 24;  // marks of the methods, thinned out
  for (std::size_t i = 0; i < rows.size(); i += step) {
    for (const std::size_t method : {fe, fam}) {
      const BenchmarkFound& found = rows[i]->found[method];
      const double x = rows[i]->point.parameter;
      if (found.values.empty()) {
        panel.failure({x, y.low}, method_colours[method]);
        continue;
      }
      const Point p = panel.at({x, found.values[view.component]});
      if (method == fe) square(svg, p, method_colours[method]);
      else triangle(svg, p, method_colours[method]);
    }
  }
}

// Beside the end of a line; above its start where it ends at zero, as all lines of its panel then do.
Point name_place(const std::vector<Point>& points, const Axis& y) {
  const double range = y.high - y.low;
  if (std::abs(points.back().y) > 0.02 * range) return points.back();
  return {points.front().x + 0.005 * (points.back().x - points.front().x), points.front().y + 0.06 * range};
}

std::string history_picture(const BenchmarkResult& result, const std::vector<View>& views) {
  constexpr double width = 400, height = 330, gap = 130, top = 92;
  const double names = 20 + 8 * static_cast<double>(views[0].families[0].second.size());
  Svg svg(std::max(700.0, 80 + static_cast<double>(views.size()) * (width + gap) - gap + names + 20), top + height + 50,
          result.benchmark.title, result.benchmark.title);
  draw_key(svg, result);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const View& view = views[v];
    const Axis y = y_axis(result, view);
    Panel panel(svg, {80 + static_cast<double>(v) * (width + gap), top}, width, height, view.x, y);
    panel.frame();
    for (const auto& [family, name] : view.families) {
      for (const BenchmarkLine& line : result.lines) {
        if (line.family != family) continue;
        std::vector<Point> points;
        for (const auto& sample : line.samples) points.push_back({sample[0], sample[view.component + 1]});
        panel.curve(points, {colour::black, 1.4, ""});
        if (!name.empty()) panel.name(name_place(points, y), name, colour::black);
      }
    }
    draw_marks(svg, panel, view, y, result);
    panel.place_names();
  }
  return svg.str();
}

Axis linear(const std::string& label, double low, double high) {
  return {label, low, high, false};
}

using Families = std::vector<std::pair<std::string, std::string>>;

// Two components of the same families, side by side.
std::vector<View> two(const Families& families, const Axis& x, const std::string& first, const std::string& second,
                      std::size_t second_component = 1) {
  return {View{families, 0, x, first}, View{families, second_component, x, second}};
}

std::vector<View> views_of(const std::string& key) {
  const Families tip = {{"tip", ""}};
  if (key == "rollup") {
    return two(tip, linear("M / M_max", 0, 1.02), "tip towards the clamp, length units", "tip across, length units");
  }
  if (key == "elastica") {
    return two(tip, linear("F L²/EI", 0, 10.5), "tip towards the clamp, over L", "tip across, over L");
  }
  if (key == "thick") {
    return two(tip, linear("F / 6.25e7 N", 0, 1.05), "tip towards the clamp, mm", "tip across, mm");
  }
  if (key == "heavy") {
    return two({{"fixed", "fixed"}, {"follower", "follower"}}, linear("q L³/EI", 0, 26), "tip x / L", "tip y / L");
  }
  if (key == "helix") {
    return two(tip, linear("λ", 0, 1.02), "u1 of the tip, length units", "u3 of the tip, length units", 2);
  }
  if (key == "princeton") {
    return two({{"4.448", "4.448 N"}, {"8.896", "8.896 N"}, {"13.345", "13.345 N"}},
               linear("angle of the force from the stiff direction, deg", 0, 90), "tip in the stiff direction, mm",
               "tip in the weak direction, mm");
  }
  const bool pazy = key == "pazy";
  const std::string deflection = "tip deflection, % of the semispan";
  const Axis load = linear("P, kN", 0, 132);
  View left{{{pazy ? "0" : "axial", ""}}, 0, load, pazy ? deflection : "axial shortening, cm"};
  View right{{{pazy ? "1" : "transverse", ""}}, 0, load, pazy ? deflection : "transverse deflection, cm"};
  if (pazy) left.x = linear("tip mass, kg (without skin)", 0, 3.1);
  if (pazy) right.x = linear("tip mass, kg (with skin)", 0, 3.1);
  return {left, right};
}

std::string picture_of(const BenchmarkResult& result) {
  const std::string& key = result.benchmark.key;
  if (key == "bend45") return bend45_picture(result);
  if (key == "critical") return critical_picture(result);
  return history_picture(result, views_of(key));
}

}  // namespace

std::map<std::string, std::string> benchmark_pictures(const std::vector<BenchmarkResult>& results) {
  std::map<std::string, std::string> files;
  for (const BenchmarkResult& result : results) {
    files[result.benchmark.key + ".svg"] = picture_of(result);
    if (result.benchmark.key == "follower") files["follower_shapes.svg"] = shapes_picture(result);
  }
  return files;
}

}  // namespace studies
