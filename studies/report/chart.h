// Panels with axes on an Svg: linear or logarithmic, units in the labels, names beside the curves.
#pragma once

#include "studies/report/svg.h"

namespace studies {

// Colours that differ in lightness too, so that they can be told apart in grey (after Okabe and Ito 2008).
namespace colour {
inline const std::string black = "#1a1a1a", blue = "#0072b2", orange = "#d55e00", sky = "#56b4e9", green = "#009e73",
                         purple = "#9a3d7a", yellow = "#c79a00", grey = "#8a8a8a", faint = "#e4e4e4", band = "#f0f0f0";
}

struct Axis {
  std::string label;  // with its unit
  double low = 0;
  double high = 1;
  bool logarithmic = false;
};

// A rectangle of the picture with its two axes; takes points in data coordinates.
class Panel {
 public:
  Panel(Svg& svg, Point corner, double width, double height, Axis x, Axis y);

  void frame(const std::string& title = "");  // axes, ticks, grid, labels
  void curve(const std::vector<Point>& data, const Stroke& stroke);
  void dots(const std::vector<Point>& data, const std::string& fill, double radius = 3);
  void failure(Point data, const std::string& colour);  // a cross
  // Grey band from the lower edge (or low_y) up to high_y: what the reference itself does not resolve.
  void band(double low_y, double high_y, const std::string& text);
  // Names a curve beside its point; names that would overlap move apart when the panel is closed.
  void name(Point data, const std::string& text, const std::string& colour);
  void place_names();

  Point at(Point data) const;

 private:
  struct Name {
    Point at;
    std::string text, colour;
  };

  Svg& svg_;
  Point corner_;
  double width_, height_;
  Axis x_, y_;
  std::vector<Name> names_;
};

// The same scale on both axes: widens the ranges so that they fill width x height.
void equal_scale(Axis& x, Axis& y, double width, double height);

// Round tick values within an axis.
std::vector<double> ticks(const Axis& axis);

}  // namespace studies
