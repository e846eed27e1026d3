#include "fam/posterior.h"

#include "fam/eigenvectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double observed_information = 1e-12, widest_posterior = 0.9;  // of what counts as observed: the contract's
constexpr double unobserved_share = 0.01;                               // chosen, not measured

constexpr double normal_999 = 3.0902;  // the normal quantile that one in 1000 exceeds
constexpr double unobservable = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Posterior::Posterior(Index unknowns)
    : information_(unknowns, unknowns),
      vectors_(unknowns, unknowns),
      covariance_(unknowns, unknowns),
      diagonal_(unknowns, unknowns),
      width_(unknowns),
      hidden_(unknowns) {}

// In units of the priors, where there is none one so wide that observed_information is what counts as observed.
// Where all are as wide, the directions are those of the information itself.
void Posterior::set(const Eigen::Ref<const MatrixXd>& slopes, const VectorXd& prior_sd) {
  const Index count = prior_sd.size();
  const double least = 1 / (widest_posterior * widest_posterior) - 1;  // information over the prior's
  information_.noalias() = slopes.transpose() * slopes;
  diagonal_ = information_;
  diagonalise(diagonal_, vectors_);
  const double largest = diagonal_.diagonal().maxCoeff();
  const double widest = largest > 0 ? std::sqrt(least / (observed_information * largest)) : 1;
  for (Index k = 0; k < count; ++k) width_[k] = std::isnan(prior_sd[k]) ? widest : prior_sd[k];
  const bool as_wide = width_.minCoeff() == width_.maxCoeff();
  const auto& in_widths = as_wide ? diagonal_ : information_;
  information_ = width_.asDiagonal() * in_widths * width_.asDiagonal();
  if (!as_wide) diagonalise(information_, vectors_);
  covariance_.setZero();
  hidden_.setZero();
  unobservable_.clear();
  free_directions_ = 0;
  for (Index k = 0; k < count; ++k) {
    vectors_.col(k).array() *= width_.array();
    const double variance = 1 / (1 + std::max(0.0, information_(k, k)));
    covariance_.noalias() += variance * vectors_.col(k) * vectors_.col(k).transpose();
    if (information_(k, k) > least) continue;
    hidden_ += variance * vectors_.col(k).cwiseAbs2();
    add_direction(k, prior_sd);
  }
}

void Posterior::add_direction(Index k, const VectorXd& prior_sd) {
  VectorXd direction = vectors_.col(k).normalized();
  direction = direction.unaryExpr([](double c) { return std::abs(c) < 1e-6 ? 0.0 : c; });
  bool has_prior = false;
  for (Index j = 0; j < direction.size(); ++j) has_prior |= direction[j] != 0 && !std::isnan(prior_sd[j]);
  free_directions_ += has_prior ? 0 : 1;
  unobservable_.push_back(std::move(direction));
}

bool Posterior::is_observable(Index unknown) const {
  return hidden_[unknown] <= unobserved_share * covariance_(unknown, unknown);
}

void tell(const Posterior& posterior, const VectorXd& x, const VectorXd& unit, Estimate& estimate) {
  for (Index k = 0; k < x.size(); ++k) {
    const bool observable = posterior.is_observable(k);
    estimate.observable[static_cast<std::size_t>(k)] = observable;
    estimate.mean[k] = observable ? x[k] * unit[k] : unobservable;
  }
  put_covariance(posterior.covariance(), unit, estimate);
  estimate.unobservable = posterior.unobservable();
}

void put_covariance(const MatrixXd& covariance, const VectorXd& unit, Estimate& estimate) {
  estimate.covariance = covariance;
  for (Index k = 0; k < unit.size(); ++k) {
    const bool observable = estimate.observable[static_cast<std::size_t>(k)];
    estimate.covariance.row(k) *= observable ? unit[k] : unobservable;
    estimate.covariance.col(k) *= observable ? unit[k] : unobservable;
  }
  estimate.sd = estimate.covariance.diagonal().cwiseSqrt();
}

double chi_squared_999(int degrees) {
  if (degrees <= 0) return std::numeric_limits<double>::infinity();
  const double share = 2.0 / (9 * degrees);
  return degrees * std::pow(1 - share + normal_999 * std::sqrt(share), 3);
}

}  // namespace fam
