#include "studies/population/targets.h"

#include "studies/compare/error_measures.h"
#include "studies/compare/printed_statistics.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr std::size_t overall_mean = row_count * in_row, overall_deviation = overall_mean + 1;

bool is_planar_row(std::size_t row) {
  return row < 2;
}
int axis_of(std::size_t row) {
  return static_cast<int>(is_planar_row(row) ? row : row - 2);
}

// A reading's RMS from a mean and a deviation; its deviation from a mean and an RMS. Both ways of taking the SD.
void widen(std::optional<Interval>& reading, double low, double high) {
  if (!reading) reading = Interval{low, high};
  reading->low = std::min(reading->low, low);
  reading->high = std::max(reading->high, high);
}

Interval magnitude_of(const Interval& i) {
  const double a = std::abs(i.low), b = std::abs(i.high);
  return {i.low <= 0 && i.high >= 0 ? 0 : std::min(a, b), std::max(a, b)};
}

// Readings of a row's RMS that its own numbers imply.
void widen_rms(std::optional<Interval>& rms, const std::optional<Interval>& mean, const std::optional<Interval>& spread,
               double least_share) {
  if (!mean || !spread) return;
  const Interval m = magnitude_of(*mean);
  widen(rms, std::hypot(m.low, std::sqrt(least_share) * spread->low), std::hypot(m.high, spread->high));
}

void widen_spread(std::optional<Interval>& spread, const std::optional<Interval>& mean,
                  const std::optional<Interval>& rms, double least_share) {
  if (!mean || !rms || !spread) return;
  const Interval m = magnitude_of(*mean);
  const auto squared = [](double a, double b) { return std::max(a * a - b * b, 0.0); };
  widen(spread, std::sqrt(squared(rms->low, m.high)), std::sqrt(squared(rms->high, m.low) / least_share));
}

}  // namespace

std::string statistic_name(std::size_t place) {
  static constexpr std::array<const char*, in_row> names = {"mean", "SD", "MAE", "MAE_SD", "RMS"};
  if (place == overall_mean) return "overall_mean";
  if (place == overall_deviation) return "overall_SD";
  const std::size_t row = place / in_row;
  return std::string(is_planar_row(row) ? "planar_" : "spatial_") + "xyz"[axis_of(row)] + "_" + names[place % in_row];
}

bool is_mean(std::size_t place) {
  return place == overall_mean || (place < overall_mean && place % in_row == mean_error);
}

StatisticVector statistics_of(const std::vector<Eigen::Vector3d>& errors_mm, std::size_t planar_cases) {
  StatisticVector result{};
  std::vector<double> all;
  for (std::size_t row = 0; row < row_count; ++row) {
    std::vector<double> one;
    const std::size_t first = is_planar_row(row) ? 0 : planar_cases,
                      end = is_planar_row(row) ? planar_cases : errors_mm.size();
    for (std::size_t i = first; i < end; ++i) one.push_back(errors_mm[i][axis_of(row)]);
    const Statistics s = statistics(one);
    result[place_of(row, mean_error)] = s.mean;
    result[place_of(row, deviation)] = s.standard_deviation;
    result[place_of(row, mean_absolute)] = s.mean_absolute;
    result[place_of(row, absolute_deviation)] = s.absolute_deviation;
    result[place_of(row, root_mean_square)] = s.root_mean_square;
    all.insert(all.end(), one.begin(), one.end());
  }
  const Statistics s = statistics(all);
  result[overall_mean] = s.mean;
  result[overall_deviation] = s.standard_deviation;
  return result;
}

PrintedStudy printed_study1() {
  PrintedStudy study;
  study.title = "Study I of the paper";
  constexpr double half = 0.005, half_of_four = 0.00005;
  const std::vector<PrintedStatistics>& rows = printed_statistics();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto print = [&](Statistic statistic, double value, double rounding) {
      study.printed[place_of(row, statistic)] = Interval{value - rounding, value + rounding};
    };
    print(mean_error, rows[row].mean, half);
    print(deviation, rows[row].deviation, half);
    print(mean_absolute, rows[row].mean_absolute, half);
    print(absolute_deviation, rows[row].absolute_deviation, half);
    print(root_mean_square, rows[row].root_mean_square, half_of_four);
  }
  // 0.23 ± 0.89 of the abstract: of what, and with which sign, is not said.
  study.printed[overall_mean] = Interval{-0.235, 0.235};
  study.printed[overall_deviation] = Interval{0.885, 0.895};
  return study;
}

Targets reconciled(const PrintedStudy& study) {
  Targets targets{study.printed, study.rounding_mm};
  for (std::size_t row = 0; row < row_count; ++row) {
    const int cases = is_planar_row(row) ? study.rod.planar_cases : study.rod.spatial_cases;
    const double least_share = (cases - 1.) / cases;
    const auto given = [&](Statistic statistic) { return study.printed[place_of(row, statistic)]; };
    std::optional<Interval>& rms = targets.of[place_of(row, root_mean_square)];
    widen_rms(rms, given(mean_error), given(deviation), least_share);
    widen_rms(rms, given(mean_absolute), given(absolute_deviation), least_share);
    widen_spread(targets.of[place_of(row, deviation)], given(mean_error), rms, least_share);
    widen_spread(targets.of[place_of(row, absolute_deviation)], given(mean_absolute), rms, least_share);
  }
  return targets;
}

double largest_deviation(const StatisticVector& set, const Targets& targets) {
  double largest = 0;
  for (std::size_t i = 0; i < statistic_count; ++i) {
    if (!targets.of[i]) continue;
    const double nearest = std::clamp(set[i], targets.of[i]->low, targets.of[i]->high);
    if (set[i] != nearest) largest = std::max(largest, std::abs(set[i] - nearest) / std::abs(nearest));
  }
  return largest;
}

}  // namespace studies
