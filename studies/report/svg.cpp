#include "studies/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Two decimals, and never "-0.00".
std::string number(double value) {
  const double rounded = std::round(value * 100) / 100;
  return fmt::format("{:.2f}", rounded == 0 ? 0.0 : rounded);
}

std::string list(const std::vector<Point>& points) {
  std::string text;
  for (const Point& p : points) text += (text.empty() ? "" : " ") + number(p.x) + "," + number(p.y);
  return text;
}

std::string attributes(const Stroke& stroke) {
  std::string text = fmt::format("stroke=\"{}\" stroke-width=\"{}\"", stroke.colour, stroke.width);
  if (!stroke.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", stroke.dash);
  return text;
}

const char* anchor_text(Anchor anchor) {
  const char* anchors[] = {"start", "middle", "end"};
  return anchors[static_cast<int>(anchor)];
}

// In UTF-8; characters that XML 1.0 knows no way to write are shown as unknown ones.
std::string escaped(const std::string& text) {
  const std::string unknown = "\xEF\xBF\xBD";
  std::string safe;
  for (const char c : text) {
    const bool is_control = static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
    if (c == '&') safe += "&amp;";
    else if (c == '<') safe += "&lt;";
    else if (c == '>') safe += "&gt;";
    else if (is_control) safe += unknown;
    else safe += c;
    if (safe.ends_with("\xEF\xBF\xBE") || safe.ends_with("\xEF\xBF\xBF")) safe.replace(safe.size() - 3, 3, unknown);
  }
  return safe;
}

}  // namespace

Svg::Svg(double width, double height, const std::string& title, const std::string& description,
         const std::string& subtitle)
    : width_(width), height_(height), title_(title), description_(description) {
  text({26, 24}, title, Anchor::start, 15);
  if (!subtitle.empty()) text({26, 44}, subtitle, Anchor::start, 12, "#666");
}

double text_width(const std::string& text, double size) {
  const auto characters =
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
  return 0.6 * size * static_cast<double>(characters);
}

void Svg::line(Point from, Point to, const Stroke& stroke) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", number(from.x), number(from.y),
                       number(to.x), number(to.y), attributes(stroke));
}

void Svg::polyline(const std::vector<Point>& points, const Stroke& stroke) {
  body_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke-linejoin=\"round\" {}/>\n", list(points),
                       attributes(stroke));
}

void Svg::polygon(const std::vector<Point>& points, const std::string& fill) {
  body_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", list(points), fill);
}

void Svg::circle(Point centre, double radius, const std::string& fill) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", number(centre.x), number(centre.y),
                       number(radius), fill);
}

void Svg::cross(Point centre, double radius, const Stroke& stroke) {
  line({centre.x - radius, centre.y - radius}, {centre.x + radius, centre.y + radius}, stroke);
  line({centre.x - radius, centre.y + radius}, {centre.x + radius, centre.y - radius}, stroke);
}

void Svg::rectangle(Point corner, double width, double height, const std::string& fill) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", number(corner.x),
                       number(corner.y), number(width), number(height), fill);
}

void Svg::text(Point at, const std::string& text, Anchor anchor, double size, const std::string& colour,
               double rotation_deg) {
  std::string turn;
  if (rotation_deg != 0) {
    turn = fmt::format(" transform=\"rotate({} {} {})\"", number(rotation_deg), number(at.x), number(at.y));
  }
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>\n",
                       number(at.x), number(at.y), anchor_text(anchor), size, colour, turn, escaped(text));
}

void Svg::name(Point at, const std::string& text, const std::string& colour, Anchor anchor) {
  const std::string anchored = anchor == Anchor::start ? "" : fmt::format(" text-anchor=\"{}\"", anchor_text(anchor));
  body_ += fmt::format(
      "<text x=\"{}\" y=\"{}\"{} font-size=\"12\" fill=\"{}\" stroke=\"white\" stroke-width=\"3\" "
      "paint-order=\"stroke\">{}</text>\n",
      number(at.x), number(at.y), anchored, colour, escaped(text));
}

std::string Svg::str() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" role=\"img\">\n<title>{3}</title>\n<desc>{4}</desc>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n{2}</svg>\n",
      number(width_), number(height_), body_, escaped(title_), escaped(description_));
}

}  // namespace studies
