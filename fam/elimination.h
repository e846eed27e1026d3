// Elimination without pivots, for matrices similar to positive definite ones: I + C S, C diagonal and not negative, S
// symmetric and positive.
#pragma once

#include <Eigen/Core>

namespace fam {

// Replaces the matrix by its factors, the diagonal by its inverse.
template <class Number, int size>
void factorise(Eigen::Matrix<Number, size, size>& a) {
#pragma GCC unroll 8
  for (int k = 0; k < size; ++k) {
    a(k, k) = Number(1) / a(k, k);
#pragma GCC unroll 8
    for (int i = k + 1; i < size; ++i) {
      a(i, k) = a(i, k) * a(k, k);
#pragma GCC unroll 8
      for (int j = k + 1; j < size; ++j) a(i, j) -= a(i, k) * a(k, j);
    }
  }
}

// With the factors: replaces right-hand sides, columns of x, by the solutions.
template <class Number, int size, int columns>
void substitute(const Eigen::Matrix<Number, size, size>& factors, Eigen::Matrix<Number, size, columns>& x) {
  for (int column = 0; column < columns; ++column) {
#pragma GCC unroll 8
    for (int i = 1; i < size; ++i) {
#pragma GCC unroll 8
      for (int j = 0; j < i; ++j) x(i, column) -= factors(i, j) * x(j, column);
    }
#pragma GCC unroll 8
    for (int i = size - 1; i >= 0; --i) {
#pragma GCC unroll 8
      for (int j = i + 1; j < size; ++j) x(i, column) -= factors(i, j) * x(j, column);
      x(i, column) = x(i, column) * factors(i, i);
    }
  }
}

}  // namespace fam
