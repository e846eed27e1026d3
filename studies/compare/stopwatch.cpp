#include "studies/compare/stopwatch.h"

#include <algorithm>
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
  work();
  constexpr double shortest_batch_s = 20e-6;  // against a clock step of some 30 ns
  int batch = 1;
  double once = seconds_for(work, batch);
  while (once < shortest_batch_s && batch < (1 << 20)) {
    batch *= 2;
    once = seconds_for(work, batch);
  }
  std::vector<double> samples;
  double spent = 0;
  while (static_cast<int>(samples.size()) < fewest_repeats || (spent < budget_s && samples.size() < 10'000)) {
    const double seconds = seconds_for(work, batch);
    spent += seconds;
    samples.push_back(1e6 * seconds / batch);
  }
  std::sort(samples.begin(), samples.end());
  const auto quantile = [&](double q) {
    return samples[static_cast<std::size_t>(q * static_cast<double>(samples.size() - 1))];
  };
  return {quantile(0.5), quantile(0.25), quantile(0.75), static_cast<int>(samples.size())};
}

}  // namespace studies
