// A number with its derivatives in N directions (forward differentiation), for the scalar of fam/screw.h and
// fam/arc_law.h. Exact derivatives of the discrete march, at about 1 + N/2 times its cost.
#pragma once

#include "fam/screw.h"

namespace fam {

template <int N>
struct Dual {
  using Slope = Eigen::Array<double, N, 1>;

  double value;
  Slope slope;

  Dual() {}                                           // NOLINT: not set, as a double is not
  Dual(double v) : value(v), slope(Slope::Zero()) {}  // NOLINT: constants mix with duals
  Dual(double v, const Slope& s) : value(v), slope(s) {}

  Dual operator-() const { return {-value, -slope}; }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.slope + b.value * a.slope};
  }
  friend Dual operator*(double a, const Dual& b) { return {a * b.value, a * b.slope}; }
  friend Dual operator*(const Dual& a, double b) { return b * a; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return {quotient, (a.slope - quotient * b.slope) / b.value};
  }
  friend bool operator<(const Dual& a, double b) { return a.value < b; }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, a.slope / (2 * root)};
  }
  friend Dual sin(const Dual& a) { return {std::sin(a.value), std::cos(a.value) * a.slope}; }
};

// It has no derivatives to be carried along.
template <int N>
struct FactorOf<Dual<N>> {
  using Type = double;
};

// Their derivatives by x: (C - B) / 2, E - C / 2, (3 F - E) / 2.
template <int N>
BasicCoefficients<Dual<N>> small_screw_coefficients(const Dual<N>& x) {
  const auto [E, F] = inner_coefficients(x.value);
  const auto [A, B, C] = small_screw_coefficients(x.value);
  return {{A, (C - B) / 2 * x.slope}, {B, (E - C / 2) * x.slope}, {C, (3 * F - E) / 2 * x.slope}};
}

inline double value_of(double x) {
  return x;
}
template <int N>
double value_of(const Dual<N>& x) {
  return x.value;
}

}  // namespace fam

namespace Eigen {
template <int N>
struct NumTraits<fam::Dual<N>> : NumTraits<double> {
  using Real = fam::Dual<N>;
  using NonInteger = fam::Dual<N>;
  using Nested = fam::Dual<N>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = N,
    AddCost = N,
    MulCost = 3 * N
  };
};
template <int N>
struct ScalarBinaryOpTraits<double, fam::Dual<N>, internal::scalar_product_op<double, fam::Dual<N>>> {
  using ReturnType = fam::Dual<N>;
};
template <int N>
struct ScalarBinaryOpTraits<fam::Dual<N>, double, internal::scalar_product_op<fam::Dual<N>, double>> {
  using ReturnType = fam::Dual<N>;
};
}  // namespace Eigen
