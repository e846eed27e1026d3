// Doubles side by side, one rod a lane: a scalar for the templates of fam/screw.h and fam/arc_series.h. Built on the
// vector extension of GCC and Clang, which every unit serves: what it lacks is done in pieces.
#pragma once

#include "fam/screw.h"

#include <cstdint>

namespace fam {

// Vectors of the extension.
template <int lanes>
struct PackTypes {
  using Lanes [[gnu::vector_size(lanes * sizeof(double))]] = double;
  // Of a comparison: all bits of a lane, or none.
  using Mask [[gnu::vector_size(lanes * sizeof(double))]] = std::int64_t;
};

// `level` tells apart code built for different units, which must not share a symbol.
template <int lanes, int level>
struct Pack {
  using Lanes = typename PackTypes<lanes>::Lanes;
  using Mask = typename PackTypes<lanes>::Mask;

  Lanes value;

  Pack() {}                               // NOLINT: not set, as a double is not
  Pack(double v) : value(v - Lanes{}) {}  // NOLINT: constants mix with packs
  explicit Pack(Lanes v) : value(v) {}

  Pack operator-() const { return Pack(-value); }
  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator-=(const Pack& b) { return *this = *this - b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }

  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.value + b.value); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.value - b.value); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.value * b.value); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.value / b.value); }
  friend Mask operator<(const Pack& a, const Pack& b) { return a.value < b.value; }
  friend Mask operator<=(const Pack& a, const Pack& b) { return a.value <= b.value; }

  friend Pack select(const Mask& mask, const Pack& yes, const Pack& no) { return Pack(mask ? yes.value : no.value); }
  friend Pack larger(const Pack& a, const Pack& b) { return select(a < b, b, a); }
  friend Pack smaller(const Pack& a, const Pack& b) { return select(b < a, b, a); }
  friend Pack sqrt(const Pack& a) {
    Pack root;
    for (int lane = 0; lane < lanes; ++lane) root.value[lane] = __builtin_sqrt(a.value[lane]);
    return root;
  }
  static bool any(const Mask& mask) {
    std::int64_t bits = 0;
    for (int lane = 0; lane < lanes; ++lane) bits |= mask[lane];
    return bits != 0;
  }
};

constexpr double largest_lane_angle_rad = 2;
// As far as that: beyond 1 rad by those of half the angle, which cancel nowhere.
template <int lanes, int level>
BasicCoefficients<Pack<lanes, level>> screw_coefficients(const Pack<lanes, level>& angle_squared) {
  using P = Pack<lanes, level>;
  const auto is_large = P(1) <= angle_squared;
  const bool any_large = P::any(is_large);
  const P x = any_large ? select(is_large, P(0.25) * angle_squared, angle_squared) : angle_squared;
  BasicCoefficients<P> k = small_screw_coefficients(x);
  if (!any_large) return k;
  const P A = k.A * (P(1) - x * k.B);
  k.B = select(is_large, P(0.5) * k.A * k.A, k.B);
  k.A = select(is_large, A, k.A);
  k.C = select(is_large, (P(1) - A) / angle_squared, k.C);
  return k;
}

}  // namespace fam

namespace Eigen {
template <int lanes, int level>
struct NumTraits<fam::Pack<lanes, level>> : NumTraits<double> {
  using Real = fam::Pack<lanes, level>;
  using NonInteger = fam::Pack<lanes, level>;
  using Nested = fam::Pack<lanes, level>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
}  // namespace Eigen
