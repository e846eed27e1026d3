#include "exact_reference/stations.h"

#include <algorithm>
#include <cmath>

namespace exact_reference {

int equal_parts_for(double turning_rad) {
  return static_cast<int>(std::ceil(std::clamp(2 * turning_rad, 40.0, 1e6)));
}

std::vector<double> station_places(const ScaledRod& rod, int equal_parts) {
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

scene::Station station_of(const ScaledRod& rod, double place, const Eigen::Vector4d& q,
                          const Eigen::Vector3d& position) {
  return {place * rod.length_mm, {rotation_of(q.normalized()), rod.length_mm * position}};
}

void set_base_wrench(scene::Equilibrium& result, const ScaledRod& rod, const Eigen::Vector3d& cut_force_B,
                     const Eigen::Vector3d& cut_moment_B) {
  const scene::Wrench& tendon = rod.spans.front().tendon_S;  // the clamp's section frame is the base frame
  result.base_force_B_N = rod.force_unit_N * (cut_force_B + tendon.force_N);
  result.base_moment_B_Nmm = rod.moment_unit_Nmm * (cut_moment_B + tendon.moment_Nmm);
}

}  // namespace exact_reference
