#include "studies/batch/data.h"
#include "studies/report/svg.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Rods a second along x, a group of lines for each case, a line for each way.
class RatesPicture {
 public:
  explicit RatesPicture(const BatchData& data)
      : data_(data),
        svg_(880, foot_of(data.size()) + 50, "Rods a second on one core",
             "A dot for each way to solve the rows of a case, on a logarithmic axis of rods a second, from left to "
             "right: the farther right the faster. A group for each case; in each from above: arcs given, "
             "with an error estimate, arcs chosen, and a Solver that takes one row after the other. Look at how far "
             "the last lies behind the first.",
             "medians; from above in each group: as named in the first") {
    double least = 1e5, largest = 1e6;
    for (const BatchOutcome& o : data) {
      for (const Timing& timing : o.times) {
        least = std::min(least, o.rods_per_s(timing));
        largest = std::max(largest, o.rods_per_s(timing));
      }
    }
    low_ = std::floor(std::log10(least));
    high_ = std::ceil(std::log10(largest));
  }

  std::string draw() {
    axis();
    for (std::size_t i = 0; i < data_.size(); ++i) group(data_[i], i);
    return svg_.str();
  }

 private:
  static constexpr double left = 250, right = 830, top = 66, line = 16, gap = 14;
  static constexpr double group_height = static_cast<double>(batch_way_count) * line + gap;
  static double foot_of(std::size_t groups) { return top + static_cast<double>(groups) * group_height; }

  double x_of(double rods_per_s) const {
    return left + (right - left) * (std::log10(rods_per_s) - low_) / (high_ - low_);
  }

  void axis() {
    const double foot = foot_of(data_.size());
    for (double power = low_; power <= high_; ++power) {
      const double x = x_of(std::pow(10, power));
      svg_.line({x, top - 6}, {x, foot}, {colour::faint, 1, ""});
      svg_.text({x, foot + 16},
                power < 6 ? fmt::format("{:g} thousand", std::pow(10, power - 3))
                          : fmt::format("{:g} million", std::pow(10, power - 6)),
                Anchor::middle, 11);
    }
    svg_.line({left, foot}, {right, foot}, {colour::black, 1, ""});
    svg_.text({(left + right) / 2, foot + 36}, "rods a second and core", Anchor::middle);
  }

  void group(const BatchOutcome& o, std::size_t index) {
    const double head = foot_of(index);
    if (index > 0) svg_.line({26, head - gap / 2 - 3}, {right, head - gap / 2 - 3}, {colour::faint, 1, ""});
    svg_.text({26, head + line}, o.rods.name);
    svg_.text({26, head + 2 * line},
              fmt::format("{} arc{}, {:.3g} % in lanes", o.arcs, o.arcs == 1 ? "" : "s",
                          100.0 * static_cast<double>(o.in_lanes) / static_cast<double>(o.rows)),
              Anchor::start, 11, "#666");
    for (std::size_t way = 0; way < batch_way_count; ++way) {
      const double rate = o.rods_per_s(o.times[way]);
      const Point at{x_of(rate), head + (static_cast<double>(way) + 0.5) * line};
      const bool to_the_left = at.x > (left + right) / 2;
      const std::string text = rate_text(rate) + (index == 0 ? ", " + batch_ways[way].name : "");
      svg_.circle(at, 4.5, batch_ways[way].colour);
      svg_.name({at.x + (to_the_left ? -10 : 10), at.y + 4.5}, text, batch_ways[way].colour,
                to_the_left ? Anchor::end : Anchor::start);
    }
  }

  const BatchData& data_;
  Svg svg_;
  double low_, high_;
};

}  // namespace

std::string batch_picture(const BatchData& data) {
  return RatesPicture(data).draw();
}

}  // namespace studies
