#include "studies/report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr double name_gap_px = 13;

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
}

void Panel::dots(const std::vector<Point>& data, const std::string& fill, double radius) {
  for (const Point& p : data) svg_.circle(at(p), radius, fill);
}

void Panel::failure(Point data, const std::string& colour) {
  svg_.cross(at(data), 4, {colour, 1.8, ""});
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
  std::stable_sort(names_.begin(), names_.end(), [](const Name& a, const Name& b) { return a.at.y < b.at.y; });
  for (std::size_t i = 0; i < names_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool beside = std::abs(names_[i].at.x - names_[j].at.x) < 8.0 * static_cast<double>(names_[j].text.size());
      const double lowest = names_[j].at.y + name_gap_px;
      if (beside && names_[i].at.y < lowest) names_[i].at.y = lowest;
    }
    svg_.text({names_[i].at.x + 6, names_[i].at.y + 4}, names_[i].text, Anchor::start, 12, names_[i].colour);
  }
  names_.clear();
}

}  // namespace studies
