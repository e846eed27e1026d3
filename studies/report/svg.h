// A small SVG writer: deterministic text, coordinates in pixels rounded to 0.01.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace studies {

struct Point {
  double x, y;
};

struct Stroke {
  std::string colour = "#222";
  double width = 1.5;
  std::string dash;  // SVG dash array; empty: a full line
};

enum class Anchor { start, middle, end };

class Svg {
 public:
  Svg(double width, double height);

  void line(Point from, Point to, const Stroke& stroke);
  void polyline(const std::vector<Point>& points, const Stroke& stroke);
  void polygon(const std::vector<Point>& points, const std::string& fill);
  void circle(Point centre, double radius, const std::string& fill);
  void cross(Point centre, double radius, const Stroke& stroke);  // a failure
  void rectangle(Point corner, double width, double height, const std::string& fill);
  void text(Point at, const std::string& text, Anchor anchor = Anchor::start, double size = 12,
            const std::string& colour = "#222", double rotation_deg = 0);

  std::string str() const;

 private:
  double width_, height_;
  std::string body_;
};

}  // namespace studies
