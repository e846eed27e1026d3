#include "exact_reference/bordered_system.h"

#include <algorithm>

namespace exact_reference {

bool BorderedSystem::factorise(BandSystem& A, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& rows) {
  const int n = static_cast<int>(A.size()), k = static_cast<int>(columns.cols());
  const int upper = static_cast<int>(A.upper()), lower = static_cast<int>(A.lower());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(upper + lower + 1 + 2 * k));
  for (int column = 0; column < n; ++column) {
    const int first = std::max(0, column - upper), last = std::min(n - 1, column + lower);
    for (int row = first; row <= last; ++row) entries.emplace_back(row, column, A.entry(row, column));
    for (int row = 0; row < k; ++row) entries.emplace_back(n + row, column, rows(row, column));
  }
  for (int column = 0; column < k; ++column) {
    for (int row = 0; row < n + k; ++row) entries.emplace_back(row, n + column, columns(row, column));
  }
  const bool known = matrix_.rows() == n + k;
  matrix_.resize(n + k, n + k);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  if (!known) lu_.analyzePattern(matrix_);
  lu_.factorize(matrix_);
  return lu_.info() == Eigen::Success;
}

}  // namespace exact_reference
