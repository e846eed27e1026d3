// Newton's banded matrix with columns and rows added, which make it regular where it is not itself: Eigen's sparse LU
// with partial pivoting over all of it.
#pragma once

#include "exact_reference/band_system.h"

#include <Eigen/SparseLU>

#include <vector>

namespace exact_reference {

class BorderedSystem {
 public:
  // [A columns; rows ...], A the band matrix of size N (not factorised): k columns of height N + k, k rows of width N.
  // The pattern must stay the same from one call to the next. False: singular.
  bool factorise(BandSystem& A, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& rows);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const { return lu_.solve(b); }
  Eigen::MatrixXd solve_transposed(const Eigen::MatrixXd& b) { return lu_.transpose().solve(b); }
  bool has_negative_determinant() { return lu_.signDeterminant() < 0; }

 private:
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
};

}  // namespace exact_reference
