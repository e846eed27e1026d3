// Two small changes of numbers, vectors and screws at a time, which every processor has registers for.
#pragma once

#include "fam/screw.h"

namespace fam {

// Two changes of a number and of a vector.
using Pair = double __attribute__((vector_size(16)));
struct Pair3 {
  Pair x, y, z;
  Pair3& operator+=(const Pair3& b) { return x += b.x, y += b.y, z += b.z, *this; }
};
inline Pair3 operator+(const Pair3& a, const Pair3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Pair3 operator*(double a, const Pair3& b) {
  return {a * b.x, a * b.y, a * b.z};
}
// Two changes of a vector across the z axis.
struct PairAcrossZ {
  Pair x, y;
  operator Pair3() const { return {x, y, Pair{}}; }
};
inline PairAcrossZ operator+(const PairAcrossZ& a, const PairAcrossZ& b) {
  return {a.x + b.x, a.y + b.y};
}
inline Pair3 operator+(const Pair3& a, const PairAcrossZ& b) {
  return {a.x + b.x, a.y + b.y, a.z};
}
inline Pair3 operator+(const PairAcrossZ& a, const Pair3& b) {
  return b + a;
}
inline Pair3& operator+=(Pair3& a, const PairAcrossZ& b) {
  return a.x += b.x, a.y += b.y, a;
}
inline PairAcrossZ operator*(double a, const PairAcrossZ& b) {
  return {a * b.x, a * b.y};
}
inline Pair3 cross(const Vector3d& a, const Pair3& b) {
  return {a[1] * b.z - a[2] * b.y, a[2] * b.x - a[0] * b.z, a[0] * b.y - a[1] * b.x};
}
inline Pair3 cross(const Pair3& a, const Vector3d& b) {
  return {a.y * b[2] - a.z * b[1], a.z * b[0] - a.x * b[2], a.x * b[1] - a.y * b[0]};
}
// With a turn about z or a vector in the x-y plane.
inline PairAcrossZ cross(const Angular<double, 2>& a, const Pair3& b) {
  return {-a[0] * b.y, a[0] * b.x};
}
inline PairAcrossZ cross(const Angular<double, 2>& a, const PairAcrossZ& b) {
  return {-a[0] * b.y, a[0] * b.x};
}
inline PairAcrossZ cross(const Pair3& a, const Angular<double, 2>& b) {
  return {a.y * b[0], -a.x * b[0]};
}
inline Pair3 cross(const Eigen::Vector2d& a, const Pair3& b) {
  return {a[1] * b.z, -a[0] * b.z, a[0] * b.y - a[1] * b.x};
}
inline Pair3 cross(const Pair3& a, const Eigen::Vector2d& b) {
  return {-a.z * b[1], a.z * b[0], a.x * b[1] - a.y * b[0]};
}
template <class Matrix>
Pair3 product(const Matrix& A, const Pair3& b) {
  return {A(0, 0) * b.x + A(0, 1) * b.y + A(0, 2) * b.z, A(1, 0) * b.x + A(1, 1) * b.y + A(1, 2) * b.z,
          A(2, 0) * b.x + A(2, 1) * b.y + A(2, 2) * b.z};
}
// Columns first and first + 1; beyond the last there are zeros.
template <class Slopes>
[[gnu::always_inline]] inline Pair3 columns(const Slopes& from, int first) {
  const auto row = [&](int i) { return Pair{from(i, first), first + 1 < from.cols() ? from(i, first + 1) : 0}; };
  return {row(0), row(1), row(2)};
}
template <class Slopes>
void set_columns(const Pair3& from, int first, Slopes&& to) {
  const Pair rows[] = {from.x, from.y, from.z};
  for (int i = 0; i < 3; ++i) {
    to(i, first) = rows[i][0];
    if (first + 1 < to.cols()) to(i, first + 1) = rows[i][1];
  }
}

struct ScrewPair {
  Pair3 rotation, translation;
};
inline ScrewPair operator+(const ScrewPair& a, const ScrewPair& b) {
  return {a.rotation + b.rotation, a.translation + b.translation};
}
inline ScrewPair operator*(double factor, const ScrewPair& a) {
  return {factor * a.rotation, factor * a.translation};
}

}  // namespace fam
