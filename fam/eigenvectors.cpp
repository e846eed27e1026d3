#include "fam/eigenvectors.h"

#include <Eigen/Jacobi>

#include <cmath>
#include <limits>

namespace fam {

void diagonalise(Eigen::MatrixXd& matrix, Eigen::MatrixXd& vectors) {
  constexpr int most_sweeps = 50;  // some 6 to 10 converge
  vectors.setIdentity();
  Eigen::JacobiRotation<double> rotation;
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < most_sweeps; ++sweep) {
    rotated = false;
    for (Eigen::Index q = 1; q < matrix.cols(); ++q) {
      for (Eigen::Index p = 0; p < q; ++p) {
        const double size = std::sqrt(std::abs(matrix(p, p) * matrix(q, q)));
        if (!(std::abs(matrix(p, q)) > std::numeric_limits<double>::epsilon() * size)) continue;
        rotated |= rotation.makeJacobi(matrix, p, q);
        matrix.applyOnTheLeft(p, q, rotation.adjoint());
        matrix.applyOnTheRight(p, q, rotation);
        vectors.applyOnTheRight(p, q, rotation);
      }
    }
  }
}

}  // namespace fam
