// Time of a solve on a shared machine: median and quartiles of repeats.
#pragma once

#include <functional>

namespace studies {

struct Timing {
  double median_us = 0;
  double lower_quartile_us = 0;
  double upper_quartile_us = 0;
  int repeats = 0;
};

// Runs the work at least `fewest_repeats` times and until budget_s is spent. Work shorter than a few microseconds is
// run in batches between two readings of the clock; the first run, cold, is not counted.
Timing measure(const std::function<void()>& work, double budget_s = 0.02, int fewest_repeats = 3);

}  // namespace studies
