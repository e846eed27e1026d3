#include "fam/estimator.h"

#include "fam/eigenvectors.h"
#include "fam/estimation_rows.h"
#include "fam/measured_rows.h"
#include "fam/posterior.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace fam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using scene::Measurement;
using scene::Status;
using scene::Unknown;
using Start = Solver::Start;
using UnknownKind = scene::Unknown::Kind;

// All chosen, not measured.
constexpr int most_iterations = 200;
constexpr double first_damping = 1e-3, warm_damping = 1e-9, least_damping = 1e-12, most_damping = 1e12;
constexpr double least_scaling = 1e-6;  // of the damping matrix, of its largest
constexpr double converged_decrease = 1e-8;
constexpr double flat_decrease = 1e-6;       // of 1 + chi-squared: the model's own error may hide what is less
constexpr double small_step = 0.01;          // in standard deviations
constexpr double least_information = 1e-12;  // of the largest, below which a step would be round-off
constexpr double clear_information = 1e-9;   // of pivots, above which no direction is near that
constexpr double longest_step = 2;           // in the unknowns' own units
constexpr double longest_place_step = 0.2;   // of the length
constexpr double good_share = 0.9;           // of the decrease that a step promised: the damping falls fast
// Of steps that fall faster the closer they end to where their slopes were taken, a rate that steps of at most so many
// standard deviations tell; the last step is left to three times that. Measured on 2200 estimates of the study's tip
// forces and contacts: 20 are left more than 1e-4 deviations off, none more than 1.4e-3; with a rate from longer steps
// 0.09.
constexpr double longest_reach = 10, sure_rate = 3;
constexpr double least_change = 0.1;  // of a step, to one turned down: else it would be, too
constexpr int more_starts = 12;       // where places are unknown and the first minimum does not fit

// The digits of a number mirrored at the point: 1/2, 1/4, 3/4, ... of base 2 (Halton, Numer. Math. 2, 1960).
double radical_inverse(int number, int base) {
  double value = 0;
  for (double digit = 1.0 / base; number > 0; number /= base, digit /= base) value += digit * (number % base);
  return value;
}

}  // namespace

struct Estimator::Impl {
  EstimationRows rows;
  Estimate result;

  // Of Gauss-Newton: x, where the rods stand, and rows at x and at the trial.
  VectorXd x, stand, start, trial, turned_down, moved, gradient, scaling, along, residual, trial_residual;
  MatrixXd slopes, information, damped, vectors;
  Eigen::LDLT<MatrixXd> factors, damped_factors;  // of the information, damped
  Posterior posterior;
  bool solved_at_x = false;  // the rods, and the slopes are those at x or near it
  bool has_factors = false;  // of these slopes

  Impl(scene::EstimationProblem problem, const Options& asked)
      : rows(std::move(problem), asked), posterior(static_cast<Index>(rows.given().unknowns.size())) {
    result.problem = rows.given();
    take_memory(rows.unit().size());
    for (Index k = 0; k < x.size(); ++k) x[k] = rows.prior_mean(k);
    rows.bound(x);
  }

  void take_memory(Index count) {
    for (VectorXd* v :
         {&x, &stand, &start, &trial, &turned_down, &moved, &gradient, &scaling, &along, &result.mean, &result.sd})
      v->resize(count);
    for (VectorXd* v : {&residual, &trial_residual}) v->resize(rows.count());
    slopes.resize(rows.count(), count);
    for (MatrixXd* m : {&information, &damped, &vectors, &result.covariance}) m->resize(count, count);
    for (Eigen::LDLT<MatrixXd>* f : {&factors, &damped_factors}) *f = Eigen::LDLT<MatrixXd>(count);
    result.observable.resize(static_cast<std::size_t>(count));
  }

  const Unknown& unknown(Index k) const { return rows.unknown(k); }

  bool fail(Status status, const std::string& message) {
    result.status = status;
    result.message = message;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (VectorXd* values : {&result.mean, &result.sd}) values->setConstant(none);
    result.covariance.setConstant(none);
    std::fill(result.observable.begin(), result.observable.end(), false);
    result.unobservable.clear();
    result.chi_squared = none;
    result.fits = false;
    solved_at_x = false;
    return false;
  }

  // Residual and slopes at x; false where the rods cannot be solved there. Where they stand there already only the
  // measurements are new.
  bool evaluate() {
    if (!solved_at_x && !rows.solve(x, Start::unloaded)) return fail(rows.status(), rows.message());
    if (!rows.put_residual(x, residual)) return fail(Status::not_finite, "a position or wrench is not finite");
    return solved_at_x || renew_slopes();
  }

  bool renew_slopes() {
    has_factors = false;
    solved_at_x = rows.put_slopes(slopes);
    return solved_at_x || fail(Status::not_finite, "a derivative is not finite");
  }

  // Shortens a step to what the unknowns may change by at once.
  void limit(VectorXd& step) const {
    double share = 1;
    for (Index k = 0; k < step.size(); ++k) {
      const double most = unknown(k).kind == UnknownKind::place ? longest_place_step : longest_step;
      share = std::min(share, most / std::max(std::abs(step[k]), most));
    }
    step *= share;
  }

  // The full step's size in standard deviations, the root of what it could bring chi-squared down by: g^T H^-1 g where
  // H is not small.
  double full_step() {
    if (!has_factors) {
      information.noalias() = slopes.transpose() * slopes;
      factors.compute(information);
      has_factors = true;
    }
    gradient.noalias() = slopes.transpose() * residual;
    return information.diagonal().maxCoeff() > 0 ? std::sqrt(possible_decrease()) : 0;
  }

  double possible_decrease() {
    if (factors.vectorD().minCoeff() > clear_information * factors.vectorD().maxCoeff()) {
      along = factors.solve(gradient);
      return gradient.dot(along);
    }
    damped = information;
    diagonalise(damped, vectors);
    along.noalias() = vectors.transpose() * gradient;
    const double largest = damped.diagonal().maxCoeff();
    double decrease = 0;
    for (Index k = 0; k < along.size(); ++k) {
      if (damped(k, k) > least_information * largest) decrease += along[k] * along[k] / damped(k, k);
    }
    return decrease;
  }

  // A step with this damping to `trial`; what it promises to bring chi-squared down by.
  double step(double damping) {
    damped = information;
    damped.diagonal() += damping * scaling;
    damped_factors.compute(damped);
    moved = damped_factors.solve(gradient);
    moved = -moved;
    limit(moved);
    trial = x + moved;
    rows.bound(trial);
    moved = trial - x;
    along.noalias() = information * moved;
    return -(2 * gradient.dot(moved) + moved.dot(along));
  }

  // To a trial that brings chi-squared down; what that step promised, or nothing where there is none. Each starts from
  // x: what was turned down may lie on another branch.
  std::optional<double> descend(double& damping, double chi_squared, double possible) {
    for (turned_down = x; damping <= most_damping; damping *= 10) {
      const double promised = step(damping);
      if (trial == x) break;
      if ((trial - turned_down).norm() < least_change * moved.norm()) continue;
      turned_down = trial;
      const bool solved = rows.solve(trial, solved_at_x ? Start::last_solution : Start::unloaded);
      if (solved && rows.put_residual(trial, trial_residual) && trial_residual.squaredNorm() < chi_squared)
        return promised;
      solved_at_x = rows.go_back() && solved_at_x;
      if (possible <= flat_decrease * (1 + chi_squared)) break;
    }
    return std::nullopt;
  }

  // Steps in standard deviations. Each leaves to the next one a share that grows with how far its end is from where its
  // slopes were taken, at the rate that the last one told.
  struct Steps {
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

  // False: a bound or a limit shortens the step.
  bool take_last_step(double size) {
    if (!(step(least_damping) > good_share * size * size)) return false;
    x.swap(trial);
    residual.noalias() += slopes * moved;
    return true;
  }

  bool minimise() {
    const bool warm = solved_at_x;
    if (!evaluate()) return false;
    double damping = warm ? warm_damping : first_damping, chi_squared = residual.squaredNorm();
    bool as_promised = true;
    Steps steps;
    for (result.iterations = 0; result.iterations < most_iterations; ++result.iterations) {
      const double small = std::sqrt(converged_decrease * (1 + chi_squared));
      double size = full_step();
      steps.see_left(size);
      if (!as_promised || steps.want_new_slopes(size, small)) {
        if (!renew_slopes()) return false;
        steps.way = 0;
        steps.see_left(size = full_step());
      }
      stand = x;
      if (!std::isfinite(chi_squared + size))
        return fail(Status::not_finite, "chi-squared overflows: measurements by far too many of their deviations away");
      if (!(size > small)) return true;
      if (solved_at_x && steps.is_last(size, steps.way, small) && take_last_step(size)) return true;
      scaling = information.diagonal().cwiseMax(least_scaling * information.diagonal().maxCoeff());
      const std::optional<double> promised = descend(damping, chi_squared, size * size);
      if (!promised && solved_at_x && steps.way > 0) {
        as_promised = false;
        continue;
      }
      if (!promised) return is_flat(chi_squared);
      steps.take(std::sqrt(moved.dot(along)));
      x.swap(trial);
      residual.swap(trial_residual);
      solved_at_x = true;
      const double decrease = chi_squared - residual.squaredNorm();
      as_promised = decrease > good_share * *promised;
      damping = std::max(least_damping, damping * (as_promised ? 1e-3 : 0.1));
      chi_squared -= decrease;
    }
    return fail(Status::not_converged, "200 iterations");
  }

  // No step brought chi-squared down (the model's own error is reached, or a bound holds the unknowns): at a minimum
  // where next to nothing is left in unknowns that are not at their bounds.
  bool is_flat(double chi_squared) {
    for (Index k = 0; k < x.size(); ++k) {
      moved = x;
      moved[k] -= std::copysign(1e-9, gradient[k]);
      rows.bound(moved);
      if (moved[k] == x[k]) gradient[k] = 0;
    }
    return possible_decrease() <= flat_decrease * (1 + chi_squared) ||
           fail(Status::not_converged, "no step brings chi-squared down");
  }

  // Covariance, what is observed, and whether the model fits.
  void judge() {
    posterior.set(slopes.topRows(rows.measured_count()), rows.prior_sd());
    tell(posterior, x, rows.unit(), result);
    result.chi_squared = residual.squaredNorm();
    result.degrees_of_freedom = static_cast<int>(residual.size() - x.size()) + posterior.free_directions();
    result.fits = result.chi_squared <= chi_squared_999(result.degrees_of_freedom);
  }

  // From where x is.
  bool search() {
    const bool found = minimise();
    if (!found) return false;
    result.status = Status::converged;
    judge();
    return true;
  }

  bool has_unknown_place() const {
    return std::any_of(rows.given().unknowns.begin(), rows.given().unknowns.end(),
                       [](const Unknown& u) { return u.kind == UnknownKind::place; });
  }

  // Places spread over the rod, all else where priors have it.
  void set_start(int number) {
    static constexpr std::array bases{2, 3, 5, 7, 11, 13};
    std::size_t place = 0;
    for (Index k = 0; k < x.size(); ++k) {
      const Unknown& u = unknown(k);
      x[k] = rows.prior_mean(k);
      if (u.kind == UnknownKind::place) x[k] = radical_inverse(number, bases[place++ % bases.size()]);
    }
    rows.bound(x);
    solved_at_x = false;
  }

  // Where a load stands has several minima: where the first one does not fit, others are looked for.
  bool search_elsewhere() {
    VectorXd best_x;
    double best = HUGE_VAL;
    const auto keep = [&] {
      if (result.converged() && result.chi_squared < best) best = result.chi_squared, best_x = x;
    };
    keep();
    for (int number = 1; number <= more_starts && !(result.converged() && result.fits); ++number) {
      set_start(number);
      if (search()) keep();
    }
    if (best == HUGE_VAL) return false;
    x = best_x;
    solved_at_x = false;
    return search();
  }

  const Estimate& track() {
    start = x;
    if (solved_at_x) x = stand;
    bool found = search();
    if ((!found || !result.fits) && has_unknown_place()) found = search_elsewhere();
    if (!found) x = start;
    else rows.put_into(result.problem, x);
    if (found)
      result.message = result.fits ? ""
                                   : "no fit was found: chi-squared is larger than one in 1000 would be; the model, or "
                                     "a start far from the truth";
    return result;
  }
};

Estimator::Estimator(scene::EstimationProblem problem, const Options& options)
    : impl_(std::make_unique<Impl>(std::move(problem), options)) {}
Estimator::Estimator(Estimator&&) noexcept = default;
Estimator& Estimator::operator=(Estimator&&) noexcept = default;
Estimator::~Estimator() = default;

const scene::EstimationProblem& Estimator::problem() const {
  return impl_->rows.given();
}

void Estimator::set_measurement(std::size_t scene, std::size_t measurement, const scene::Measurement& value) {
  const auto& scenes = problem().scenes;
  if (scene >= scenes.size() || measurement >= scenes[scene].measurements.size())
    throw scene::SceneError("measurements: there is none to set at " + std::to_string(measurement) + " of scene " +
                            std::to_string(scene));
  Measurement& kept = impl_->rows.measurement(scene, measurement);
  static const std::string source = "estimation", path = "measurement";
  if (value.value.index() != kept.value.index())
    throw scene::SceneError(source + ": " + path + ": must be of the kind of the one before it");
  scene::validate(value, scene::length_mm(scenes[scene].scene), source, path);
  if (!has_slopes_of(value, kept)) impl_->solved_at_x = false;
  kept = value;
}

Estimate Estimator::estimate() {
  return impl_->track();
}

const Estimate& Estimator::track() {
  if (impl_->rows.reserve()) impl_->solved_at_x = false;
  return impl_->track();
}

}  // namespace fam
