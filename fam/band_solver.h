// Gaussian elimination with row pivoting for the band matrices of multiple shooting, in memory that the caller keeps.
#pragma once

#include "fam/vector_unit.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fam {

// A square matrix with `below` diagonals below the main one and `above` above it, and a right-hand side.
template <int below, int above>
class BandSystem {
 public:
  void resize(int size) {
    size_ = size;
    rows_.assign(static_cast<std::size_t>(size), Row::Zero());
    right_.assign(static_cast<std::size_t>(size), 0);
    pivots_.assign(static_cast<std::size_t>(size), 0);
  }
  void reserve(std::size_t size) {
    rows_.reserve(size);
    right_.reserve(size);
    pivots_.reserve(size);
  }
  int size() const { return size_; }
  void set_zero() { std::fill(rows_.begin(), rows_.end(), Row::Zero()); }

  double& operator()(int row, int column) { return rows_[static_cast<std::size_t>(row)][column - row + below]; }
  Eigen::Map<Eigen::VectorXd> right() { return {right_.data(), size_}; }

  // After factorise(): the determinant's sign, and the logarithm of its size.
  bool determinant_is_negative() const { return negative_; }
  double log_determinant() const { return log_determinant_; }

  // Replaces the matrix by its factors. False: a pivot is 0 or not finite.
  bool factorise() {
    return call_on(widest_unit(), [this] { return factorise_here(); });
  }
  // With the factors: replaces the right-hand side by the solution.
  void substitute() {
    call_on(widest_unit(), [this] { substitute_here(); });
  }

 private:
  bool factorise_here() {
    negative_ = false;
    log_determinant_ = 0;
    for (int k = 0; k < size_; ++k) {
      const int last_row = std::min(k + below, size_ - 1);
      const int width = std::min(below + above, size_ - 1 - k) + 1;  // pivoting fills `below` more diagonals
      int pivot = k;
      for (int i = k + 1; i <= last_row; ++i) {
        if (std::abs((*this)(i, k)) > std::abs((*this)(pivot, k))) pivot = i;
      }
      double* top = &(*this)(k, k);
      pivots_[static_cast<std::size_t>(k)] = pivot;
      if (pivot != k) {
        std::swap_ranges(top, top + width, &(*this)(pivot, k));
        negative_ = !negative_;
      }
      if (!(std::abs(*top) > 0) || !std::isfinite(*top)) return false;
      negative_ ^= *top < 0;
      log_determinant_ += std::log(std::abs(*top));
      for (int i = k + 1; i <= last_row; ++i) {
        double* row = &(*this)(i, k);
        if (*row == 0) continue;
        const double factor = *row /= *top;
        for (int j = 1; j < width; ++j) row[j] -= factor * top[j];
      }
    }
    return true;
  }

  void substitute_here() {
    double* const right = right_.data();
    for (int k = 0; k < size_; ++k) {
      std::swap(right[k], right[pivots_[static_cast<std::size_t>(k)]]);
      const int last_row = std::min(k + below, size_ - 1);
      for (int i = k + 1; i <= last_row; ++i) right[i] -= (*this)(i, k) * right[k];
    }
    for (int k = size_ - 1; k >= 0; --k) {
      const int last = std::min(k + below + above, size_ - 1);
      for (int j = k + 1; j <= last; ++j) right[k] -= (*this)(k, j) * right[j];
      right[k] /= (*this)(k, k);
    }
  }

  using Row = Eigen::Array<double, 2 * below + above + 1, 1>;  // from the lowest diagonal up, and what pivoting fills
  int size_ = 0;
  bool negative_ = false;
  double log_determinant_ = 0;
  std::vector<Row> rows_;
  std::vector<double> right_;
  std::vector<int> pivots_;  // the row that took this one's place
};

}  // namespace fam
