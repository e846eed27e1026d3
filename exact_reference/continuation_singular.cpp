// Where the continuation's matrix is singular: turns that cost nothing, and null vectors.
#include "exact_reference/continuation.h"
#include "exact_reference/solution_vector.h"

#include <Eigen/QR>

#include <cmath>

namespace exact_reference {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd orthonormal(const MatrixXd& columns) {
  return columns.householderQr().householderQ() * MatrixXd::Identity(columns.rows(), columns.cols());
}

}  // namespace

// The column: of the equations' left null vector, which one solve with any column gives.
bool Continuation::set_free_turn(const Solution& at) {
  const long n = size();
  free_row_ = row_of(turned_about_axis(at.x)).head(n).normalized();
  if (!factorise(at.x, at.tangent)) return false;
  free_column_ = matrix_.solve_transposed(VectorXd::Unit(n + 2, n + 1)).col(0).head(n).normalized();
  return free_column_.allFinite();
}

bool Continuation::is_turn_free(const VectorXd& x) {
  constexpr double step = 1e-4, free = 1e-6;  // chosen, not measured
  const VectorXd turn = step * turned_about_axis(x);
  set(x[x.size() - 1]);
  const auto residual = [&](const VectorXd& at) {
    return shooting_.residual(node_states_of(at), load_factor_, weight_);
  };
  const double size = weighted(turn).lpNorm<Eigen::Infinity>();
  return (residual(x + turn) - residual(x - turn)).lpNorm<Eigen::Infinity>() < 2 * free * size;
}

void Continuation::hold_turn() {
  free_row_.resize(0);
  free_column_.resize(0);
}

Continuation::SingularVectors Continuation::smallest_vectors(const Solution& at, int count) {
  constexpr int iterations = 5;
  const long n = size() + (turns_freely() ? 2 : 1);
  MatrixXd right(n, count), left;
  for (int i = 0; i < count; ++i) right.col(i) = any_vector(n, i);
  factorise(at.x, base_.tangent);
  for (int i = 0; i < iterations; ++i) {
    left = orthonormal(matrix_.solve_transposed(right));
    right = orthonormal(matrix_.solve(left));
  }
  return {left, right};
}

Continuation::Singularity Continuation::singularity(const VectorXd& x, const SingularVectors& vectors) {
  const long n = size(), count = vectors.left.cols();
  Bordered all = bordered(x, base_.tangent);
  const long k = all.columns.cols();
  MatrixXd columns = MatrixXd::Zero(n + k + count, k + count), rows(k + count, n);
  columns.topLeftCorner(n + k, k) = all.columns;
  columns.topRightCorner(n + k, count) = vectors.left;
  columns.bottomLeftCorner(count, k) = vectors.right.bottomRows(k).transpose();
  rows << all.rows, vectors.right.topRows(n).transpose();
  wider_.factorise(all.band, columns, rows);
  MatrixXd right = MatrixXd::Zero(n + k + count, count);
  right.bottomRows(count).setIdentity();
  const MatrixXd solution = wider_.solve(right);
  Singularity result{solution.bottomRows(count), MatrixXd(n + 1, count)};
  for (long i = 0; i < count; ++i) result.null_vectors.col(i) = unweighted(solution.col(i).head(n + 1));
  return result;
}

}  // namespace exact_reference
