// A banded linear system: LAPACK's LU factors with partial pivoting.
#pragma once

#include "scene/branch_watch.h"

#include <vector>

namespace fem_reference {

class BandSystem {
 public:
  BandSystem(int size, int lower, int upper);  // diagonals below and above the main one

  void set_zero();
  double& entry(int row, int column) {
    return band_[static_cast<std::size_t>(column * rows_ + lower_ + upper_ + row - column)];
  }
  // Puts `unknown` = right hand side in place of its equation.
  void fix(int unknown);
  bool factorise();  // false: singular

  // The determinant of the matrix last factorised: its sign, of the pivots and of the row exchanges, and the logarithm
  // of its size.
  scene::Determinant determinant() const;

  void solve(std::vector<double>& right_hand_side) const;  // which becomes the solution

 private:
  int size_, lower_, upper_;
  int rows_;                  // LAPACK's: the diagonals, and as many as `lower` for the row exchanges
  std::vector<double> band_;  // column by column
  std::vector<int> exchanged_;
};

}  // namespace fem_reference
