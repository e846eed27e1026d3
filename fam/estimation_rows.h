// The rows of a least squares problem: what is measured of the rods, and the priors.
#pragma once

#include "fam/estimated_rods.h"

#include "scene/estimation.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace fam {

// Unknowns x in units of their own (unit_of); rows over their standard deviations, the measurements' first, then one
// for each prior. Takes memory as it is made.
class EstimationRows {
 public:
  EstimationRows(scene::EstimationProblem problem, const Options& options);

  const scene::EstimationProblem& given() const { return given_; }
  scene::Measurement& measurement(std::size_t scene, std::size_t index) {
    return given_.scenes.at(scene).measurements.at(index);
  }
  const scene::Unknown& unknown(Eigen::Index k) const { return given_.unknowns[static_cast<std::size_t>(k)]; }
  const Eigen::VectorXd& unit() const { return unit_; }
  const Eigen::VectorXd& prior_sd() const { return prior_sd_; }  // in units of their own, NaN where there is none
  double prior_mean(Eigen::Index k) const { return unknown(k).prior_mean / unit_[k]; }
  Eigen::Index count() const { return count_; }
  Eigen::Index measured_count() const { return measured_count_; }

  void bound(Eigen::VectorXd& x) const;
  bool is_at_chosen_bound(Eigen::Index k, double x) const { return fam::is_at_chosen_bound(unknown(k), x * unit_[k]); }

  bool reserve() { return rods_.reserve(); }  // as EstimatedRods

  // Solves the rods at x; false: why, in status() and message().
  bool solve(const Eigen::VectorXd& x, Solver::Start start);
  // Those that the last solve() moved, to their solutions before it. False: one has lost it.
  bool go_back();
  // Of the rods as they were solved last, at x. False: not finite.
  bool put_residual(const Eigen::VectorXd& x, Eigen::VectorXd& residual) const;
  bool put_slopes(Eigen::MatrixXd& slopes) const;
  void put_into(scene::EstimationProblem& problem, const Eigen::VectorXd& x);

  scene::Status status() const { return rods_.status(); }
  const std::string& message() const { return rods_.message(); }

 private:
  void put(const Eigen::VectorXd& x);

  scene::EstimationProblem given_;
  Eigen::VectorXd unit_, prior_sd_;
  Eigen::Index measured_count_ = 0, count_ = 0;
  std::vector<double> values_;  // in the scene's units
  EstimatedRods rods_;
  std::size_t moved_ = 0;  // scenes that the last solve() solved
};

}  // namespace fam
