// What measurements tell of the unknowns at a solution: covariance, and the directions of which they tell nothing.
#pragma once

#include "fam/estimator.h"

#include <Eigen/Core>

#include <vector>

namespace fam {

// In units of the unknowns' own. Takes memory as it is made; set() allocates for directions that cannot be observed
// alone.
class Posterior {
 public:
  explicit Posterior(Eigen::Index unknowns);

  // slopes: of the measured rows; prior_sd: NaN where there is none.
  void set(const Eigen::Ref<const Eigen::MatrixXd>& slopes, const Eigen::VectorXd& prior_sd);

  const Eigen::MatrixXd& covariance() const { return covariance_; }
  // An unknown is, where at most a hundredth of its variance comes from directions that are not.
  bool is_observable(Eigen::Index unknown) const;
  // Of length 1: the posterior is no narrower than 0.9 of the prior or, without one, the information below 1e-12 of
  // the largest.
  const std::vector<Eigen::VectorXd>& unobservable() const { return unobservable_; }
  // Of these, those without a prior.
  int free_directions() const { return free_directions_; }

 private:
  void add_direction(Eigen::Index k, const Eigen::VectorXd& prior_sd);

  Eigen::MatrixXd information_, vectors_, covariance_, diagonal_;
  Eigen::VectorXd width_, hidden_;
  std::vector<Eigen::VectorXd> unobservable_;
  int free_directions_ = 0;
};

// Mean, sd, covariance and directions of an estimate, whose vectors have their sizes; x: the unknowns over their units.
void tell(const Posterior& posterior, const Eigen::VectorXd& x, const Eigen::VectorXd& unit, Estimate& estimate);

// Covariance and deviations anew, of what is observable.
void put_covariance(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& unit, Estimate& estimate);

// Below this, chi-squared lies in 999 of 1000 (Wilson and Hilferty, PNAS 17, 1931).
double chi_squared_999(int degrees);

}  // namespace fam
