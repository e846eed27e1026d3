#include "studies/compare/printed_statistics.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

struct Range {
  double low, high;
};

double rms_of(double mean, double deviation, double share) {
  return std::sqrt(mean * mean + share * deviation * deviation);
}

// Of all numbers that print as these do, two decimals each.
Range rms_range(double mean, double deviation, double share) {
  constexpr double half = 0.005;
  return {rms_of(std::max(std::abs(mean) - half, 0.0), deviation - half, share),
          rms_of(std::abs(mean) + half, deviation + half, share)};
}

ImpliedRms implied(double mean, double deviation, double share, double printed_rms) {
  constexpr double half = 0.00005;
  const Range range = rms_range(mean, deviation, share);
  return {rms_of(mean, deviation, share), range.low <= printed_rms + half && range.high >= printed_rms - half};
}

}  // namespace

const std::vector<PrintedStatistics>& printed_statistics() {
  static const std::vector<PrintedStatistics> rows = {{true, 0, -0.27, 0.90, 0.29, 0.48, 0.4865},
                                                      {true, 1, -0.25, 0.94, 0.39, 0.58, 0.5732},
                                                      {false, 0, 0.36, 0.98, 0.44, 0.28, 0.5222},
                                                      {false, 1, -0.18, 0.56, 0.52, 0.20, 0.5590},
                                                      {false, 2, -0.13, 0.37, 0.51, 0.14, 0.5284}};
  return rows;
}

ImpliedRms from_errors(const PrintedStatistics& p, double share) {
  return implied(p.mean, p.deviation, share, p.root_mean_square);
}

ImpliedRms from_absolute_errors(const PrintedStatistics& p, double share) {
  return implied(p.mean_absolute, p.absolute_deviation, share, p.root_mean_square);
}

bool below_mean_absolute(const PrintedStatistics& p) {
  return rms_range(p.mean, p.deviation, share_n).high < p.mean_absolute - 0.005;
}

bool above_mean_absolute(const PrintedStatistics& p) {
  return rms_range(p.mean, p.deviation, share_n_minus_1).low > std::sqrt(printed_cases) * (p.mean_absolute + 0.005);
}

std::string set_and_axis(const PrintedStatistics& p) {
  return std::string(p.planar ? "planar " : "spatial ") + "xyz"[p.axis];
}

}  // namespace studies
