#include "studies/report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Where a name of this width may stand from its point: beside it, above, below, and farther and farther away.
std::vector<Point> offsets_of(double width) {
  std::vector<Point> offsets;
  for (const double up : {4.0, -8.0, 16.0, -20.0, 28.0, -32.0, 44.0, -48.0, 60.0, -64.0, 90.0, -94.0, 130.0, -134.0}) {
    for (const double right : {7.0, -width - 7, -width / 2, 30.0, -width - 30, 60.0, -width - 60}) {
      offsets.push_back({right, up});
    }
  }
  return offsets;
}

double fraction(const Axis& axis, double value) {
  if (!axis.logarithmic) return (value - axis.low) / (axis.high - axis.low);
  return std::log(std::max(value, 1e-300) / axis.low) / std::log(axis.high / axis.low);
}

std::string tick_text(const Axis& axis, double value) {
  if (!axis.logarithmic || (value >= 0.01 && value < 20000)) return fmt::format("{:g}", value);
  return fmt::format("1e{}", static_cast<int>(std::lround(std::log10(value))));
}

}  // namespace

std::vector<double> ticks(const Axis& axis) {
  std::vector<double> values;
  if (axis.logarithmic) {
    const int first = static_cast<int>(std::ceil(std::log10(axis.low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(axis.high) + 1e-9));
    const int step = std::max(1, (last - first + 7) / 8);
    for (int power = first; power <= last; power += step) values.push_back(std::pow(10, power));
    if (values.size() > 1) return values;
    values.clear();
    for (int power = first - 1; power <= last; ++power) {
      for (const int digit : {1, 2, 5}) {
        const double value = digit * std::pow(10, power);
        if (value >= axis.low * (1 - 1e-9) && value <= axis.high * (1 + 1e-9)) values.push_back(value);
      }
    }
    return values;
  }
  const double rough = (axis.high - axis.low) / 5;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
  for (double k = std::ceil(axis.low / step - 1e-9); k * step <= axis.high + 1e-9 * step; ++k) {
    values.push_back(k == 0 ? 0 : k * step);
  }
  return values;
}

void equal_scale(Axis& x, Axis& y, double width, double height) {
  const double scale = std::max((x.high - x.low) / width, (y.high - y.low) / height);
  const auto widen = [scale](Axis& axis, double pixels) {
    const double more = (scale * pixels - (axis.high - axis.low)) / 2;
    axis.low -= more;
    axis.high += more;
  };
  widen(x, width);
  widen(y, height);
}

Panel::Panel(Svg& svg, Point corner, double width, double height, Axis x, Axis y)
    : svg_(svg), corner_(corner), width_(width), height_(height), x_(std::move(x)), y_(std::move(y)) {}

Point Panel::at(Point data) const {
  return {corner_.x + width_ * fraction(x_, data.x), corner_.y + height_ * (1 - fraction(y_, data.y))};
}

void Panel::frame(const std::string& title) {
  const Stroke grid{colour::faint, 1, ""};
  for (const double value : ticks(x_)) {
    const double px = at({value, y_.low}).x;
    svg_.line({px, corner_.y}, {px, corner_.y + height_}, grid);
    svg_.text({px, corner_.y + height_ + 16}, tick_text(x_, value), Anchor::middle, 11);
  }
  for (const double value : ticks(y_)) {
    const double py = at({x_.low, value}).y;
    svg_.line({corner_.x, py}, {corner_.x + width_, py}, grid);
    svg_.text({corner_.x - 6, py + 4}, tick_text(y_, value), Anchor::end, 11);
  }
  const Stroke axis{colour::black, 1, ""};
  svg_.line({corner_.x, corner_.y}, {corner_.x, corner_.y + height_}, axis);
  svg_.line({corner_.x, corner_.y + height_}, {corner_.x + width_, corner_.y + height_}, axis);
  svg_.text({corner_.x + width_ / 2, corner_.y + height_ + 34}, x_.label, Anchor::middle);
  svg_.text({corner_.x - 44, corner_.y + height_ / 2}, y_.label, Anchor::middle, 12, colour::black, -90);
  if (!title.empty()) svg_.text({corner_.x, corner_.y - 8}, title, Anchor::start, 13);
}

void Panel::curve(const std::vector<Point>& data, const Stroke& stroke) {
  std::vector<Point> points(data.size());
  std::transform(data.begin(), data.end(), points.begin(), [this](const Point& p) { return at(p); });
  svg_.polyline(points, stroke);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double dx = points[i + 1].x - points[i].x, dy = points[i + 1].y - points[i].y;
    const int pieces = 1 + static_cast<int>(std::hypot(dx, dy) / 4);
    for (int k = 0; k <= pieces; ++k) drawn_.push_back({points[i].x + dx * k / pieces, points[i].y + dy * k / pieces});
  }
}

void Panel::dots(const std::vector<Point>& data, const std::string& fill, double radius) {
  for (const Point& p : data) {
    svg_.circle(at(p), radius, fill);
    drawn_.push_back(at(p));
  }
}

void Panel::failure(Point data, const std::string& colour) {
  svg_.cross(at(data), 4, {colour, 1.8, ""});
  drawn_.push_back(at(data));
}

void Panel::band(double low_y, double high_y, const std::string& text) {
  const double top = at({x_.low, std::min(high_y, y_.high)}).y;
  const double bottom = at({x_.low, std::max(low_y, y_.low)}).y;
  svg_.rectangle({corner_.x, top}, width_, bottom - top, colour::band);
  svg_.text({corner_.x + 6, top + 13}, text, Anchor::start, 11, colour::grey);
}

void Panel::name(Point data, const std::string& text, const std::string& colour) {
  names_.push_back({at(data), text, colour});
}

void Panel::place_names() {
  std::vector<Box> taken;
  for (const Name& name : names_) {
    const double width = text_width(name.text, 12);
    Box best{};
    double least = INFINITY;
    for (const Point& offset : offsets_of(width)) {
      const Box box{name.at.x + offset.x, name.at.y + offset.y - 10, width, 14};
      const double cost = cost_of(box, taken) + std::hypot(box.gap_to(name.at), 0.2 * offset.y);
      if (cost < least) least = cost, best = box;
    }
    taken.push_back(best);
    if (best.gap_to(name.at) > 18) {
      const Point end{std::clamp(name.at.x, best.x, best.x + best.width),
                      name.at.y < best.y ? best.y + 1 : best.y + best.height};
      svg_.line(name.at, end, {name.colour, 0.7, ""});
    }
    svg_.name({best.x, best.y + 10.5}, name.text, name.colour);
  }
  names_.clear();
}

double Panel::Box::gap_to(Point p) const {
  return std::hypot(std::max({x - p.x, p.x - x - width, 0.0}), std::max({y - p.y, p.y - y - height, 0.0}));
}

bool Panel::Box::overlaps(const Box& o) const {
  return x < o.x + o.width + 3 && o.x < x + width + 3 && y < o.y + o.height && o.y < y + height;
}

double Panel::cost_of(const Box& box, const std::vector<Box>& taken) const {
  double cost = 0;
  for (const Point& p : drawn_) cost += box.gap_to(p) < 2 ? 12 : 0;
  for (const Box& other : taken) cost += box.overlaps(other) ? 1000 : 0;
  const bool on_ticks = box.x < corner_.x + 3 || box.y + box.height > corner_.y + height_ - 2;
  const bool off_sheet = box.x + box.width > svg_.width() - 4;
  const bool above = box.y < corner_.y - 2;
  return cost + (on_ticks ? 400 : 0) + (off_sheet ? 1e4 : 0) + (above ? 400 : 0);
}

}  // namespace studies
