#include "fem_reference/direction.h"

#include <algorithm>
#include <cmath>

namespace fem_reference {

namespace {

using Vectors = std::vector<Eigen::Vector3d>;

template <typename OfBoth>
void for_parts(BeamIncrement& to, const BeamIncrement& what, const OfBoth& of_both) {
  of_both(to.displacement_B, what.displacement_B);
  of_both(to.rotation_S, what.rotation_S);
  of_both(to.force_S, what.force_S);
}

}  // namespace

BeamIncrement no_motion(const BeamModel& model) {
  const auto nodes = static_cast<std::size_t>(model.nodes());
  const std::size_t points = model.elements.size() * static_cast<std::size_t>(model.reference.points());
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  return {Vectors(nodes, zero), Vectors(nodes, zero), Vectors(points, zero)};
}

void add(BeamIncrement& to, const BeamIncrement& what, double factor) {
  for_parts(to, what, [factor](Vectors& sums, const Vectors& values) {
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += factor * values[i];
  });
}

void add(Direction& to, const Direction& what, double factor) {
  add(to.motion, what.motion, factor);
  to.parameter += factor * what.parameter;
}

void scale(Direction& direction, double factor) {
  scale(direction.motion, factor);
  direction.parameter *= factor;
}

void scale(BeamIncrement& increment, double factor) {
  for (Vectors* values : {&increment.displacement_B, &increment.rotation_S, &increment.force_S}) {
    for (Eigen::Vector3d& value : *values) value *= factor;
  }
}

double product(const BeamIncrement& a, const BeamIncrement& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rotation_S.size(); ++i) {
    sum += a.displacement_B[i].dot(b.displacement_B[i]) + a.rotation_S[i].dot(b.rotation_S[i]);
  }
  return sum / static_cast<double>(a.rotation_S.size());
}

double product(const Direction& a, const Direction& b, double reach) {
  return product(a.motion, b.motion) + a.parameter * b.parameter / (reach * reach);
}

void normalise(Direction& direction, const Direction& ahead, double reach) {
  const double size = std::sqrt(product(direction, direction, reach));
  scale(direction, (product(direction, ahead, reach) < 0 ? -1 : 1) / size);
}

double largest_rotation(const BeamIncrement& increment) {
  double largest = 0;
  for (const Eigen::Vector3d& rotation : increment.rotation_S) largest = std::max(largest, rotation.norm());
  return largest;
}

}  // namespace fem_reference
