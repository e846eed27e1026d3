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
  // The title stands at the top, above a grey subtitle of what the marks mean; the description tells the picture to
  // who cannot see it.
  Svg(double width, double height, const std::string& title, const std::string& description,
      const std::string& subtitle = "");

  void line(Point from, Point to, const Stroke& stroke);
  void polyline(const std::vector<Point>& points, const Stroke& stroke);
  void polygon(const std::vector<Point>& points, const std::string& fill);
  void circle(Point centre, double radius, const std::string& fill);
  void cross(Point centre, double radius, const Stroke& stroke);  // a failure
  void rectangle(Point corner, double width, double height, const std::string& fill);
  void text(Point at, const std::string& text, Anchor anchor = Anchor::start, double size = 12,
            const std::string& colour = "#222", double rotation_deg = 0);
  // The same on a white halo, for names among curves.
  void name(Point at, const std::string& text, const std::string& colour);

  double width() const { return width_; }
  double height() const { return height_; }

  std::string str() const;

 private:
  double width_, height_;
  std::string title_, description_;
  std::string body_;
};

// Width in pixels that a text takes, estimated: that of DejaVu Sans, the widest of the fonts named.
double text_width(const std::string& text, double size);

}  // namespace studies
