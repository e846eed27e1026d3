// Panels with axes on an Svg: linear or logarithmic, units in the labels, names beside the curves.
#pragma once

#include "studies/report/svg.h"

namespace studies {

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
  // Names a curve near one of its points. place_names() puts all names where they touch neither a curve, a dot, a
  // cross, a tick, nor each other, as near as that goes; one that ends far from its point gets a thin line to it.
  void name(Point data, const std::string& text, const std::string& colour);
  void place_names();

  Point at(Point data) const;

 private:
  struct Name {
    Point at;
    std::string text, colour;
  };

  // A name's place, in pixels.
  struct Box {
    double x, y, width, height;
    double gap_to(Point p) const;
    bool overlaps(const Box& other) const;
  };
  double cost_of(const Box& box, const std::vector<Box>& taken) const;

  Svg& svg_;
  Point corner_;
  double width_, height_;
  Axis x_, y_;
  std::vector<Name> names_;
  std::vector<Point> drawn_;  // pixels that names keep clear of, at most a few apart
};

// The same scale on both axes: widens the ranges so that they fill width x height.
void equal_scale(Axis& x, Axis& y, double width, double height);

// Round tick values within an axis.
std::vector<double> ticks(const Axis& axis);

}  // namespace studies
