#include "exact_reference/stations.h"

#include "exact_reference/runge_kutta.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace exact_reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The span that a place belongs to: at a span's end the one towards the clamp. Places must not fall.
class SpanFinder {
 public:
  explicit SpanFinder(const ScaledRod& rod) : rod_(rod) {}
  std::size_t at(double place) {
    while (index_ + 1 < rod_.spans.size() && place > rod_.spans[index_].end) ++index_;
    return index_;
  }

 private:
  const ScaledRod& rod_;
  std::size_t index_ = 0;
};

std::vector<double> equal_places_and_span_ends(const ScaledRod& rod) {
  constexpr int equal_parts = 40;
  std::vector<double> ends{0};
  for (const ScaledSpan& span : rod.spans) ends.push_back(span.end);
  std::vector<double> places = ends;
  for (int i = 1; i < equal_parts; ++i) {
    const double place = static_cast<double>(i) / equal_parts;
    const auto above = std::lower_bound(ends.begin(), ends.end(), place);
    const double distance = std::min(*above - place, place - *(above - 1));
    if (distance > scene::same_place_relative) places.push_back(place);
  }
  std::sort(places.begin(), places.end());
  return places;
}

// Piecewise linear, and its inverse.
double turned_at(const std::vector<Turn>& turns, double place) {
  const auto next = std::lower_bound(turns.begin() + 1, turns.end() - 1, place,
                                     [](const Turn& turn, double p) { return turn.place < p; });
  const Turn &a = *(next - 1), &b = *next;
  return std::lerp(a.turned_rad, b.turned_rad, (place - a.place) / (b.place - a.place));
}

double place_of(const std::vector<Turn>& turns, double turned_rad) {
  const auto next = std::lower_bound(turns.begin() + 1, turns.end() - 1, turned_rad,
                                     [](const Turn& turn, double t) { return turn.turned_rad < t; });
  const Turn &a = *(next - 1), &b = *next;
  return std::lerp(a.place, b.place, (turned_rad - a.turned_rad) / (b.turned_rad - a.turned_rad));
}

// Lengths that the span's tendon paths have lost, |e_x + u0 x r| - |v + u x r|, per length at one section; each formed
// without cancellation.
class PathLoss {
 public:
  PathLoss(const ScaledRod& rod, std::size_t span) : rod_(rod), span_(rod.spans[span]), equations_(span_, 1) {}

  VectorXd at(const State& y) const {
    const auto [u, v] = equations_.strains(y);
    VectorXd loss(static_cast<long>(rod_.tendon_arms_S.size()));
    for (long k = 0; k < loss.size(); ++k) {
      const Vector3d& r = rod_.tendon_arms_S[static_cast<std::size_t>(k)];
      const Vector3d rest = Vector3d::UnitX() + span_.rest_curvature_S.cross(r);
      const Vector3d change = (v - Vector3d::UnitX()) + (u - span_.rest_curvature_S).cross(r);
      loss[k] = -change.dot(2 * rest + change) / (rest.norm() + (rest + change).norm());
    }
    return loss;
  }

  // Over the length h from `start` on, to `halvings` halvings at most.
  VectorXd over(const State& start, double h, int halvings) const {
    return refined(start, h, gauss(start, h), halvings);
  }

 private:
  VectorXd gauss(const State& start, double h) const {
    constexpr std::array places{0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155, 0.953089922969332};
    constexpr std::array weights{0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                 0.11846344252809454};
    VectorXd sum = VectorXd::Zero(static_cast<long>(rod_.tendon_arms_S.size()));
    for (std::size_t i = 0; i < places.size(); ++i) {
      sum += h * weights[i] * at(runge_kutta_step(equations_, start, places[i] * h));
    }
    return sum;
  }

  VectorXd refined(const State& start, double h, const VectorXd& whole, int halvings) const {
    constexpr double tolerance = 1e-15;
    const State middle = runge_kutta_step(equations_, start, h / 2);
    const VectorXd first = gauss(start, h / 2), second = gauss(middle, h / 2);
    if (halvings == 0 || (first + second - whole).lpNorm<Eigen::Infinity>() <= tolerance) return first + second;
    return refined(start, h / 2, first, halvings - 1) + refined(middle, h / 2, second, halvings - 1);
  }

  const ScaledRod& rod_;
  const ScaledSpan& span_;
  RodEquations equations_;
};

}  // namespace

std::vector<double> station_places(const ScaledRod& rod, const std::vector<Turn>& turns) {
  constexpr double most_turn_rad = 0.5, most_parts = 1e5;
  const std::vector<double> wanted = equal_places_and_span_ends(rod);
  if (turns.empty()) return wanted;
  std::vector<double> places{wanted[0]};
  for (std::size_t i = 1; i < wanted.size(); ++i) {
    const double start = turned_at(turns, wanted[i - 1]), end = turned_at(turns, wanted[i]);
    const int parts = static_cast<int>(std::clamp(std::ceil((end - start) / most_turn_rad), 1.0, most_parts));
    for (int k = 1; k < parts; ++k) {
      const double place = place_of(turns, std::lerp(start, end, static_cast<double>(k) / parts));
      const double distance = std::min(place - places.back(), wanted[i] - place);
      if (distance > scene::same_place_relative) places.push_back(place);
    }
    places.push_back(wanted[i]);
  }
  return places;
}

std::vector<Turn> turns_of(const ScaledRod& rod, const std::vector<PlacedState>& states) {
  SpanFinder spans(rod);
  std::vector<Turn> turns{{0, 0}};
  for (std::size_t i = 1; i < states.size(); ++i) {
    const RodEquations equations(rod.spans[spans.at(states[i].place)], 1);
    const double curvature = std::max(equations.strains(states[i - 1].state).curvature_S.norm(),
                                      equations.strains(states[i].state).curvature_S.norm());
    const double turn = curvature * (states[i].place - states[i - 1].place);
    turns.push_back({states[i].place, turns.back().turned_rad + (std::isfinite(turn) ? turn : 0)});
  }
  return turns;
}

std::vector<scene::Station> stations_of(const ScaledRod& rod, const std::vector<PlacedState>& states) {
  std::vector<scene::Station> stations;
  SpanFinder spans(rod);
  const Matrix3d back = rod.turn_about_axis.transpose();
  for (const auto& [place, y] : states) {
    const RodEquations equations(rod.spans[spans.at(place)], 1);
    const Matrix3d R = rotation_of(y.head<4>().normalized());
    const scene::Wrench own = equations.own_wrench_S(R.transpose() * y.segment<3>(4), R.transpose() * y.segment<3>(7));
    stations.push_back({place * rod.length_mm,
                        {back * R * back.transpose(), rod.length_mm * (back * y.tail<3>())},
                        rod.force_unit_N * (back * R * own.force_N),
                        rod.moment_unit_Nmm * (back * R * own.moment_Nmm)});
  }
  return stations;
}

void set_shape(scene::Equilibrium& result, const ScaledRod& rod, const std::vector<PlacedState>& states) {
  result.stations = stations_of(rod, states);
  result.tip_angle_rad = scene::tip_angle_rad(result.stations, rod.plane_normal_B);
}

std::vector<double> tendon_shortening_mm(const ScaledRod& rod, const std::vector<PlacedState>& states) {
  if (rod.tendon_paths.empty()) return {};
  constexpr int most_halvings = 10;
  SpanFinder spans(rod);
  std::vector<VectorXd> up_to(rod.spans.size() + 1, VectorXd::Zero(static_cast<long>(rod.tendon_arms_S.size())));
  std::size_t last_span = 0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const std::size_t span = spans.at(states[i].place);
    State start = states[i - 1].state;
    if (span != last_span) {
      start = RodEquations(rod.spans[last_span], 1).beyond_point_loads(start);
      up_to[span + 1] = up_to[span];
    }
    last_span = span;
    up_to[span + 1] += PathLoss(rod, span).over(start, states[i].place - states[i - 1].place, most_halvings);
  }
  std::vector<double> shortening_mm;
  for (const TendonPath& path : rod.tendon_paths) {
    shortening_mm.push_back(rod.length_mm * up_to[path.spans][static_cast<long>(path.arm)]);
  }
  return shortening_mm;
}

}  // namespace exact_reference
