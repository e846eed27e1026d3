// The banded linear system and the dual numbers of fam/.
#include "fam/band_solver.h"
#include "fam/dual.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <random>

namespace {

// Against Eigen's dense LU; with a zero on the diagonal, so that rows must change places.
TEST(BandSystem, SolvesAndTellsTheSignOfTheDeterminant) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  for (const int size : {1, 4, 9, 40}) {
    fam::BandSystem<4, 6> system;
    system.resize(size);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right(size);
    system.set_zero();
    for (int i = 0; i < size; ++i) {
      for (int j = std::max(0, i - 4); j <= std::min(size - 1, i + 6); ++j) {
        matrix(i, j) = system(i, j) = i == j && i > 0 && i % 3 == 0 ? 0 : normal(generator);
      }
      right[i] = system.right()[i] = normal(generator);
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> dense(matrix);
    ASSERT_TRUE(system.factorise());
    system.substitute();
    EXPECT_LT((system.right() - dense.solve(right)).norm(), 1e-10 * dense.solve(right).norm()) << size;
    EXPECT_EQ(system.determinant_is_negative(), dense.determinant() < 0) << size;
  }
  fam::BandSystem<4, 6> singular;
  singular.resize(2);
  EXPECT_FALSE(singular.factorise());
}

// Sine, root and quotient against central differences.
TEST(Dual, Derivatives) {
  const auto f = [](auto x, auto y) {
    using std::sin;
    using std::sqrt;
    return sin(x) * sqrt(y) / (1 + x * y) - y;
  };
  const fam::Dual<2> x(0.7, {1, 0}), y(1.9, {0, 1});
  const fam::Dual<2> value = f(x, y);
  const double h = 1e-6;
  EXPECT_NEAR(value.value, f(0.7, 1.9), 1e-16);
  EXPECT_NEAR(value.slope[0], (f(0.7 + h, 1.9) - f(0.7 - h, 1.9)) / (2 * h), 1e-9);
  EXPECT_NEAR(value.slope[1], (f(0.7, 1.9 + h) - f(0.7, 1.9 - h)) / (2 * h), 1e-9);
}

}  // namespace
