#include "studies/compare/error_measures.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

struct MeanAndDeviation {
  double mean, deviation;
};

MeanAndDeviation mean_and_deviation(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  double squares = 0;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, n > 1 ? std::sqrt(squares / (n - 1)) : 0};
}

}  // namespace

Eigen::Vector3d position_at_mm(const scene::Equilibrium& result, double s_mm) {
  const auto& stations = result.stations;
  const auto after = std::lower_bound(stations.begin() + 1, stations.end() - 1, s_mm,
                                      [](const scene::Station& station, double s) { return station.s_mm < s; });
  const scene::Station& b = *after;
  const scene::Station& a = *(after - 1);
  const double h = b.s_mm - a.s_mm;
  const double t = (s_mm - a.s_mm) / h;
  const Eigen::Vector3d slope_a = h * a.X_BS.rotation_BS.col(0);
  const Eigen::Vector3d slope_b = h * b.X_BS.rotation_BS.col(0);
  return (1 + 2 * t) * (1 - t) * (1 - t) * a.X_BS.position_B_mm + t * (1 - t) * (1 - t) * slope_a +
         t * t * (3 - 2 * t) * b.X_BS.position_B_mm - t * t * (1 - t) * slope_b;
}

ShapeDifference shape_difference(const scene::Equilibrium& a, const scene::Equilibrium& b, int samples) {
  ShapeDifference difference;
  const double length = a.stations.back().s_mm;
  for (int i = 1; i <= samples; ++i) {
    const double s = length * i / samples;
    const double distance = (position_at_mm(a, s) - position_at_mm(b, s)).norm();
    difference.largest_mm = std::max(difference.largest_mm, distance);
    difference.rms_mm += distance * distance / samples;
  }
  difference.rms_mm = std::sqrt(difference.rms_mm);
  return difference;
}

std::vector<Distance> station_distances(const scene::Equilibrium& a, const scene::Equilibrium& b) {
  const double hair_mm = 1e-9 * a.stations.back().s_mm;
  std::vector<Distance> shared;
  auto other = b.stations.begin();
  for (const scene::Station& station : a.stations) {
    while (other != b.stations.end() && other->s_mm < station.s_mm - hair_mm) ++other;
    if (other == b.stations.end()) break;
    if (other->s_mm > station.s_mm + hair_mm) continue;
    shared.push_back({station.s_mm, (station.X_BS.position_B_mm - other->X_BS.position_B_mm).norm()});
  }
  return shared;
}

Distance farthest(const std::vector<Distance>& distances) {
  Distance most;
  for (const Distance& distance : distances) {
    if (distance.mm > most.mm) most = distance;
  }
  return most;
}

double largest_distance_mm(const scene::Equilibrium& a, const scene::Equilibrium& b) {
  return farthest(station_distances(a, b)).mm;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

Statistics statistics(const std::vector<double>& differences) {
  std::vector<double> absolute;
  double squares = 0;
  for (const double e : differences) {
    absolute.push_back(std::abs(e));
    squares += e * e;
  }
  const auto [mean, deviation] = mean_and_deviation(differences);
  const auto [mean_absolute, absolute_deviation] = mean_and_deviation(absolute);
  return {mean, deviation, mean_absolute, absolute_deviation,
          std::sqrt(squares / static_cast<double>(differences.size()))};
}

}  // namespace studies
