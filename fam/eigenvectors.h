// Eigenvectors of small symmetric matrices, without taking memory, as Eigen's SelfAdjointEigenSolver does for matrices
// of dynamic size.
#pragma once

#include <Eigen/Core>

namespace fam {

// Jacobi's method: it keeps small eigenvalues of graded positive semidefinite matrices to their own digits. The matrix
// becomes diagonal; the columns of `vectors`, of its size, are the eigenvectors of its diagonal's entries.
void diagonalise(Eigen::MatrixXd& matrix, Eigen::MatrixXd& vectors);

}  // namespace fam
