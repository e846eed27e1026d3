// Time of a solve on a shared machine: median and quartiles of repeats.
#pragma once

#include <functional>

namespace studies {

struct Timing {
  double median_us = 0;
  double lower_quartile_us = 0;
  double upper_quartile_us = 0;
  int repeats = 0;  // below seven nothing is claimed of the spread

  bool has_spread() const { return repeats >= 7; }
};

// Longer work is timed once: more repeats would take minutes a study, and fewer than seven tell no spread.
constexpr double long_work_s = 0.1;

// Runs the work at least `fewest_repeats` times and until budget_s is spent. Work shorter than a few microseconds is
// run in batches between two readings of the clock; the first run, cold, is not counted.
Timing measure(const std::function<void()>& work, double budget_s = 0.02, int fewest_repeats = 7);

// Of one run, cold.
double seconds_of(const std::function<void()>& work);

// The median of repeats; what took more than a second the first time is not repeated.
double time_us(const std::function<void()>& work, double first_run_s);

}  // namespace studies
