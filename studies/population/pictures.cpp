// Where the printed statistics lie among those of each mechanism: a picture for each statistic, and a matrix of all.
#include "studies/compare/data_file.h"
#include "studies/population/data.h"
#include "studies/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr double row_px = 17, first_row_px = 78;

struct PrintSpread {
  std::string mechanism;
  double low, quarter, median, three_quarters, high, below, above;
};

std::map<std::string, std::vector<PrintSpread>> spreads_in(const std::filesystem::path& folder) {
  std::map<std::string, std::vector<PrintSpread>> spreads;
  for (const DataRow& row : data_rows(folder / "distributions.csv")) {
    const auto number = [&](const char* column) { return std::stod(row.at(column)); };
    spreads[row.at("statistic")].push_back({row.at("mechanism"), number("p2.5_mm"), number("p25_mm"), number("p50_mm"),
                                            number("p75_mm"), number("p97.5_mm"), number("share_below_printed"),
                                            number("share_above_printed")});
  }
  return spreads;
}

// Millimetres to pixels: logarithmic, both signs where the statistic has one (linear below 0.05 mm).
class ErrorScale {
 public:
  explicit ErrorScale(bool is_signed) : is_signed_(is_signed) {}
  double at(double mm) const {
    constexpr double left_px = 300, width_px = 520, linear_mm = 0.05, most_mm = 30, least_mm = 0.003;
    if (is_signed_)
      return left_px + width_px * (0.5 + std::asinh(mm / linear_mm) / std::asinh(most_mm / linear_mm) / 2);
    return left_px + width_px * std::log(std::clamp(mm, least_mm, most_mm) / least_mm) / std::log(most_mm / least_mm);
  }
  std::vector<double> ticks() const {
    if (is_signed_) return {-10, -1, -0.1, 0, 0.1, 1, 10};
    return {0.01, 0.1, 1, 10};
  }

 private:
  bool is_signed_;
};

std::string spaced(const std::string& statistic) {
  std::string words = statistic;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string picture_of(std::size_t place, const std::vector<PrintSpread>& spreads, const Interval& taken) {
  const std::string title = spaced(statistic_name(place)) + ": what each mechanism gives";
  const double bottom = first_row_px + row_px * static_cast<double>(spreads.size());
  Svg svg(860, bottom + 50, title, "For each mechanism the spread of the statistic over all sets of loads.",
          "line: 95 % of the sets, bar: half of them, dot: median; orange: printed (a band: both readings)");
  const ErrorScale scale(is_mean(place));
  const double low = scale.at(taken.low), high = scale.at(taken.high);
  svg.rectangle({low, first_row_px - 12}, std::max(high - low, 0.5), bottom - first_row_px + 12, "#f6d5bd");
  for (const double tick : scale.ticks()) {
    svg.line({scale.at(tick), first_row_px - 12}, {scale.at(tick), bottom}, {colour::faint, 1, ""});
    svg.text({scale.at(tick), bottom + 16}, fmt::format("{:g}", tick), Anchor::middle, 11);
  }
  const double middle = (low + high) / 2;
  svg.line({middle, first_row_px - 12}, {middle, bottom}, {colour::orange, 1.6, ""});
  svg.text({560, bottom + 36}, "mm", Anchor::middle, 12);
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    const PrintSpread& s = spreads[i];
    const double y = first_row_px + row_px * static_cast<double>(i);
    svg.text({288, y + 4}, s.mechanism, Anchor::end, 11);
    svg.line({scale.at(s.low), y}, {scale.at(s.high), y}, {colour::grey, 1.2, ""});
    svg.line({scale.at(s.quarter), y}, {scale.at(s.three_quarters), y}, {colour::blue, 6, ""});
    svg.circle({scale.at(s.median), y}, 3.2, colour::black);
  }
  return svg.str();
}

// Of the sets, those on the rarer side of what is printed, the printed interval included.
double rarer_side(const PrintSpread& s) {
  return std::min(1 - s.below, 1 - s.above);
}

std::string matrix(const std::map<std::string, std::vector<PrintSpread>>& spreads) {
  constexpr double left_px = 190, top_px = 170, cell_px = 24;
  const std::size_t rows = spreads.begin()->second.size();
  const double width_px = left_px + cell_px * statistic_count + 30,
               height_px = top_px + row_px * static_cast<double>(rows) + 24;
  Svg svg(width_px, height_px, "Where the printed statistics lie among those of each mechanism",
          "A matrix of mechanisms and statistics.",
          "share of sets, in %, on the rarer side of the printed value; dark: hardly any");
  for (std::size_t k = 0; k < statistic_count; ++k) {
    const double x = left_px + cell_px * static_cast<double>(k);
    svg.text({x + cell_px / 2 + 4, top_px - 10}, spaced(statistic_name(k)), Anchor::start, 11, "#222", -60);
    const std::vector<PrintSpread>& column = spreads.at(statistic_name(k));
    for (std::size_t m = 0; m < rows; ++m) {
      const double y = top_px + row_px * static_cast<double>(m), share = rarer_side(column[m]);
      const bool dark = share < 0.01;
      svg.rectangle({x, y}, cell_px - 1, row_px - 1,
                    share < 0.001   ? "#7a2e00"
                    : dark          ? "#d55e00"
                    : share < 0.025 ? "#f0a877"
                    : share < 0.1   ? "#f9dcc8"
                                    : "#eef4f8");
      const std::string text = share < 0.001 ? "0" : fmt::format("{:.{}f}", 100 * share, share < 0.01 ? 1 : 0);
      svg.text({x + cell_px / 2, y + row_px - 5}, text, Anchor::middle, 9.5, dark ? "#fff" : "#222");
    }
  }
  const std::vector<PrintSpread>& names = spreads.begin()->second;
  for (std::size_t m = 0; m < rows; ++m)
    svg.text({left_px - 8, top_px + row_px * static_cast<double>(m) + row_px - 5}, names[m].mechanism, Anchor::end, 11);
  return svg.str();
}

}  // namespace

TextFiles population_pictures(const std::filesystem::path& folder) {
  const auto spreads = spreads_in(folder);
  TextFiles files;
  std::map<std::string, Interval> taken;
  for (const DataRow& row : data_rows(folder / "printed.csv"))
    taken[row.at("statistic")] = {std::stod(row.at("taken_low_mm")), std::stod(row.at("taken_high_mm"))};
  for (std::size_t i = 0; i < statistic_count; ++i) {
    const std::string name = statistic_name(i);
    files[name + ".svg"] = picture_of(i, spreads.at(name), taken.at(name));
  }
  files["matrix.svg"] = matrix(spreads);
  return files;
}

}  // namespace studies
