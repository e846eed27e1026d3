#include "studies/methods/registry.h"
#include "studies/segmentation/ablation.h"
#include "studies/segmentation/printed_trend.h"

#include <algorithm>

namespace studies {
namespace {

struct Series {
  std::string row, name, colour, dash;
  int named_at;  // arcs
};

void draw(Panel& panel, const AblationData& data, const std::vector<Series>& series, double AblationPoint::*error) {
  for (const Series& s : series) {
    std::vector<Point> points;
    for (const AblationPoint& p : data.row(s.row).points) {
      const std::string text = one_digit(p.*error);  // drawn as printed
      if (text != "–") points.push_back({static_cast<double>(p.arcs), std::stod(text)});
    }
    if (points.empty()) continue;
    panel.curve(points, {s.colour, 1.8, s.dash});
    const auto at = std::find_if(points.begin(), points.end(), [&](const Point& p) { return p.x >= s.named_at; });
    panel.name(at == points.end() ? points.back() : *at, s.name, s.colour);
  }
  panel.place_names();
}

}  // namespace

std::string ablation_picture(const AblationData& data) {
  const std::string published = method_row("fam_published").style.colour;
  const Series sound{"sound: double, root of dPi/dtheta", "sound", published, "", 5000};
  Svg svg(
      880, 1230, "FAM published, weakened on purpose: tip error over the number of arcs, case P4 (our loads)",
      "Three charts of the tip error in mm over the number of arcs from 1 to 5000, both logarithmic; the sound law is "
      "a straight falling line in the first two. First, weak arithmetic: single precision, a multiplied-out "
      "functional, a minimiser, forces not turned. Second, searches stopped at an absolute tolerance: golden section "
      "and bisection leave the sound line and turn up, a secant root does not. Third, the same against finite "
      "elements, beside what the paper prints. Look at which curves turn up, and how high.",
      "one digit each, as in the tables; black, dashed: what the paper prints in words for its own loads");
  const Axis arcs{"number of arcs N", 1, 5000, true}, error{"tip error, mm", 1e-8, 100, true};
  Panel weak(svg, {80, 86}, 610, 290, arcs, error);
  weak.frame("Weak arithmetic, against the exact Kirchhoff rod");
  draw(weak, data,
       {sound,
        {"single precision", "single precision", colour::purple, "", 5000},
        {"single, golden, expanded Pi", "single, golden, expanded Π", colour::green, "", 5000},
        {"GSL Brent", "GSL Brent", colour::black, "5 3", 5000},
        {"force not turned in the arc", "force not turned in the arc", colour::sky, "", 50},
        {"force not turned to the next arc", "force not turned to the next arc", colour::grey, "", 100}},
       &AblationPoint::error_mm);
  Panel tolerance(svg, {80, 476}, 610, 290, arcs, error);
  tolerance.frame("Search stopped at an absolute tolerance, against the exact Kirchhoff rod");
  Series golden_3{"golden section 3e-03", "golden section, 3e-3 rad", colour::purple, "", 2000};
  const Series golden{"golden section 1e-03", "golden section, 1e-3", colour::blue, "", 5000},
      bisection{"bisection 1e-03", "bisection, 1e-3", colour::black, "5 3", 5000};
  draw(tolerance, data,
       {sound,
        golden_3,
        golden,
        bisection,
        {"golden section 1e-05", "golden section, 1e-5", colour::sky, "", 5000},
        {"secant root 1e-03", "secant root, 1e-3", colour::green, "2 3", 1000}},
       &AblationPoint::error_mm);
  Panel fe(svg, {80, 866}, 610, 290, arcs, {"tip error, mm", 0.01, 100, true});
  fe.frame("The same, against finite elements with shear and stretch");
  draw_printed_trend(svg, fe);
  golden_3.named_at = 5000;
  draw(fe, data, {sound, golden_3, golden, bisection}, &AblationPoint::fe_mm);
  return svg.str();
}

}  // namespace studies
