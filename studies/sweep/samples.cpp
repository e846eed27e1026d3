#include "studies/sweep/sweep_file.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <random>

namespace studies {
namespace {

// 0, 1, ... n - 1 shuffled, the same on every machine.
std::vector<std::uint64_t> shuffled(std::uint64_t n, std::mt19937_64& random) {
  std::vector<std::uint64_t> order(n);
  std::iota(order.begin(), order.end(), std::uint64_t{0});
  for (std::uint64_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

double uniform(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
}

}  // namespace

double Variable::value(double u) const {
  switch (spread) {
    case Spread::logarithmic: return from * std::pow(to / from, u);
    case Spread::normal: return mean + gsl_cdf_gaussian_Pinv(u, sd);
    default: return std::lerp(from, to, u);
  }
}

std::vector<double> Sweep::samples() const {
  const std::size_t width = variables.size();
  std::vector<double> values(points * width);
  const auto set = [&](std::uint64_t row, std::size_t k, double u) { values[row * width + k] = variables[k].value(u); };
  if (sampling == Sampling::grid) {
    for (std::uint64_t row = 0; row < points; ++row) {
      std::uint64_t rest = row;  // the last variable runs fastest
      for (std::size_t k = width; k-- > 0;) {
        const auto n = static_cast<std::uint64_t>(variables[k].points);
        set(row, k, static_cast<double>(rest % n) / static_cast<double>(n - 1));
        rest /= n;
      }
    }
  } else if (sampling == Sampling::latin_hypercube) {
    std::mt19937_64 random(seed);
    for (std::size_t k = 0; k < width; ++k) {
      const std::vector<std::uint64_t> order = shuffled(points, random);
      for (std::uint64_t row = 0; row < points; ++row)
        set(row, k, (static_cast<double>(order[row]) + uniform(random)) / static_cast<double>(points));
    }
  } else {
    const std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> sequence(
        gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(width)), gsl_qrng_free);
    std::vector<double> u(width);
    for (std::uint64_t row = 0; row < points; ++row) {
      gsl_qrng_get(sequence.get(), u.data());  // inside (0, 1)
      for (std::size_t k = 0; k < width; ++k) set(row, k, u[k]);
    }
  }
  return values;
}

}  // namespace studies
