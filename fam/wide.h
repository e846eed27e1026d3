// Vectors of space, each in one register of four doubles: a scalar for the templates of fam/screw.h and
// fam/arc_series.h on AVX2. Eigen's three doubles go through memory, where loads wait for stores of another width: an
// arc's step takes a quarter of the instructions and two thirds of the time so.
#pragma once

#include "fam/screw.h"
#include "fam/vector_unit.h"

#include <array>
#include <cmath>

namespace fam {

// A double whose vectors are Wide3.
struct Wide {
  double value;
  Wide() {}                     // NOLINT: not set, as a double is not
  Wide(double v) : value(v) {}  // NOLINT: as good as a double
  operator double() const { return value; }
};

// The fourth lane is as the third, or zero; nothing reads it.
struct Wide3 {
  using Scalar = Wide;
  using Lanes [[gnu::vector_size(32)]] = double;
  Lanes lanes;

  static Wide3 Zero() { return {Lanes{}}; }
  static Wide3 from(const Vector3d& v) {
    using Half [[gnu::vector_size(16), gnu::aligned(8)]] = double;
    return {__builtin_shufflevector(*reinterpret_cast<const Half*>(v.data()), Half{v[2], v[2]}, 0, 1, 2, 3)};
  }
  Vector3d narrow() const { return {lanes[0], lanes[1], lanes[2]}; }
  // y, z, x.
  Wide3 rolled() const { return {__builtin_shufflevector(lanes, lanes, 1, 2, 0, 3)}; }
  double operator[](int i) const { return lanes[i]; }
  double dot(const Wide3& b) const {
    const Lanes products = lanes * b.lanes;
    return products[0] + products[1] + products[2];
  }
  double norm() const { return std::sqrt(dot(*this)); }
  Wide3 cwiseProduct(const Wide3& b) const { return {lanes * b.lanes}; }
  Wide3& operator+=(const Wide3& b) { return lanes += b.lanes, *this; }
  Wide3& operator-=(const Wide3& b) { return lanes -= b.lanes, *this; }
};
inline Wide3 operator+(const Wide3& a, const Wide3& b) {
  return {a.lanes + b.lanes};
}
inline Wide3 operator-(const Wide3& a, const Wide3& b) {
  return {a.lanes - b.lanes};
}
inline Wide3 operator-(const Wide3& a) {
  return {-a.lanes};
}
inline Wide3 operator*(double a, const Wide3& b) {
  return {a * b.lanes};
}
inline Wide3 operator*(const Wide3& a, double b) {
  return b * a;
}

// A sum of cross products, to be rolled once: a x b is the rolled (a times b rolled, less a rolled times b).
struct UnrolledCross {
  Wide3 unrolled;
  operator Wide3() const { return unrolled.rolled(); }
  UnrolledCross& operator+=(const UnrolledCross& b) { return unrolled += b.unrolled, *this; }
};
inline UnrolledCross operator+(const UnrolledCross& a, const UnrolledCross& b) {
  return {a.unrolled + b.unrolled};
}
inline UnrolledCross operator-(const UnrolledCross& a, const UnrolledCross& b) {
  return {a.unrolled - b.unrolled};
}
inline UnrolledCross cross(const Wide3& a, const Wide3& b) {
  return {a.cwiseProduct(b.rolled()) - a.rolled().cwiseProduct(b)};
}
inline UnrolledCross arm_cross(const Wide3& a, const Wide3& b) {
  return cross(a, b);
}

// Columns of the inverse of the matrix with these rows.
inline std::array<Wide3, 3> inverse_of_rows(const std::array<Wide3, 3>& rows) {
  const Wide3 first = cross(rows[1], rows[2]);
  const double share = 1 / first.dot(rows[0]);
  return {share * first, share * Wide3(cross(rows[2], rows[0])), share * Wide3(cross(rows[0], rows[1]))};
}

template <>
struct VectorOf<Wide, 3> {
  using Type = Wide3;
};
template <>
inline Wide3 as<Wide, 3>(const Vector3d& v) {
  return Wide3::from(v);
}

inline BasicScrew<Wide, 3> wide(const Screw& a) {
  return {Wide3::from(a.rotation), Wide3::from(a.translation_mm)};
}
inline BasicWrench<Wide, 3> wide(const SectionWrench& a) {
  return {Wide3::from(a.force_N), Wide3::from(a.moment_Nmm)};
}
inline Vector3d narrow(const Wide3& v) {
  return v.narrow();
}
// Whatever is narrow already.
template <int D>
const Eigen::Matrix<double, D, 1>& narrow(const Eigen::Matrix<double, D, 1>& v) {
  return v;
}
inline Screw narrow(const BasicScrew<Wide, 3>& a) {
  return {a.rotation.narrow(), a.translation_mm.narrow()};
}
inline SectionWrench narrow(const BasicWrench<Wide, 3>& a) {
  return {a.force_N.narrow(), a.moment_Nmm.narrow()};
}

}  // namespace fam
