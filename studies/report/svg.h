// A small SVG writer: deterministic text, coordinates in pixels rounded to 0.01.
#pragma once

#include <string>
#include <vector>

namespace studies {

// Colours that differ in lightness too, so that they can be told apart in grey (after Okabe and Ito 2008).
namespace colour {
inline const std::string black = "#1a1a1a", blue = "#0072b2", orange = "#d55e00", sky = "#56b4e9", green = "#009e73",
                         purple = "#9a3d7a", yellow = "#c79a00", grey = "#8a8a8a", faint = "#e4e4e4", band = "#f0f0f0";
}

struct Style {
  std::string colour = colour::black;
  std::string dash;  // SVG dash array; empty: a full line
};

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
  void name(Point at, const std::string& text, const std::string& colour, Anchor anchor = Anchor::start);

  double width() const { return width_; }

  std::string str() const;

 private:
  double width_, height_;
  std::string title_, description_;
  std::string body_;
};

// Width in pixels that a text takes, estimated: that of DejaVu Sans, the widest of the fonts named.
double text_width(const std::string& text, double size);

}  // namespace studies
