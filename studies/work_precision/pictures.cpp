#include "studies/report/chart.h"
#include "studies/work_precision/data.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace studies {
namespace {

const Axis time_axis{"median time of a solve, µs", 0.01, 1e6, true};
const Axis error_axis{"tip error / L", 1e-14, 10, true};
constexpr double failure_error = 5;  // where crosses stand: the upper edge

struct Look {
  const char* series;
  const char* name;
  std::string colour;
  const char* dash;
};
// A series that is not listed is drawn black.
const std::vector<Look> looks = {{"fam published", "FAM published", colour::sky, ""},
                                 {"fam midpoint", "FAM midpoint", colour::green, ""},
                                 {"fam fourth_order", "FAM fourth order", colour::blue, "5 3"},
                                 {"fam sixth_order", "FAM sixth order", colour::blue, ""},
                                 {"fam automatic", "FAM automatic", colour::blue, "2 3"},
                                 {"rk4 shooting", "RK4 shooting", colour::orange, ""},
                                 {"exact reference", "exact reference", colour::grey, ""},
                                 {"closed form", "closed form", colour::black, ""},
                                 {"fe linear whole load", "", colour::yellow, "5 3"},
                                 {"fe linear adaptive", "FE linear", colour::yellow, ""},
                                 {"fe quadratic whole load", "", colour::purple, "5 3"},
                                 {"fe quadratic adaptive", "FE quadratic", colour::purple, ""}};

Look look_of(const std::string& series) {
  const auto found = std::find_if(looks.begin(), looks.end(), [&](const Look& look) { return series == look.series; });
  return found == looks.end() ? Look{series.c_str(), series.c_str(), colour::black, ""} : *found;
}

// A mark of a picture: one resolution, on one scene or over several.
struct Mark {
  double time_us;
  double error;  // the largest where it converged; NaN: nowhere
  std::string label;
  std::size_t failed, scenes;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

// Median time and largest error over the scenes, for each resolution that was tried and timed on all of them.
std::vector<Mark> marks_of(const WorkData& data, const std::vector<std::string>& scenes, const std::string& series,
                           const std::string& model) {
  std::vector<Mark> marks;
  for (const std::string& label : data.labels(series, model, scenes)) {
    std::vector<double> times;
    Mark mark{0, std::numeric_limits<double>::quiet_NaN(), label, 0, scenes.size()};
    for (const std::string& scene : scenes) {
      for (const WorkPoint* p : data.of(scene, series, model)) {
        if (p->label != label || !p->time) continue;
        times.push_back(p->time->median_us);
        if (p->converged()) mark.error = std::fmax(mark.error, std::max(p->error, work_error_floor));
        else ++mark.failed;
      }
    }
    if (times.size() != scenes.size()) continue;
    mark.time_us = median(times);
    marks.push_back(mark);
  }
  return marks;
}

Point place(const Mark& mark) {
  const double error = std::isfinite(mark.error) ? std::min(mark.error, failure_error) : failure_error;
  return {std::clamp(mark.time_us, time_axis.low, time_axis.high), error};
}

void draw_series(Panel& panel, const std::vector<Mark>& marks, const Look& look) {
  std::vector<Point> points;
  for (const Mark& mark : marks) {
    if (std::isfinite(mark.error)) points.push_back(place(mark));
    if (mark.failed > 0) panel.failure({place(mark).x, failure_error}, look.colour);
  }
  if (points.empty()) {
    if (!marks.empty()) panel.name({place(marks.back()).x, failure_error}, look.name, look.colour);
    return;
  }
  const std::size_t scenes = marks.front().scenes;
  const bool partly = marks.back().failed > 0 && scenes > 1;
  const std::string share =
      partly ? " (" + std::to_string(scenes - marks.back().failed) + " of " + std::to_string(scenes) + ")" : "";
  panel.curve(points, {look.colour, 1.4, look.dash});
  panel.dots(points, look.colour, 2.4);
  if (look.name[0] != 0) panel.name(points.back(), look.name + share, look.colour);
}

// Marks that no other is both faster and more accurate than, by rising time.
std::vector<Mark> pareto_front(std::vector<Mark> marks) {
  std::sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.time_us < b.time_us; });
  std::vector<Mark> front;
  for (const Mark& mark : marks) {
    if (mark.failed == 0 && (front.empty() || mark.error < front.back().error)) front.push_back(mark);
  }
  return front;
}

void draw_front(Svg& svg, Panel& panel, const std::vector<Mark>& front) {
  if (front.empty()) return;
  std::vector<Point> stairs;
  for (const Mark& mark : front) {
    if (!stairs.empty()) stairs.push_back({place(mark).x, stairs.back().y});
    stairs.push_back(place(mark));
  }
  panel.curve(stairs, {"#b8b8b8", 4, ""});
  double last_y = -1e9;
  for (const Mark& mark : front) {
    const Point at = panel.at(place(mark));
    if (at.y - last_y < 24) continue;  // few labels
    svg.text({at.x - 6, at.y + 12}, mark.label, Anchor::end, 10, colour::black);
    last_y = at.y;
  }
}

void draw_panel(Svg& svg, Point corner, const WorkData& data, const std::vector<std::string>& scenes,
                const std::string& model, const std::string& title) {
  Panel panel(svg, corner, 430, 400, time_axis, error_axis);
  double reference = work_error_floor;
  std::vector<Mark> all;
  for (const WorkPoint& p : data.points) {
    const bool here = std::find(scenes.begin(), scenes.end(), p.scene) != scenes.end() && p.model == model;
    if (here) reference = std::max(reference, p.reference_error);
  }
  panel.band(error_axis.low, reference, "");
  panel.frame(title);
  for (const std::string& series : data.series(model)) {
    const std::vector<Mark> marks = marks_of(data, scenes, series, model);
    all.insert(all.end(), marks.begin(), marks.end());
  }
  draw_front(svg, panel, pareto_front(all));
  for (const std::string& series : data.series(model)) {
    draw_series(panel, marks_of(data, scenes, series, model), look_of(series));
  }
  panel.place_names();
}

const char* legend =
    "Broad grey line: Pareto front; labels: arcs, steps, elements or tolerance. × failed (on a scene at least; the "
    "dot: on "
    "the others). Shaded: the exact rod's own error, 1e-12 at least. Dashed FE: whole load first.";

bool timed(const WorkData& data, const std::string& scene) {
  return std::any_of(data.points.begin(), data.points.end(),
                     [&](const WorkPoint& p) { return p.scene == scene && p.time; });
}

std::string scene_picture(const WorkData& data, const WorkGroup& group, const std::string& scene) {
  const std::string title = group.scenes.size() == 1 ? group.name : group.name + ", " + scene.substr(0, 2);
  Svg svg(1220, 540, "Error over time: " + title, "Error over time: " + title);
  draw_panel(svg, {80, 66}, data, {scene}, "Kirchhoff", "Kirchhoff rods, against the exact Kirchhoff rod");
  draw_panel(svg, {670, 66}, data, {scene}, "Reissner", "Reissner rods, against the exact Reissner rod");
  svg.text({80, 530}, legend, Anchor::start, 11, colour::grey);
  return svg.str();
}

std::string overview_picture(const WorkData& data) {
  Svg svg(1220, 1050, "Error over time, 16 cases of Study I: median time, largest tip error",
          "Error over time, 16 cases of Study I: median time, largest tip error");
  for (int row = 0; row < 2; ++row) {
    const WorkGroup& group = data.groups[static_cast<std::size_t>(row)];
    for (int column = 0; column < 2; ++column) {
      const std::string& model = work_models[static_cast<std::size_t>(column)];
      draw_panel(svg, {80 + 590.0 * column, 66 + 500.0 * row}, data, group.scenes, model,
                 group.name + ", " + model + " rods");
    }
  }
  svg.text({80, 1040}, legend, Anchor::start, 11, colour::grey);
  return svg.str();
}

}  // namespace

std::map<std::string, std::string> work_precision_pictures(const WorkData& data) {
  std::map<std::string, std::string> files{{"timing_overview.svg", overview_picture(data)}};
  for (const WorkGroup& group : data.groups) {
    for (const std::string& scene : group.scenes) {
      if (timed(data, scene)) files["timing_" + scene + ".svg"] = scene_picture(data, group, scene);
    }
  }
  return files;
}

}  // namespace studies
