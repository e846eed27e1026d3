// Small changes of numbers, vectors and screws, several at a time: as many as a register of the vector unit holds.
#pragma once

#include "fam/screw.h"
#include "fam/wide.h"

#include <array>
#include <type_traits>

namespace fam {

// Two changes of a number, which every processor has registers for; four, for AVX2 and FMA.
using Pair = double __attribute__((vector_size(16)));
using Quad = double __attribute__((vector_size(32)));

// Changes of a vector.
template <class V>
struct Changes3 {
  V x, y, z;
  Changes3& operator+=(const Changes3& b) { return x += b.x, y += b.y, z += b.z, *this; }
};
template <class V>
Changes3<V> operator+(const Changes3<V>& a, const Changes3<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
Changes3<V> operator*(double a, const Changes3<V>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
// Changes of a vector across the z axis.
template <class V>
struct ChangesAcrossZ {
  V x, y;
  operator Changes3<V>() const { return {x, y, V{}}; }
};
template <class V>
ChangesAcrossZ<V> operator+(const ChangesAcrossZ<V>& a, const ChangesAcrossZ<V>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class V>
Changes3<V> operator+(const Changes3<V>& a, const ChangesAcrossZ<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z};
}
template <class V>
Changes3<V> operator+(const ChangesAcrossZ<V>& a, const Changes3<V>& b) {
  return b + a;
}
template <class V>
Changes3<V>& operator+=(Changes3<V>& a, const ChangesAcrossZ<V>& b) {
  return a.x += b.x, a.y += b.y, a;
}
template <class V>
ChangesAcrossZ<V> operator*(double a, const ChangesAcrossZ<V>& b) {
  return {a * b.x, a * b.y};
}
// With a vector in space: its doubles' vector, or Wide3.
template <class A>
concept InSpace = std::is_same_v<A, Vector3d> || std::is_same_v<A, Wide3>;
template <InSpace A, class V>
Changes3<V> cross(const A& a, const Changes3<V>& b) {
  return {a[1] * b.z - a[2] * b.y, a[2] * b.x - a[0] * b.z, a[0] * b.y - a[1] * b.x};
}
template <InSpace B, class V>
Changes3<V> cross(const Changes3<V>& a, const B& b) {
  return {a.y * b[2] - a.z * b[1], a.z * b[0] - a.x * b[2], a.x * b[1] - a.y * b[0]};
}
// With a turn about z or a vector in the x-y plane.
template <class V>
ChangesAcrossZ<V> cross(const Angular<double, 2>& a, const Changes3<V>& b) {
  return {-a[0] * b.y, a[0] * b.x};
}
template <class V>
ChangesAcrossZ<V> cross(const Angular<double, 2>& a, const ChangesAcrossZ<V>& b) {
  return {-a[0] * b.y, a[0] * b.x};
}
template <class V>
ChangesAcrossZ<V> cross(const Changes3<V>& a, const Angular<double, 2>& b) {
  return {a.y * b[0], -a.x * b[0]};
}
template <class V>
Changes3<V> cross(const Eigen::Vector2d& a, const Changes3<V>& b) {
  return {a[1] * b.z, -a[0] * b.z, a[0] * b.y - a[1] * b.x};
}
template <class V>
Changes3<V> cross(const Changes3<V>& a, const Eigen::Vector2d& b) {
  return {-a.z * b[1], a.z * b[0], a.x * b[1] - a.y * b[0]};
}
template <class Matrix, class V>
Changes3<V> product(const Matrix& A, const Changes3<V>& b) {
  return {A(0, 0) * b.x + A(0, 1) * b.y + A(0, 2) * b.z, A(1, 0) * b.x + A(1, 1) * b.y + A(1, 2) * b.z,
          A(2, 0) * b.x + A(2, 1) * b.y + A(2, 2) * b.z};
}
// Of a matrix with these columns.
template <class Column, class V>
Changes3<V> product(const std::array<Column, 3>& A, const Changes3<V>& b) {
  return {A[0][0] * b.x + A[1][0] * b.y + A[2][0] * b.z, A[0][1] * b.x + A[1][1] * b.y + A[2][1] * b.z,
          A[0][2] * b.x + A[1][2] * b.y + A[2][2] * b.z};
}

template <class V>
constexpr int width = sizeof(V) / sizeof(double);
// As many columns as V is wide, from `first` on; before the first and beyond the last there are zeros.
template <class V, class Slopes>
[[gnu::always_inline]] inline Changes3<V> columns(const Slopes& from, int first) {
  Changes3<V> result{};
  for (int i = 0; i < width<V>; ++i) {
    if (first + i < 0) continue;
    if (first + i >= from.cols()) break;
    result.x[i] = from(0, first + i);
    result.y[i] = from(1, first + i);
    result.z[i] = from(2, first + i);
  }
  return result;
}
template <class V, class Slopes>
[[gnu::always_inline]] inline void set_columns(const Changes3<V>& from, int first, Slopes&& to) {
  for (int i = 0; i < width<V>; ++i) {
    if (first + i >= to.cols()) break;
    to(0, first + i) = from.x[i];
    to(1, first + i) = from.y[i];
    to(2, first + i) = from.z[i];
  }
}

// The numbers beside them: what is as wide as they are in space.
template <class V, int D>
using NumberBeside = std::conditional_t<D == 3 && width<V> == 4, Wide, double>;

template <class V>
struct ScrewChanges {
  Changes3<V> rotation, translation;
};
template <class V>
ScrewChanges<V> operator+(const ScrewChanges<V>& a, const ScrewChanges<V>& b) {
  return {a.rotation + b.rotation, a.translation + b.translation};
}
template <class V>
ScrewChanges<V> operator*(double factor, const ScrewChanges<V>& a) {
  return {factor * a.rotation, factor * a.translation};
}

}  // namespace fam
