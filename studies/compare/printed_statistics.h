// The statistics that the paper prints for Study I (its tables and its loads are lost), and whether they fit together.
#pragma once

#include <string>
#include <vector>

namespace studies {

// Of the eight differences FAM - FE of a set along one axis, mm.
struct PrintedStatistics {
  bool planar;
  int axis;
  double mean, deviation, mean_absolute, absolute_deviation;  // two decimals in print
  double root_mean_square;                                    // four
};
const std::vector<PrintedStatistics>& printed_statistics();

constexpr int printed_cases = 8;  // n of each set

// sqrt(mean^2 + share SD^2): the root mean square that belongs to a mean and an SD. share: (n - 1)/n where the SD was
// taken with n - 1, 1 where with n; the paper does not say.
struct ImpliedRms {
  double value;
  bool agrees;  // with the printed one, all of them anywhere within their rounding
};
constexpr double share_n_minus_1 = (printed_cases - 1.0) / printed_cases, share_n = 1;
ImpliedRms from_errors(const PrintedStatistics& p, double share);           // of mean ± SD
ImpliedRms from_absolute_errors(const PrintedStatistics& p, double share);  // of MAE ± SD

// The RMS of mean ± SD, wherever within the rounding, is less than the printed MAE, or more than sqrt(n) times it.
// No numbers can do either.
bool below_mean_absolute(const PrintedStatistics& p);
bool above_mean_absolute(const PrintedStatistics& p);

std::string set_and_axis(const PrintedStatistics& p);  // "planar x"

}  // namespace studies
