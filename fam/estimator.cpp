#include "fam/estimator.h"

#include "fam/eigenvectors.h"
#include "fam/estimated_rods.h"
#include "fam/measured_rows.h"
#include "fam/posterior.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using scene::Measurement;
using scene::Status;
using scene::Unknown;
using UnknownKind = scene::Unknown::Kind;

// All chosen, not measured.
constexpr int most_iterations = 200;
constexpr double first_damping = 1e-3, warm_damping = 1e-9, least_damping = 1e-12, most_damping = 1e12;
constexpr double least_scaling = 1e-6;  // of the damping matrix, of its largest
constexpr double converged_decrease = 1e-8;
constexpr double least_information = 1e-12;  // of the largest, below which a step would be round-off
constexpr double longest_step = 2;           // in the unknowns' own units
constexpr double longest_place_step = 0.2;   // of the length
constexpr double good_share = 0.9;           // of the decrease that a step promised: the damping falls fast
constexpr int more_starts = 12;              // where places are unknown and the first minimum does not fit

// The digits of a number mirrored at the point: 1/2, 1/4, 3/4, ... of base 2 (Halton, Numer. Math. 2, 1960).
double radical_inverse(int number, int base) {
  double value = 0;
  for (double digit = 1.0 / base; number > 0; number /= base, digit /= base) value += digit * (number % base);
  return value;
}

}  // namespace

struct Estimator::Impl {
  scene::EstimationProblem given;
  Index measured_rows = 0;
  std::vector<double> values;  // that are put in, in the scene's units
  VectorXd unit, prior_sd;     // prior_sd in units of their own, NaN where there is none
  Estimate result;
  EstimatedRods rods;

  // Of Gauss-Newton: x in units of their own; rows at x, the measurements' and then the priors', and at the trial.
  VectorXd x, start, trial, moved, gradient, scaling, along, residual, trial_residual;
  MatrixXd slopes, trial_slopes, information, damped, vectors;
  Eigen::LDLT<MatrixXd> factors;
  Posterior posterior;

  Impl(scene::EstimationProblem problem, const Options& asked)
      : given(std::move(problem)), rods(given, asked), posterior(static_cast<Index>(given.unknowns.size())) {
    result.problem = given;
    take_memory(static_cast<Index>(given.unknowns.size()));
    for (Index k = 0; k < x.size(); ++k) {
      unit[k] = unit_of(unknown(k), given);
      x[k] = unknown(k).prior_mean / unit[k];
      prior_sd[k] = unknown(k).prior_sd ? *unknown(k).prior_sd / unit[k] : std::numeric_limits<double>::quiet_NaN();
    }
    bound(x);
  }

  void take_memory(Index count) {
    Index rows = 0;
    for (const scene::MeasuredScene& scene : given.scenes)
      for (const Measurement& measurement : scene.measurements) rows += rows_of(measurement);
    measured_rows = rows;
    for (const Unknown& u : given.unknowns) rows += u.prior_sd ? 1 : 0;
    for (VectorXd* v :
         {&unit, &prior_sd, &x, &start, &trial, &moved, &gradient, &scaling, &along, &result.mean, &result.sd})
      v->resize(count);
    for (VectorXd* v : {&residual, &trial_residual}) v->resize(rows);
    for (MatrixXd* m : {&slopes, &trial_slopes}) m->resize(rows, count);
    for (MatrixXd* m : {&information, &damped, &vectors, &result.covariance}) m->resize(count, count);
    factors = Eigen::LDLT<MatrixXd>(count);
    result.observable.resize(static_cast<std::size_t>(count));
    values.resize(static_cast<std::size_t>(count));
  }

  const Unknown& unknown(Index k) const { return given.unknowns[static_cast<std::size_t>(k)]; }

  void bound(VectorXd& at) const {
    for (Index k = 0; k < at.size(); ++k) at[k] = within_bounds(unknown(k), given, at[k] * unit[k]) / unit[k];
  }

  bool fail(Status status, const std::string& message) {
    result.status = status;
    result.message = message;
    return false;
  }

  void put_in(const VectorXd& at) {
    for (Index k = 0; k < at.size(); ++k) values[static_cast<std::size_t>(k)] = at[k] * unit[k];
    rods.put(values);
  }

  // Residual and slopes at a point; false where the rod cannot be solved there.
  bool evaluate(const VectorXd& at, VectorXd& r, MatrixXd& J) {
    put_in(at);
    r.setZero();
    J.setZero();
    Index row = 0;
    for (std::size_t i = 0; i < given.scenes.size(); ++i) {
      if (!rods.solve(i)) return fail(rods.status(), rods.message());
      for (const Measurement& measurement : given.scenes[i].measurements) {
        const int count = rows_of(measurement);
        put_residual(rods.solver(i), measurement, r.segment(row, count));
        put_slopes(rods.solver(i), given.scenes[i], i, given.unknowns, measurement, J.middleRows(row, count));
        row += count;
      }
    }
    for (Index k = 0; k < at.size(); ++k) J.col(k) *= unit[k];
    for (Index k = 0; k < at.size(); ++k) {
      if (std::isnan(prior_sd[k])) continue;
      r[row] = (at[k] - unknown(k).prior_mean / unit[k]) / prior_sd[k];
      J(row++, k) = 1 / prior_sd[k];
    }
    return (r.allFinite() && J.allFinite()) || fail(Status::not_finite, "a derivative is not finite");
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

  // How much a full step could bring chi-squared down: g^T H^-1 g where H is not small.
  double possible_decrease() {
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
    factors.compute(damped);
    moved = factors.solve(gradient);
    moved = -moved;
    limit(moved);
    trial = x + moved;
    bound(trial);
    moved = trial - x;
    along.noalias() = information * moved;
    return -(2 * gradient.dot(moved) + moved.dot(along));
  }

  bool minimise() {
    if (!evaluate(x, residual, slopes)) return false;
    double damping = result.converged() ? warm_damping : first_damping, chi_squared = residual.squaredNorm();
    for (result.iterations = 0; result.iterations < most_iterations; ++result.iterations) {
      information.noalias() = slopes.transpose() * slopes;
      gradient.noalias() = slopes.transpose() * residual;
      const double largest = information.diagonal().maxCoeff();
      if (!(largest > 0) || possible_decrease() <= converged_decrease * (1 + chi_squared)) return true;
      scaling = information.diagonal().cwiseMax(least_scaling * largest);
      double promised = 0;
      bool better = false;
      while (!better && damping <= most_damping) {
        promised = step(damping);
        if (trial == x) break;
        better = evaluate(trial, trial_residual, trial_slopes) && trial_residual.squaredNorm() < chi_squared;
        if (!better) damping *= 10;
      }
      if (!better) return evaluate(x, residual, slopes) && is_flat(chi_squared);
      x.swap(trial);
      residual.swap(trial_residual);
      slopes.swap(trial_slopes);
      const double decrease = chi_squared - residual.squaredNorm();
      damping = std::max(least_damping, damping * (decrease > good_share * promised ? 1e-3 : 0.1));
      chi_squared -= decrease;
    }
    return fail(Status::not_converged, "200 iterations");
  }

  // No step brought chi-squared down (the solver's own digits are reached, or a bound holds the unknowns): at a minimum
  // where what is left lies in unknowns at their bounds, or is the round-off of a chi-squared with sqrt(eps) digits of
  // its slopes.
  bool is_flat(double chi_squared) {
    for (Index k = 0; k < x.size(); ++k) {
      moved = x;
      moved[k] -= std::copysign(1e-9, gradient[k]);
      bound(moved);
      if (moved[k] == x[k]) gradient[k] = 0;
    }
    return possible_decrease() <= 1e-6 * (1 + chi_squared) ||
           fail(Status::not_converged, "no step brings chi-squared down");
  }

  // Covariance, what is observed, and whether the model fits.
  void judge() {
    posterior.set(slopes.topRows(measured_rows), prior_sd);
    tell(posterior, x, unit, result);
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
    return std::any_of(given.unknowns.begin(), given.unknowns.end(),
                       [](const Unknown& u) { return u.kind == UnknownKind::place; });
  }

  // Places spread over the rod, all else where priors have it.
  void set_start(int number) {
    static constexpr std::array bases{2, 3, 5, 7, 11, 13};
    std::size_t place = 0;
    for (Index k = 0; k < x.size(); ++k) {
      const Unknown& u = unknown(k);
      x[k] = u.prior_mean / unit[k];
      if (u.kind == UnknownKind::place) x[k] = radical_inverse(number, bases[place++ % bases.size()]);
    }
    bound(x);
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
    return search();
  }

  const Estimate& track() {
    start = x;
    bool found = search();
    if ((!found || !result.fits) && has_unknown_place()) found = search_elsewhere();
    if (!found) x = start;
    put_in(x);
    rods.put_into(result.problem);
    if (found)
      result.message =
          result.fits ? "" : "the model does not fit the measurements: chi-squared is larger than one in 1000 would be";
    return result;
  }
};

Estimator::Estimator(scene::EstimationProblem problem, const Options& options)
    : impl_(std::make_unique<Impl>(std::move(problem), options)) {}
Estimator::Estimator(Estimator&&) noexcept = default;
Estimator& Estimator::operator=(Estimator&&) noexcept = default;
Estimator::~Estimator() = default;

const scene::EstimationProblem& Estimator::problem() const {
  return impl_->given;
}

void Estimator::set_measurement(std::size_t scene, std::size_t measurement, const scene::Measurement& value) {
  impl_->given.scenes.at(scene).measurements.at(measurement) = value;
}

Estimate Estimator::estimate() {
  return impl_->track();
}

const Estimate& Estimator::track() {
  return impl_->track();
}

}  // namespace fam
