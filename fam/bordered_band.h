// Gaussian elimination with row pivoting for a band matrix that has been given a few rows and columns more: the
// columns, dense, at its right end, and each row among those that it shares columns with. Every row that has an entry
// in a column stands in the window where its pivot is sought, so the elimination is as stable as that of the full
// matrix, also where the band by itself is singular, as at a fold; which the block elimination of such borders is not.
#pragma once

#include "fam/vector_unit.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace fam {

// `band_below` diagonals below the main one of the band by itself and `band_above` above it; rows are counted with the
// added ones, each of which moves the rest of the band down.
template <int band_below, int band_above, int most_borders>
class BorderedBand {
 public:
  void resize(int columns, int borders) {
    columns_ = columns;
    size_ = columns + borders;
    rows_.resize(static_cast<std::size_t>(size_));
    pivots_.resize(static_cast<std::size_t>(size_));
  }
  void set_zero() { std::fill(rows_.begin(), rows_.end(), Row{Band::Zero(), Border::Zero()}); }
  int size() const { return size_; }

  // Columns of the band first, then the added ones.
  double& operator()(int row, int column) {
    Row& r = rows_[static_cast<std::size_t>(row)];
    return column < columns_ ? r.band[column - row + below] : r.border[column - columns_];
  }

  // After factorise().
  bool determinant_is_negative() const { return negative_; }
  double log_determinant() const { return log_determinant_; }

  // Replaces the matrix by its factors. A pivot below round-off becomes round-off: the matrix then has a null vector
  // that solutions grow along. False: something is not finite.
  bool factorise() {
    return call_on(widest_unit(), [this] { return factorise_here(); });
  }
  // With the factors: replaces the right-hand side by the solution.
  void substitute(Eigen::VectorXd& right) {
    call_on(widest_unit(), [&] { substitute_here(right); });
  }

 private:
  bool factorise_here() {
    negative_ = false;
    log_determinant_ = 0;
    double largest = 0;
    for (int k = 0; k < size_; ++k) {
      const int last_row = std::min(k + below, size_ - 1);
      int pivot = k;
      for (int i = k + 1; i <= last_row; ++i) {
        if (std::abs((*this)(i, k)) > std::abs((*this)(pivot, k))) pivot = i;
      }
      pivots_[static_cast<std::size_t>(k)] = pivot;
      if (pivot != k) {
        swap(k, pivot);
        negative_ = !negative_;
      }
      double& top = (*this)(k, k);
      if (!std::isfinite(top)) return false;
      largest = std::max(largest, std::abs(top));
      const double least = std::numeric_limits<double>::epsilon() * largest;
      if (std::abs(top) <= least) top = std::copysign(std::max(least, std::numeric_limits<double>::min()), top);
      negative_ ^= top < 0;
      log_determinant_ += std::log(std::abs(top));
      for (int i = k + 1; i <= last_row; ++i) eliminate(k, i);
    }
    return true;
  }

  void substitute_here(Eigen::VectorXd& right) {
    for (int k = 0; k < size_; ++k) {
      std::swap(right[k], right[pivots_[static_cast<std::size_t>(k)]]);
      const int last_row = std::min(k + below, size_ - 1);
      for (int i = k + 1; i <= last_row; ++i) right[i] -= (*this)(i, k) * right[k];
    }
    for (int k = size_ - 1; k >= 0; --k) {
      if (k < columns_) {
        const int count = band_end(k) - k - 1;
        right[k] -= Eigen::Map<const Eigen::VectorXd>(&(*this)(k, k) + 1, count).dot(right.segment(k + 1, count));
      }
      for (int j = std::max(k + 1, columns_); j < size_; ++j) right[k] -= (*this)(k, j) * right[j];
      right[k] /= (*this)(k, k);
    }
  }

  static constexpr int below = band_below + most_borders, above = band_above;
  static constexpr int width = 2 * below + above + 1;  // pivoting fills `below` more diagonals
  using Band = Eigen::Array<double, width, 1>;         // from the lowest diagonal up
  using Border = Eigen::Array<double, most_borders, 1>;
  struct Row {
    Band band;
    Border border;
  };

  // The first column that row k no longer holds in its band.
  int band_end(int k) const { return std::min(k + below + above + 1, columns_); }

  void swap(int k, int pivot) {
    for (int j = k; j < band_end(k); ++j) std::swap((*this)(k, j), (*this)(pivot, j));
    for (int j = std::max(k, columns_); j < size_; ++j) std::swap((*this)(k, j), (*this)(pivot, j));
  }
  void eliminate(int k, int i) {
    double& entry = (*this)(i, k);
    if (entry == 0) return;
    const double factor = entry /= (*this)(k, k);
    if (k < columns_) {
      const int count = band_end(k) - k - 1;
      double* row = &entry + 1;
      const double* top = &(*this)(k, k) + 1;
      for (int j = 0; j < count; ++j) row[j] -= factor * top[j];
    }
    for (int j = std::max(k + 1, columns_); j < size_; ++j) (*this)(i, j) -= factor * (*this)(k, j);
  }

  int columns_ = 0, size_ = 0;
  bool negative_ = false;
  double log_determinant_ = 0;
  std::vector<Row> rows_;
  std::vector<int> pivots_;  // the row that took this one's place
};

}  // namespace fam
