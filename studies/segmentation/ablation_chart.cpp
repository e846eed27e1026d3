#include "studies/segmentation/ablation.h"
#include "studies/segmentation/printed_trend.h"

namespace studies {
namespace {

struct Series {
  std::string row, name, colour, dash;
};

void draw(Panel& panel, const AblationData& data, const std::vector<Series>& series, double AblationPoint::*error) {
  for (const Series& s : series) {
    std::vector<Point> points;
    for (const AblationPoint& p : data.row(s.row).points) {
      const std::string text = one_digit(p.*error);  // drawn as printed
      if (text != "–") points.push_back({static_cast<double>(p.arcs), std::stod(text)});
    }
    panel.curve(points, {s.colour, 1.6, s.dash});
    panel.name(points.back(), s.name, s.colour);
  }
  panel.place_names();
}

}  // namespace

std::string ablation_picture(const AblationData& data) {
  const std::string sound = "sound: double, root of dPi/dtheta";
  Svg svg(1130, 1010, "Case P4 (our loads): the published law, weakened on purpose. One digit each, as printed",
          "Case P4 (our loads): the published law, weakened on purpose. One digit each, as printed");
  const Axis arcs{"number of arcs N", 1, 5000, true}, error{"tip error, mm", 1e-8, 100, true};
  Panel alone(svg, {80, 66}, 340, 380, arcs, error), combined(svg, {640, 66}, 340, 380, arcs, error);
  alone.frame("Each alone, against the exact Kirchhoff rod");
  draw(alone, data,
       {{sound, "sound", colour::black, ""},
        {"single precision", "single precision", colour::orange, ""},
        {"GSL Brent", "GSL Brent", colour::green, ""},
        {"radius unknown, golden section", "radius, golden section", colour::yellow, "4 3"},
        {"force not turned in the arc", "force not turned in arc", colour::sky, ""},
        {"force not turned to the next arc", "not turned to next arc", colour::purple, ""}},
       &AblationPoint::error_mm);
  combined.frame("Combined, against the exact Kirchhoff rod");
  draw(combined, data,
       {{sound, "sound", colour::black, ""},
        {"single, unsafe", "single, unsafe", colour::orange, ""},
        {"single, golden", "single, golden", colour::sky, ""},
        {"single, golden, expanded Pi", "single, expanded Π", colour::green, ""},
        {"single, unsafe, golden 1e-03", "single, golden 1e-3", colour::purple, ""}},
       &AblationPoint::error_mm);
  Panel tolerance(svg, {80, 560}, 340, 380, arcs, error);
  Panel fe(svg, {640, 560}, 340, 380, arcs, {"tip error, mm", 0.01, 100, true});
  tolerance.frame("Absolute tolerances, against the exact Kirchhoff rod");
  draw(tolerance, data,
       {{sound, "sound", colour::black, ""},
        {"golden section 1e-02", "golden 1e-2 rad", colour::orange, ""},
        {"golden section 3e-03", "golden 3e-3", colour::purple, ""},
        {"golden section 1e-03", "golden 1e-3", colour::blue, ""},
        {"bisection 1e-03", "bisection 1e-3", colour::blue, "4 3"},
        {"golden section 1e-05", "golden 1e-5", colour::sky, ""},
        {"golden section 1e-07", "golden 1e-7", colour::green, ""},
        {"secant root 1e-03", "secant root 1e-3", colour::yellow, "4 3"}},
       &AblationPoint::error_mm);
  fe.frame("The same, against finite elements with shear");
  draw(fe, data,
       {{sound, "sound", colour::black, ""},
        {"golden section 1e-02", "golden 1e-2 rad", colour::orange, ""},
        {"golden section 3e-03", "golden 3e-3", colour::purple, ""},
        {"golden section 1e-03", "golden 1e-3", colour::blue, ""},
        {"bisection 1e-03", "bisection 1e-3", colour::blue, "4 3"}},
       &AblationPoint::fe_mm);
  draw_printed_trend(svg, fe);
  return svg.str();
}

}  // namespace studies
