#include "fam/place_cells.h"

#include "scene/load_visitor.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using scene::Unknown;

// Over L: from a corner to the cells beside it. Chosen: far below what any sensor tells of a place.
constexpr double gap = 1e-9;

// Curvature jumps where it acts.
bool is_moment(const scene::Scene& scene, const Unknown& unknown) {
  return scene::visit_load(
      scene.loads[unknown.index], [](const scene::Force&) { return false; }, [](const scene::Moment&) { return true; },
      [](const scene::DistributedForce&) { return false; }, [](const scene::Gravity&) { return false; },
      [](const scene::Tendon&) { return false; });
}

bool are_places_of_one_kind(const Unknown& a, const Unknown& b, const scene::EstimationProblem& problem) {
  if (a.kind != Unknown::Kind::place || b.kind != Unknown::Kind::place || a.scene != b.scene) return false;
  const auto& loads = problem.scenes[a.scene].scene.loads;
  return loads[a.index].index() == loads[b.index].index();
}

std::vector<double> corners_of(const Unknown& unknown, const scene::MeasuredScene& measured) {
  std::vector<double> corners;
  if (unknown.kind != Unknown::Kind::place) return corners;
  const double L_mm = scene::length_mm(measured.scene);
  const bool by_moment = is_moment(measured.scene, unknown);
  const auto add = [&](double s_mm, bool at_tip) {
    const double s = s_mm / L_mm;
    if (s > 3 * gap && (s < 1 - 3 * gap || at_tip)) corners.push_back(std::min(s, 1.0));
  };
  for (const scene::Measurement& m : measured.measurements) {
    // At the tip a sensor of curvature sees a moment there, and none below it.
    if (std::holds_alternative<scene::CurvatureMeasurement>(m.value)) add(m.s_mm, by_moment);
    if (std::holds_alternative<scene::RotationMeasurement>(m.value) && by_moment) add(m.s_mm, false);
  }
  double end_mm = 0;
  for (const scene::Section& section : measured.scene.sections) {
    end_mm += section.length_mm;
    if (by_moment) add(end_mm, false);
  }
  std::sort(corners.begin(), corners.end());
  const auto same = [](double a, double b) { return b - a < 3 * gap; };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  return corners;
}

// Of exp(-chi-squared / 2) along the place, over its value at the minimum, with all else where that place wants it.
struct AlongPlace {
  double mass = 0, mean = 0, square = 0;  // the integral, and of the way from the minimum
};

AlongPlace along_place(double low, double high, double variance, double pull) {
  constexpr double nothing = 30;  // exp(-30) of the value at the minimum
  const double shift = std::abs(pull) * variance;
  const double reach = 2 * nothing * variance / (shift + std::sqrt(shift * shift + 2 * nothing * variance));
  low = std::min(0.0, std::max(low, -reach));
  high = std::max(0.0, std::min(high, reach));
  constexpr int steps = 64;
  AlongPlace sum;
  for (int i = 0; i <= steps; ++i) {
    const double t = low + (high - low) * i / steps;
    const double simpson = i % steps == 0 ? 1 : 2 + 2 * (i % 2);
    const double weight = simpson * (high - low) / (3 * steps) * std::exp(-t * t / (2 * variance) - t * pull);
    sum.mass += weight;
    sum.mean += weight * t;
    sum.square += weight * t * t;
  }
  if (sum.mass > 0) sum.mean /= sum.mass, sum.square /= sum.mass;
  return sum;
}

// The mass of a cell over its exp(-chi-squared / 2), and its second moment about a place `off` before its minimum.
double mass_of_cell(Index place, const MatrixXd& covariance, const AlongPlace& along, const VectorXd& off,
                    MatrixXd& moment) {
  const double variance = covariance(place, place);
  const VectorXd by_place = covariance.col(place) / variance;        // all else, by the place
  moment = covariance - variance * by_place * by_place.transpose();  // at a place
  MatrixXd all_else = moment;
  all_else.row(place).setZero();
  all_else.col(place).setZero();
  all_else(place, place) = 1;
  moment += off * off.transpose() + along.mean * (off * by_place.transpose() + by_place * off.transpose()) +
            along.square * by_place * by_place.transpose();
  return along.mass * std::sqrt(std::max(0.0, all_else.determinant()));
}

}  // namespace

PlaceCells::PlaceCells(const scene::EstimationProblem& problem) {
  const auto& unknowns = problem.unknowns;
  for (const Unknown& unknown : unknowns) corners_.push_back(corners_of(unknown, problem.scenes[unknown.scene]));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (are_places_of_one_kind(unknowns[i], unknowns[j], problem))
        alikes_.push_back({static_cast<Index>(i), static_cast<Index>(j)});
    }
  }
}

int PlaceCells::places() const {
  return static_cast<int>(
      std::count_if(corners_.begin(), corners_.end(), [](const auto& corners) { return !corners.empty(); }));
}

std::size_t PlaceCells::number_at(Index unknown, double place_over_L) const {
  const auto& corners = corners_[static_cast<std::size_t>(unknown)];
  return static_cast<std::size_t>(std::upper_bound(corners.begin(), corners.end(), place_over_L) - corners.begin());
}

PlaceCells::Cell PlaceCells::cell(Index unknown, std::size_t number) const {
  const auto& corners = corners_[static_cast<std::size_t>(unknown)];
  constexpr double none = std::numeric_limits<double>::infinity();
  return {number > 0 ? std::min(corners[number - 1] + gap, 1.0) : -none,
          number < corners.size() ? corners[number] - gap : none};
}

bool PlaceCells::have_same_order(const VectorXd& a, const VectorXd& b) const {
  return std::all_of(alikes_.begin(), alikes_.end(), [&](const auto& pair) {
    return (a[pair.first] < a[pair.second]) == (b[pair.first] < b[pair.second]);
  });
}

void put_second_moment(const PlaceCells& cells, std::span<const CellMinimum> minima, const CellMinimum& lowest,
                       double widest, MatrixXd& covariance) {
  covariance.setZero();
  double all = 0, least = lowest.chi_squared;
  for (const CellMinimum& minimum : minima) least = std::min(least, minimum.chi_squared);
  MatrixXd moment, bounded;
  for (const CellMinimum& minimum : minima) {
    if (!cells.have_same_order(minimum.x, lowest.x)) continue;
    // The lowest one is not cut off at the rod's ends, and its covariance is the inverse of its information.
    const bool is_lowest = &minimum == &lowest;
    const double low = is_lowest ? minimum.cell.low : std::max(minimum.cell.low, 0.0);
    const double high = is_lowest ? minimum.cell.high : std::min(minimum.cell.high, 1.0);
    const Index place = minimum.place;
    const double at = minimum.x[place];
    const auto mass = [&](const MatrixXd& of) {
      const AlongPlace along = along_place(low - at, high - at, of(place, place), minimum.gradient[place]);
      return mass_of_cell(place, of, along, minimum.x - lowest.x, moment);
    };
    bounded = minimum.covariance;
    bounded.diagonal().array() += widest * widest;
    bounded = minimum.covariance - minimum.covariance * bounded.ldlt().solve(minimum.covariance);
    const double weight = std::exp((least - minimum.chi_squared) / 2) * mass(bounded);
    if (is_lowest) mass(minimum.covariance);
    covariance += weight * moment;
    all += weight;
  }
  covariance /= all;
}

}  // namespace fam
