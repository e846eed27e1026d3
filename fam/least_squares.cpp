#include "fam/least_squares.h"

#include "fam/eigenvectors.h"

#include <algorithm>
#include <cmath>

namespace fam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using scene::Status;
using Start = Solver::Start;
using UnknownKind = scene::Unknown::Kind;

// All chosen, not measured.
constexpr double first_damping = 1e-3, warm_damping = 1e-9, least_damping = 1e-12, most_damping = 1e12;
constexpr double least_scaling = 1e-6;  // of the damping matrix, of its largest
constexpr double converged_decrease = 1e-8;
constexpr double flat_decrease = 1e-6;       // of 1 + chi-squared: the model's own error may hide what is less
constexpr double flat_deviations = 0.03;     // from the minimum: as far as the model may be off (model_share)
constexpr double small_step = 0.01;          // in standard deviations
constexpr double least_information = 1e-12;  // of the largest, below which a step would be round-off
constexpr double clear_information = 1e-9;   // of pivots, above which no direction is near that
constexpr double longest_place_step = 0.2;   // of the length
constexpr double good_share = 0.9;           // of the decrease that a step promised: the damping falls fast
// Of steps that fall faster the closer they end to where their slopes were taken, a rate that steps of at most so many
// standard deviations tell; the last step is left to three times that. Measured on 2200 estimates of the study's tip
// forces and contacts: 20 are left more than 1e-4 deviations off, none more than 1.4e-3; with a rate from longer steps
// 0.09.
constexpr double longest_reach = 10, sure_rate = 3;
constexpr double least_change = 0.1;  // of a step, to one turned down: else it would be, too
constexpr int hopeless_after = 3;     // steps, when what the slopes promise is believed

// Steps in standard deviations. Each leaves to the next one a share that grows with how far its end is from where its
// slopes were taken, at the rate that the last one told.
struct StepSizes {
  double way = 0;  // since the slopes were taken
  double last_size = 0, last_reach = 0, rate = HUGE_VAL;

  void take(double size) {
    last_size = size;
    last_reach = way += size;
  }
  void see_left(double size) {
    rate = last_size > 0 && last_reach < longest_reach ? size / (last_size * last_reach) : HUGE_VAL;
  }
  double left_by(double size, double from_way) const { return rate * size * (from_way + size); }
  // Whether what this step leaves is small, so that the rods need not be solved there.
  bool is_last(double size, double from_way, double small) const {
    return sure_rate * left_by(size, from_way) <= small;
  }
  // Old slopes do for the last step but one, not for the last, nor for what it tells.
  bool want_new_slopes(double size, double small) const {
    const bool is_last_but_one = left_by(left_by(size, way), 0) <= small;
    return way > small_step && (size <= small || is_last(size, 0, small) || !is_last_but_one);
  }
};

}  // namespace

LeastSquares::LeastSquares(scene::EstimationProblem problem, const Options& options)
    : rows_(std::move(problem), options), cells_(rows_.given()) {
  const Index count = rows_.unit().size();
  for (VectorXd* v : {&x_, &stand_, &trial_, &turned_down_, &moved_, &gradient_, &scaling_, &along_, &low_, &high_})
    v->resize(count);
  for (VectorXd* v : {&residual_, &trial_residual_}) v->resize(rows_.count());
  slopes_.resize(rows_.count(), count);
  for (MatrixXd* m : {&information_, &damped_, &vectors_}) m->resize(count, count);
  for (Eigen::LDLT<MatrixXd>* f : {&factors_, &damped_factors_}) *f = Eigen::LDLT<MatrixXd>(count);
  for (Index k = 0; k < count; ++k) x_[k] = rows_.prior_mean(k);
  rows_.bound(x_);
}

void LeastSquares::start_at(const VectorXd& x) {
  x_ = x;
  rows_.bound(x_);
  is_solved_ = false;
}

bool LeastSquares::fail(Status status, const std::string& message) {
  status_ = status;
  message_ = message;
  is_solved_ = false;
  return false;
}

bool LeastSquares::give_up(const std::string& message) {
  has_value_ = true;
  return fail(Status::not_converged, message);
}

bool LeastSquares::evaluate() {
  if (!is_solved_ && !rows_.solve(x_, Start::unloaded)) return fail(rows_.status(), rows_.message());
  if (!rows_.put_residual(x_, residual_)) return fail(Status::not_finite, "a position or wrench is not finite");
  return is_solved_ || renew_slopes();
}

bool LeastSquares::renew_slopes() {
  has_factors_ = false;
  is_solved_ = rows_.put_slopes(slopes_);
  return is_solved_ || fail(Status::not_finite, "a derivative is not finite");
}

void LeastSquares::limit(VectorXd& step) const {
  double share = 1;
  for (Index k = 0; k < step.size(); ++k) {
    const double most = rows_.unknown(k).kind == UnknownKind::place ? longest_place_step : longest_step;
    share = std::min(share, most / std::max(std::abs(step[k]), most));
  }
  step *= share;
}

double LeastSquares::full_step() {
  if (!has_factors_) {
    information_.noalias() = slopes_.transpose() * slopes_;
    factors_.compute(information_);
    has_factors_ = true;
  }
  gradient_.noalias() = slopes_.transpose() * residual_;
  return information_.diagonal().maxCoeff() > 0 ? std::sqrt(possible_decrease()) : 0;
}

double LeastSquares::possible_decrease() {
  if (factors_.vectorD().minCoeff() > clear_information * factors_.vectorD().maxCoeff()) {
    along_ = factors_.solve(gradient_);
    return gradient_.dot(along_);
  }
  damped_ = information_;
  diagonalise(damped_, vectors_);
  along_.noalias() = vectors_.transpose() * gradient_;
  const double largest = damped_.diagonal().maxCoeff();
  double decrease = 0;
  for (Index k = 0; k < along_.size(); ++k) {
    if (damped_(k, k) > least_information * largest) decrease += along_[k] * along_[k] / damped_(k, k);
  }
  return decrease;
}

void LeastSquares::set_cells() {
  for (Index k = 0; k < x_.size(); ++k) {
    const PlaceCells::Cell cell = cells_.cell(k, cells_.number_at(k, x_[k]));
    low_[k] = cell.low;
    high_[k] = cell.high;
  }
}

void LeastSquares::bound(VectorXd& to, bool inside) const {
  rows_.bound(to);
  for (Index k = 0; k < to.size(); ++k) {
    if (inside || k == limits_.place) to[k] = std::min(std::max(to[k], low_[k]), high_[k]);
  }
}

double LeastSquares::step(double damping, bool inside) {
  damped_ = information_;
  damped_.diagonal() += damping * scaling_;
  damped_factors_.compute(damped_);
  moved_ = damped_factors_.solve(gradient_);
  moved_ = -moved_;
  limit(moved_);
  trial_ = x_ + moved_;
  along_ = trial_;
  bound(trial_, inside);
  if (trial_ != along_) {
    hold();
    bound(trial_, inside);
  }
  moved_ = trial_ - x_;
  along_.noalias() = information_ * moved_;
  return -(2 * gradient_.dot(moved_) + moved_.dot(along_));
}

void LeastSquares::hold() {
  moved_ = -gradient_;
  for (Index k = 0; k < x_.size(); ++k) {
    if (trial_[k] != along_[k]) moved_ -= (trial_[k] - x_[k]) * damped_.col(k);
  }
  for (Index k = 0; k < x_.size(); ++k) {
    if (trial_[k] == along_[k]) continue;
    damped_.row(k).setZero();
    damped_.col(k).setZero();
    damped_(k, k) = 1;
    moved_[k] = trial_[k] - x_[k];
  }
  damped_factors_.compute(damped_);
  along_ = damped_factors_.solve(moved_);
  moved_.swap(along_);
  limit(moved_);
  trial_ = x_ + moved_;
}

bool LeastSquares::left_cells() const {
  return (trial_.array() < low_.array() || trial_.array() > high_.array()).any();
}

bool LeastSquares::is_lower_at_trial(double chi_squared) {
  const bool solved = rows_.solve(trial_, is_solved_ ? Start::last_solution : Start::unloaded);
  if (solved && rows_.put_residual(trial_, trial_residual_)) {
    least_rise_ = std::min(least_rise_, trial_residual_.squaredNorm() - chi_squared);
    if (least_rise_ < 0) return true;
  }
  is_solved_ = rows_.go_back() && is_solved_;
  return false;
}

std::optional<double> LeastSquares::descend(double& damping, double chi_squared, double possible) {
  bool inside = false;
  least_rise_ = HUGE_VAL;
  for (turned_down_ = x_; damping <= most_damping; damping *= 10) {
    const double promised = step(damping, inside);
    if (trial_ == x_ || (inside && promised <= converged_decrease * (1 + chi_squared))) break;
    if ((trial_ - turned_down_).norm() < least_change * moved_.norm()) continue;
    turned_down_ = trial_;
    if (is_lower_at_trial(chi_squared)) return promised;
    if (possible <= flat_decrease * (1 + chi_squared)) break;
    if (!inside && left_cells()) inside = true, damping /= 10;
  }
  return std::nullopt;
}

bool LeastSquares::take_last_step(double size) {
  if (!(step(least_damping, true) > good_share * size * size)) return false;
  x_.swap(trial_);
  residual_.noalias() += slopes_ * moved_;
  return true;
}

bool LeastSquares::minimise(const Limits& limits) {
  limits_ = limits;
  const bool warm = is_solved_;
  has_value_ = false;
  set_cells();
  bound(x_, true);
  if (!evaluate()) return false;
  double damping = warm ? warm_damping : first_damping, chi_squared = residual_.squaredNorm();
  bool as_promised = true;
  StepSizes steps;
  for (iterations_ = 0; iterations_ < limits_.steps; ++iterations_) {
    const double small = std::sqrt(converged_decrease * (1 + chi_squared));
    double size = full_step();
    steps.see_left(size);
    if (!as_promised || steps.want_new_slopes(size, small)) {
      if (!renew_slopes()) return false;
      steps.way = 0;
      steps.see_left(size = full_step());
    }
    stand_ = x_;
    if (!std::isfinite(chi_squared + size))
      return fail(Status::not_finite, "chi-squared overflows: measurements by far too many of their deviations away");
    if (!(size > small)) return true;
    if (iterations_ >= hopeless_after && chi_squared - size * size > limits_.chi_squared)
      return fail(Status::not_converged, "no minimum here that counts");
    if (is_solved_ && steps.is_last(size, steps.way, small) && take_last_step(size)) return true;
    scaling_ = information_.diagonal().cwiseMax(least_scaling * information_.diagonal().maxCoeff());
    const std::optional<double> promised = descend(damping, chi_squared, size * size);
    if (!promised && is_solved_ && steps.way > 0) {
      as_promised = false;
      continue;
    }
    if (!promised) return is_flat(chi_squared);
    steps.take(std::sqrt(moved_.dot(along_)));
    x_.swap(trial_);
    residual_.swap(trial_residual_);
    is_solved_ = true;
    set_cells();
    const double decrease = chi_squared - residual_.squaredNorm();
    as_promised = decrease > good_share * *promised;
    damping = std::max(least_damping, damping * (as_promised ? 1e-3 : 0.1));
    chi_squared -= decrease;
  }
  return give_up(std::to_string(limits_.steps) + " iterations");
}

bool LeastSquares::is_flat(double chi_squared) {
  for (Index k = 0; k < x_.size(); ++k) {
    moved_ = x_;
    moved_[k] -= std::copysign(1e-9, gradient_[k]);
    bound(moved_, true);
    if (moved_[k] == x_[k]) gradient_[k] = 0;
  }
  constexpr double flat_rise = flat_deviations * flat_deviations;  // beside a fold steps rise, or lead nowhere
  const double flat = std::max(flat_decrease * (1 + chi_squared), least_rise_ <= flat_rise ? flat_rise : 0);
  return possible_decrease() <= flat || step(least_damping, true) <= flat || give_up("no step brings chi-squared down");
}

}  // namespace fam
