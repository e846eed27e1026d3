#include "studies/compare/stopwatch.h"

#include "studies/compare/error_measures.h"

#include <chrono>
#include <vector>

namespace studies {
namespace {

double seconds_for(const std::function<void()>& work, int batch) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < batch; ++i) work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Timing measure(const std::function<void()>& work, double budget_s, int fewest_repeats) {
  const double cold = seconds_for(work, 1);
  if (fewest_repeats > 1 && cold > long_work_s) fewest_repeats = 1, budget_s = 0;
  constexpr double shortest_batch_s = 20e-6;  // against a clock step of some 30 ns
  int batch = 1;
  double once = seconds_for(work, batch);
  while (once < shortest_batch_s && batch < (1 << 20)) {
    batch *= 2;
    once = seconds_for(work, batch);
  }
  std::vector<double> samples_us = {1e6 * once / batch};
  double spent = once;
  while (static_cast<int>(samples_us.size()) < fewest_repeats || (spent < budget_s && samples_us.size() < 10'000)) {
    const double seconds = seconds_for(work, batch);
    spent += seconds;
    samples_us.push_back(1e6 * seconds / batch);
  }
  return {quantile(samples_us, 0.5), quantile(samples_us, 0.25), quantile(samples_us, 0.75),
          static_cast<int>(samples_us.size())};
}

double seconds_of(const std::function<void()>& work) {
  return seconds_for(work, 1);
}

double time_us(const std::function<void()>& work, double first_run_s) {
  return first_run_s > 1 ? 1e6 * first_run_s : measure(work).median_us;
}

}  // namespace studies
