#include "fam/estimation_rows.h"

#include "fam/measured_rows.h"

#include <cmath>
#include <limits>
#include <utility>

namespace fam {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

scene::EstimationProblem validated(scene::EstimationProblem problem) {
  scene::validate(problem);
  return problem;
}

}  // namespace

EstimationRows::EstimationRows(scene::EstimationProblem problem, const Options& options)
    : given_(validated(std::move(problem))),
      unit_(given_.unknowns.size()),
      prior_sd_(given_.unknowns.size()),
      values_(given_.unknowns.size()),
      rods_(given_, options) {
  for (const scene::MeasuredScene& scene : given_.scenes)
    for (const scene::Measurement& measurement : scene.measurements) measured_count_ += rows_of(measurement);
  count_ = measured_count_;
  for (Index k = 0; k < unit_.size(); ++k) {
    unit_[k] = unit_of(unknown(k), given_);
    const auto& sd = unknown(k).prior_sd;
    prior_sd_[k] = sd ? *sd / unit_[k] : std::numeric_limits<double>::quiet_NaN();
    if (sd) ++count_;
  }
}

void EstimationRows::bound(VectorXd& x) const {
  for (Index k = 0; k < x.size(); ++k) {
    const double value = x[k] * unit_[k], nearest = within_bounds(unknown(k), given_, value);
    if (nearest != value) x[k] = nearest / unit_[k];
  }
}

void EstimationRows::put(const VectorXd& x) {
  for (Index k = 0; k < x.size(); ++k) values_[static_cast<std::size_t>(k)] = x[k] * unit_[k];
  rods_.put(values_);
}

void EstimationRows::put_into(scene::EstimationProblem& problem, const VectorXd& x) {
  put(x);
  rods_.put_into(problem);
}

bool EstimationRows::solve(const VectorXd& x, Solver::Start start) {
  put(x);
  for (moved_ = 0; moved_ < given_.scenes.size(); ++moved_) {
    if (!rods_.solve(moved_, start)) return false;
  }
  return true;
}

bool EstimationRows::go_back() {
  bool all = true;
  for (std::size_t i = 0; i < moved_; ++i) all = rods_.go_back(i) && all;
  return all;
}

bool EstimationRows::put_residual(const VectorXd& x, VectorXd& residual) const {
  Index row = 0;
  for (std::size_t i = 0; i < given_.scenes.size(); ++i) {
    for (const scene::Measurement& measurement : given_.scenes[i].measurements) {
      const int count = rows_of(measurement);
      fam::put_residual(rods_.solver(i), measurement, residual.segment(row, count));
      row += count;
    }
  }
  for (Index k = 0; k < x.size(); ++k) {
    if (!std::isnan(prior_sd_[k])) residual[row++] = (x[k] - prior_mean(k)) / prior_sd_[k];
  }
  return residual.allFinite();
}

bool EstimationRows::put_slopes(MatrixXd& slopes) const {
  slopes.setZero();
  Index row = 0;
  for (std::size_t i = 0; i < given_.scenes.size(); ++i) {
    for (const scene::Measurement& measurement : given_.scenes[i].measurements) {
      const int count = rows_of(measurement);
      fam::put_slopes(rods_.solver(i), given_.scenes[i], i, given_.unknowns, unit_, measurement,
                      slopes.middleRows(row, count));
      row += count;
    }
  }
  for (Index k = 0; k < unit_.size(); ++k) slopes.col(k) *= unit_[k];
  for (Index k = 0; k < unit_.size(); ++k) {
    if (!std::isnan(prior_sd_[k])) slopes(row++, k) = 1 / prior_sd_[k];
  }
  return slopes.allFinite();
}

}  // namespace fam
