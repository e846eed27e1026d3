// The lowest chi-squared near some values of the unknowns: Gauss-Newton with Levenberg's damping (fam/estimator.h).
#pragma once

#include "fam/estimation_rows.h"
#include "fam/place_cells.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>
#include <optional>
#include <string>

namespace fam {

// Unknowns x in units of their own. Takes memory as it is made.
class LeastSquares {
 public:
  static constexpr int most_steps = 200;
  static constexpr double longest_step = 2;  // in the unknowns' own units; chosen
  struct Limits {
    std::optional<Eigen::Index> place{};  // must not leave the cell of its start
    double chi_squared = HUGE_VAL;        // from the third step on, given up where the slopes promise more
    int steps = most_steps;
  };

  LeastSquares(scene::EstimationProblem problem, const Options& options);

  EstimationRows& rows() { return rows_; }
  const PlaceCells& cells() const { return cells_; }

  void renew_cells() { cells_ = PlaceCells(rows_.given()); }  // where measurements have moved

  // From x, to the lowest chi-squared. False: status() and message() say why.
  bool minimise(const Limits& limits);
  // To start at x from the unloaded rods; from the rods as they stand; with rods and slopes as they are.
  void start_at(const Eigen::VectorXd& x);
  void start_where_rods_stand() { x_ = stand_; }
  void forget_rods() { is_solved_ = false; }

  const Eigen::VectorXd& x() const { return x_; }
  const Eigen::VectorXd& residual() const { return residual_; }
  const Eigen::MatrixXd& slopes() const { return slopes_; }
  bool is_solved() const { return is_solved_; }  // the rods, and the slopes are those at x or near it
  int iterations() const { return iterations_; }
  // Of a failure: a chi-squared was reached, which fell no more or too slowly.
  bool has_value() const { return has_value_; }
  scene::Status status() const { return status_; }
  const std::string& message() const { return message_; }

 private:
  // Residual and slopes at x; false where the rods cannot be solved there. Where they stand there already only the
  // measurements are new.
  bool evaluate();
  bool renew_slopes();
  // Shortens a step to what the unknowns may change by at once.
  void limit(Eigen::VectorXd& step) const;
  // The full step's size in standard deviations, the root of what it could bring chi-squared down by: g^T H^-1 g where
  // H is not small.
  double full_step();
  double possible_decrease();
  void set_cells();
  // To what the unknowns can be; `inside`: without leaving the cells.
  void bound(Eigen::VectorXd& to, bool inside) const;
  // A step with this damping to `trial`; what it promises to bring chi-squared down by. Unknowns that reach a bound
  // stay there, and the others go where these want them.
  double step(double damping, bool inside);
  // The step anew, by `damped`, where bounds made `trial` of `along`.
  void hold();
  // Whether a step passed a corner.
  bool left_cells() const;
  // Solves at the trial; back to where the rods were if chi-squared is not lower.
  bool is_lower_at_trial(double chi_squared);
  // To a trial that brings chi-squared down; what that step promised, or nothing where there is none. Each starts from
  // x: what was turned down may lie on another branch. Where a step beyond a corner is turned down, the next ones end
  // there.
  std::optional<double> descend(double& damping, double chi_squared, double possible);
  // False: a bound or a limit shortens the step.
  bool take_last_step(double size);
  // No step brought chi-squared down (the model's own error is reached, or a bound holds the unknowns): at a minimum
  // where next to nothing is left in unknowns that are not at their bounds.
  bool is_flat(double chi_squared);
  bool fail(scene::Status status, const std::string& message);
  bool give_up(const std::string& message);

  EstimationRows rows_;
  PlaceCells cells_;
  Limits limits_;
  // x, where the rods stand, and rows at x and at the trial.
  Eigen::VectorXd x_, stand_, trial_, turned_down_, moved_, gradient_, scaling_, along_, residual_, trial_residual_;
  Eigen::VectorXd low_, high_;  // the cells that hold x
  Eigen::MatrixXd slopes_, information_, damped_, vectors_;
  Eigen::LDLT<Eigen::MatrixXd> factors_, damped_factors_;  // of the information, damped
  double least_rise_ = 0;  // of chi-squared at the trials from x that did not bring it down
  bool is_solved_ = false, has_factors_ = false, has_value_ = false;
  int iterations_ = 0;
  scene::Status status_ = scene::Status::not_converged;
  std::string message_;
};

}  // namespace fam
