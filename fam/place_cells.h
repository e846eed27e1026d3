// Where measurements have corners in the place of a load. A load that passes a curvature sensor bends the rod there or
// not (a force: a corner; a moment: a jump), and so do a moment and a rotation sensor or a border of sections. Between
// corners lie cells, in which chi-squared is smooth; each can have a minimum of its own, inside or at a corner.
#pragma once

#include "scene/estimation.h"

#include <Eigen/Core>

#include <span>
#include <utility>
#include <vector>

namespace fam {

class PlaceCells {
 public:
  struct Cell {
    double low, high;  // over L; infinite beyond the last corners
  };

  explicit PlaceCells(const scene::EstimationProblem& problem);

  bool has_corners(Eigen::Index unknown) const { return count(unknown) > 1; }
  int places() const;  // with corners
  // Of an unknown: 1 but for places with corners.
  std::size_t count(Eigen::Index unknown) const { return corners_[static_cast<std::size_t>(unknown)].size() + 1; }
  std::size_t number_at(Eigen::Index unknown, double place_over_L) const;
  Cell cell(Eigen::Index unknown, std::size_t number) const;
  // Whether loads of one kind stand in the same order along the rod: else it is their names that have changed.
  bool have_same_order(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;

 private:
  std::vector<std::vector<double>> corners_;                   // of the unknowns, over L
  std::vector<std::pair<Eigen::Index, Eigen::Index>> alikes_;  // places of loads of one kind
};

// The lowest chi-squared of a cell, in the unknowns' own units.
struct CellMinimum {
  Eigen::VectorXd x;
  double chi_squared = 0;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd gradient;  // of chi-squared / 2: not zero by a place that a corner holds
  Eigen::Index place = 0;    // the unknown that the cell bounds
  PlaceCells::Cell cell{};
};

// The second moment about the lowest minimum of a posterior that is normal in each cell: exp(-chi-squared / 2) of the
// linearised measurements, cut off at the ends of the cell. Where one minimum alone counts and its cell is wide, its
// covariance. Other minima: with loads in the same order, and no less sure than to `widest` of the unknowns' units,
// beyond which measurements are not linear (two forces at one place).
void put_second_moment(const PlaceCells& cells, std::span<const CellMinimum> minima, const CellMinimum& lowest,
                       double widest, Eigen::MatrixXd& covariance);

}  // namespace fam
