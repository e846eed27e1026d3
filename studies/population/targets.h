// Printed statistics as intervals, the statistics of a set of loads, and how far the one is from the others.
#pragma once

#include "studies/population/loads.h"

#include <Eigen/Dense>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace studies {

// Of each set (planar x, y; spatial x, y, z) five: mean, SD, MAE, SD of |e|, RMS; then mean and SD of all components.
constexpr std::size_t row_count = 5, in_row = 5, statistic_count = row_count * in_row + 2;
using StatisticVector = std::array<double, statistic_count>;
enum Statistic : std::size_t { mean_error, deviation, mean_absolute, absolute_deviation, root_mean_square };
constexpr std::size_t place_of(std::size_t row, Statistic statistic) {
  return row * in_row + statistic;
}
std::string statistic_name(std::size_t place);  // "planar_x_mean"
bool is_mean(std::size_t place);                // which has a sign
StatisticVector statistics_of(const std::vector<Eigen::Vector3d>& errors_mm, std::size_t planar_cases);

struct Interval {
  double low, high;
};

// Statistics as somebody printed them; a row's place as above, the last two apart.
struct PrintedStudy {
  std::string title;
  PopulationRod rod;
  double rounding_mm = 0.005;  // two decimals
  std::array<std::optional<Interval>, statistic_count> printed;
};
PrintedStudy printed_study1();  // the paper's (compare/printed_statistics.h), within their rounding

// What a set is asked to have: as printed, but where a row contradicts itself its SD, its SD of |e| and its RMS reach
// over all readings: the printed one, and those that follow from the others by RMS^2 = mean^2 + k SD^2 = MAE^2 + k
// SD|e|^2 with k = (n - 1)/n or 1. Where no RMS is given but one follows, it is added.
struct Targets {
  std::array<std::optional<Interval>, statistic_count> of;
  double least_error_mm = 0.005;  // smaller ones print as none
};
Targets reconciled(const PrintedStudy& study);

// The largest deviation from the nearest value asked for, over that value: 0.2 where all are within 20 %.
double largest_deviation(const StatisticVector& set, const Targets& targets);

// --- Distance --------------------------------------------------------------------------------------------------------
// Of a row three numbers are independent; the other two follow. Taken: log of the MAE (of the RMS, where no MAE is
// given), mean over it, log of RMS over MAE. Rows that the targets do not name are left out.
Eigen::VectorXd features_of(const StatisticVector& set, const Targets& targets);

// Sets of one mechanism: Mahalanobis's distance from their mean, the covariance shrunk by a tenth towards its diagonal.
class SetCloud {
 public:
  SetCloud(const std::vector<StatisticVector>& sets, const Targets& targets);

  double distance(const Eigen::VectorXd& features) const;
  double distance_of(const Targets& targets) const;  // least, over the intervals
  double own(double share) const;                    // distance below which this share of the own sets lies
  double share_farther(double distance) const;       // of the own sets

 private:
  Eigen::VectorXd mean_;
  Eigen::MatrixXd precision_;
  std::vector<double> own_;  // ascending
};

enum class PrintVerdict { excluded, strained, fits };
constexpr double excluded_beyond = 0.999, fits_within = 0.95;  // of the mechanism's own sets
const char* name(PrintVerdict verdict);

struct PrintJudgement {
  std::size_t sets = 0;  // with an answer
  double distance = 0, own_999 = 0, share_farther = 0;
  std::size_t within_20 = 0, within_50 = 0;
  double nearest = 0;  // least largest_deviation
  PrintVerdict verdict = PrintVerdict::excluded;
};
PrintJudgement judge_print(const std::vector<StatisticVector>& sets, const Targets& targets);

}  // namespace studies
