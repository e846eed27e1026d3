#include "fam/estimator.h"

#include "fam/least_squares.h"
#include "fam/measured_rows.h"
#include "fam/place_cells.h"
#include "fam/posterior.h"

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
using Start = Solver::Start;
using UnknownKind = scene::Unknown::Kind;

// All chosen, not measured.
constexpr int more_starts = 12;         // where places are unknown and the first minimum does not fit
constexpr double counting = 30;         // above the lowest chi-squared, a minimum that still counts
constexpr double reach_of_corners = 5;  // in standard deviations: corners within it are looked behind
constexpr double clearly_lower = 1;     // of chi-squared: a place to which a search did not come to its end
constexpr int most_cell_steps = 30;     // in a cell

// The digits of a number mirrored at the point: 1/2, 1/4, 3/4, ... of base 2 (Halton, Numer. Math. 2, 1960).
double radical_inverse(int number, int base) {
  double value = 0;
  for (double digit = 1.0 / base; number > 0; number /= base, digit /= base) value += digit * (number % base);
  return value;
}

}  // namespace

struct Estimator::Impl {
  LeastSquares fit;
  EstimationRows& rows;
  const PlaceCells& cells;
  Estimate result;

  Posterior posterior;
  VectorXd before, start;
  // Of the cells looked at.
  std::vector<CellMinimum> minima;
  std::size_t minima_count = 0, lowest = 0, lowest_found = 0, searched_cells = 0;
  MatrixXd second_moment, told;

  Impl(scene::EstimationProblem problem, const Options& asked)
      : fit(std::move(problem), asked), rows(fit.rows()), cells(fit.cells()), posterior(fit.x().size()) {
    const Index count = fit.x().size();
    result.problem = rows.given();
    for (VectorXd* v : {&before, &start, &result.mean, &result.sd}) v->resize(count);
    for (MatrixXd* m : {&second_moment, &result.covariance}) m->resize(count, count);
    result.observable.resize(static_cast<std::size_t>(count));
    take_minima();
  }

  void take_minima() {
    const Index count = start.size();
    std::size_t most = 1;
    for (Index k = 0; k < count; ++k) most += cells.count(k) - 1;
    minima.assign(most, {VectorXd(count), 0, MatrixXd(count, count), VectorXd(count), 0, {}});
  }

  // Where a sensor was moved.
  void renew_cells() {
    fit.renew_cells();
    take_minima();
  }

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
    fit.forget_rods();
    return false;
  }

  // Covariance, what is observed, and whether the model fits.
  void judge() {
    told = fit.slopes().topRows(rows.measured_count());
    for (Index k = 0; k < told.cols(); ++k) {
      if (rows.is_at_chosen_bound(k, fit.x()[k])) told.col(k).setZero();  // what pushes it there tells nothing else
    }
    posterior.set(told, rows.prior_sd());
    tell(posterior, fit.x(), rows.unit(), result);
    result.chi_squared = fit.residual().squaredNorm();
    result.degrees_of_freedom = static_cast<int>(fit.residual().size() - fit.x().size()) + posterior.free_directions();
    result.fits = result.chi_squared <= chi_squared_999(result.degrees_of_freedom);
  }

  bool search(const LeastSquares::Limits& limits = {}) {
    const bool found = fit.minimise(limits);
    result.iterations = fit.iterations();
    if (!found) return fail(fit.status(), fit.message());
    result.status = Status::converged;
    judge();
    return true;
  }

  bool search_from(const VectorXd& x) {
    fit.start_at(x);
    return search();
  }

  bool has_unknown_place() const {
    return std::any_of(rows.given().unknowns.begin(), rows.given().unknowns.end(),
                       [](const Unknown& u) { return u.kind == UnknownKind::place; });
  }

  // Places spread over the rod, all else where priors have it.
  VectorXd spread_start(int number) const {
    static constexpr std::array bases{2, 3, 5, 7, 11, 13};
    std::size_t place = 0;
    VectorXd x(fit.x().size());
    for (Index k = 0; k < x.size(); ++k) {
      const bool is_place = rows.unknown(k).kind == UnknownKind::place;
      x[k] = is_place ? radical_inverse(number, bases[place++ % bases.size()]) : rows.prior_mean(k);
    }
    return x;
  }

  // Where a load stands has several minima: where the first one does not fit, others are looked for.
  bool search_elsewhere() {
    VectorXd best_x;
    double best = HUGE_VAL;
    const auto keep = [&] {
      if (result.converged() && result.chi_squared < best) best = result.chi_squared, best_x = fit.x();
    };
    keep();
    for (int number = 1; number <= more_starts && !(result.converged() && result.fits); ++number) {
      if (search_from(spread_start(number))) keep();
    }
    return best < HUGE_VAL && search_from(best_x);
  }

  // From the middle of a place's cell, all else as at the lowest minimum. Where chi-squared falls ever more slowly
  // along a valley (a force that grows towards the clamp), where it was left counts too.
  void search_cell(Index place, std::size_t number) {
    ++searched_cells;
    const PlaceCells::Cell cell = cells.cell(place, number);
    start = minima[lowest].x;
    start[place] = (std::max(cell.low, 0.0) + std::min(cell.high, 1.0)) / 2;
    fit.start_at(start);
    const double most = minima[lowest].chi_squared + counting;
    const bool found = search({place, most, most_cell_steps});
    if (!found && !fit.has_value()) return;
    if (!found) judge();
    if (result.chi_squared < most) keep_minimum(place, found);
  }

  // Where the search stands.
  void put_minimum(Index place, CellMinimum& minimum) {
    minimum.x = fit.x();
    minimum.chi_squared = result.chi_squared;
    minimum.covariance = posterior.covariance();
    minimum.gradient.noalias() = fit.slopes().transpose() * fit.residual();
    minimum.place = place;
    minimum.cell = cells.cell(place, cells.number_at(place, minimum.x[place]));
  }

  void keep_minimum(Index place, bool found) {
    CellMinimum& minimum = minima[minima_count];
    put_minimum(place, minimum);
    const double lower_by = minima[lowest].chi_squared - minimum.chi_squared;
    if (lower_by > (found ? 0 : clearly_lower)) lowest = minima_count;
    if (found && minimum.chi_squared < minima[lowest_found].chi_squared) lowest_found = minima_count;
    ++minima_count;
  }

  // Whether a corner at the end of this cell is near the lowest minimum.
  bool is_within_reach(Index place, std::size_t number) const {
    const CellMinimum& best = minima[lowest];
    const PlaceCells::Cell cell = cells.cell(place, number);
    const double reach = reach_of_corners * std::sqrt(best.covariance(place, place));
    return cell.low - best.x[place] < reach && best.x[place] - cell.high < reach;
  }

  // Of the places with corners, the one that is the fewest deviations off one.
  Index nearest_to_a_corner() const {
    Index nearest = 0;
    double least = HUGE_VAL;
    for (Index k = 0; k < fit.x().size(); ++k) {
      if (!cells.has_corners(k)) continue;
      const double x = fit.x()[k];
      const PlaceCells::Cell cell = cells.cell(k, cells.number_at(k, x));
      const double off = std::min(x - cell.low, cell.high - x) / std::sqrt(posterior.covariance()(k, k));
      if (off < least) least = off, nearest = k;
    }
    return nearest;
  }

  // To the lowest minimum, of the other cells of each place in turn, too: all of them, or those whose corners are near.
  // Its covariance is that of all that count.
  bool settle_among_cells(bool all) {
    minima_count = lowest = lowest_found = searched_cells = 0;
    keep_minimum(nearest_to_a_corner(), true);
    for (Index k = 0; k < start.size(); ++k) {
      const std::size_t here = cells.number_at(k, minima[lowest].x[k]);
      for (std::size_t number = 0; number < cells.count(k); ++number) {
        const bool is_next = number + 1 == here || number == here + 1;
        if (number != here && (all || (is_next && is_within_reach(k, number)))) search_cell(k, number);
      }
    }
    if (searched_cells == 0) return true;
    if (!search_from(minima[lowest].x)) {
      lowest = lowest_found;
      if (!search_from(minima[lowest].x)) return false;
    }
    put_minimum(minima[lowest].place, minima[lowest]);
    put_second_moment(cells, {minima.data(), minima_count}, minima[lowest], LeastSquares::longest_step, second_moment);
    put_covariance(second_moment, rows.unit(), result);
    return true;
  }

  const Estimate& track() {
    before = fit.x();
    const bool warm = fit.is_solved();
    if (warm) fit.start_where_rods_stand();
    bool found = search();
    const bool elsewhere = (!found || !result.fits) && has_unknown_place();
    if (elsewhere) found = search_elsewhere();
    if (found && cells.places() > 0) found = settle_among_cells(!warm || elsewhere);
    if (!found) {
      fit.start_at(before);
    } else {
      rows.put_into(result.problem, fit.x());
      result.message = result.fits ? ""
                                   : "no fit was found: chi-squared is larger than one in 1000 would be; the model, or "
                                     "a start far from the truth";
    }
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
  if (!has_slopes_of(value, kept)) impl_->fit.forget_rods();
  const bool has_moved = value.s_mm != kept.s_mm;
  kept = value;
  if (has_moved) impl_->renew_cells();
}

Estimate Estimator::estimate() {
  return impl_->track();
}

const Estimate& Estimator::track() {
  if (impl_->rows.reserve()) impl_->fit.forget_rods();
  return impl_->track();
}

}  // namespace fam
