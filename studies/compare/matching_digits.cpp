#include "studies/compare/matching_digits.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

int leading_place(double scale) {
  return static_cast<int>(std::floor(std::log10(scale) + 1e-12));
}

int decimals(const std::vector<Printed>& published) {
  int most = published.front().decimals;
  for (const Printed& p : published) most = std::max(most, p.decimals);
  return most;
}

}  // namespace

double norm(const std::vector<Printed>& published) {
  double squares = 0;
  for (const Printed& p : published) squares += p.value * p.value;
  return std::sqrt(squares);
}

int carried_digits(const std::vector<Printed>& published, double scale) {
  return std::max(0, leading_place(scale) + decimals(published) + 1);
}

double matching_digits(const std::vector<double>& values, const std::vector<Printed>& published, double scale,
                       int most) {
  const double half_place = 0.5 * std::pow(10, -decimals(published)) * (1 + 1e-9);
  double squares = 0, largest = 0;
  for (std::size_t i = 0; i < published.size(); ++i) {
    const double error = std::abs(values.at(i) - published[i].value);
    squares += error * error;
    largest = std::max(largest, error);
  }
  const double carried = std::min(most, carried_digits(published, scale));
  if (largest <= half_place) return carried;
  return std::clamp(-std::log10(std::sqrt(squares) / scale), 0.0, carried);
}

}  // namespace studies
