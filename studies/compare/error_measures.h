// How far apart two equilibria are, and what a set of differences amounts to.
#pragma once

#include "scene/equilibrium.h"

#include <vector>

namespace studies {

// Position at arc length s by the cubic Hermite curve between stations, with the tangents as end slopes; exact at the
// stations, between them within h^4/384 |p''''|, some 1e-6 mm for 40 intervals on the rods of Study I.
// Where the rod shears by gamma the centreline leaves the tangent's direction: up to 0.1 h gamma more.
Eigen::Vector3d position_at_mm(const scene::Equilibrium& result, double s_mm);

// Differences of two centrelines at the same arc lengths, `samples` equal intervals from clamp to tip.
struct ShapeDifference {
  double largest_mm = 0;
  double rms_mm = 0;
};
ShapeDifference shape_difference(const scene::Equilibrium& a, const scene::Equilibrium& b, int samples = 40);

// Distances of two centrelines at the stations that both have (s = k L/40 and span ends at least), clamp to tip.
struct Distance {
  double s_mm = 0;
  double mm = 0;
};
std::vector<Distance> station_distances(const scene::Equilibrium& a, const scene::Equilibrium& b);
Distance farthest(const std::vector<Distance>& distances);  // the first of the largest
double largest_distance_mm(const scene::Equilibrium& a, const scene::Equilibrium& b);

// The value below which this share of the values lies, between neighbours in proportion; the mean of the two middle
// ones for the median of an even number.
double quantile(std::vector<double> values, double share);

// Statistics of differences e_1..e_n along one axis.
struct Statistics {
  double mean = 0;                // sum e / n
  double standard_deviation = 0;  // sqrt(sum (e - mean)^2 / (n - 1))
  double mean_absolute = 0;       // sum |e| / n
  double absolute_deviation = 0;  // standard deviation of |e|, n - 1
  double root_mean_square = 0;    // sqrt(sum e^2 / n)
};
Statistics statistics(const std::vector<double>& differences);

}  // namespace studies
