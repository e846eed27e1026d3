#include "fem_reference/shape_index.h"

#include "fem_reference/path_system.h"

#include <algorithm>

namespace fem_reference {

namespace {

using Eigen::Vector3d;

constexpr double same_shape = 1e-3;  // of the rod's length; chosen, not measured

Eigen::Quaterniond quaternion(const scene::Station& station) {
  return Eigen::Quaterniond(station.X_BS.rotation_BS);
}

// A shape between its stations, dimensionless.
class Shape {
 public:
  Shape(const std::vector<scene::Station>& stations, const BeamModel& model) : stations_(stations), model_(model) {}

  // At a place in rod lengths, given from the clamp on.
  void go_to(double place) {
    const double s_mm = place * model_.length_unit_mm;
    while (next_ + 1 < stations_.size() && stations_[next_].s_mm < s_mm) ++next_;
    const double start_mm = stations_[next_ - 1].s_mm, length_mm = stations_[next_].s_mm - start_mm;
    share_ = length_mm > 0 ? (s_mm - start_mm) / length_mm : 1;
  }
  Quaternion rotation_BS() const {
    const Eigen::Quaterniond q = quaternion(before()).slerp(share_, quaternion(after()));
    return {q.w(), q.x(), q.y(), q.z()};
  }
  // Cubic, along the tangents of the two stations.
  Vector3d position_B() const {
    const double t = share_, length_mm = after().s_mm - before().s_mm;
    const Vector3d along =
        length_mm * ((1 - t) * before().X_BS.rotation_BS.col(0) - t * after().X_BS.rotation_BS.col(0));
    const Vector3d chord = after().X_BS.position_B_mm - before().X_BS.position_B_mm;
    const Vector3d bow = (1 - t) * t * (along + (2 * t - 1) * chord);
    return (before().X_BS.position_B_mm + t * chord + bow) / model_.length_unit_mm;
  }
  Vector3d force_S() const {
    const Vector3d force_B_N = (1 - share_) * before().force_B_N + share_ * after().force_B_N;
    return rotated(conjugate(rotation_BS()), force_B_N) / model_.force_unit_N;
  }

 private:
  const scene::Station& before() const { return stations_[next_ - 1]; }
  const scene::Station& after() const { return stations_[next_]; }

  const std::vector<scene::Station>& stations_;
  const BeamModel& model_;
  std::size_t next_ = 1;
  double share_ = 0;
};

BeamState state_of(const std::vector<scene::Station>& stations, const BeamModel& model) {
  const ReferenceElement& reference = model.reference;
  BeamState state;
  state.position_B.push_back(Vector3d::Zero());
  state.rotation_BS.push_back(Quaternion::Unit(0));
  Shape at_nodes(stations, model), at_points(stations, model);
  double start = 0;
  for (const ElementData& element : model.elements) {
    for (int i = 1; i < reference.nodes(); ++i) {
      at_nodes.go_to(start + reference.node(i) * element.length);
      state.position_B.push_back(at_nodes.position_B());
      const Quaternion q = at_nodes.rotation_BS();
      state.rotation_BS.push_back(q.dot(state.rotation_BS.back()) < 0 ? Quaternion(-q) : q);
    }
    for (int g = 0; g < reference.points(); ++g) {
      at_points.go_to(start + reference.point(g) * element.length);
      state.force_S.push_back(at_points.force_S());
    }
    start += element.length;
  }
  return state;
}

double largest_distance(const BeamState& a, const BeamState& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.position_B.size(); ++i) {
    largest = std::max(largest, (a.position_B[i] - b.position_B[i]).norm());
  }
  return largest;
}

}  // namespace

ShapeIndex index_of_shape(const scene::Scene& scene, const std::vector<scene::Station>& shape, const Options& options) {
  validate(options);
  PathSystem system(parametric_model(beam_model(scene, options)), stepping_options(options));
  const BeamState start = state_of(shape, system.model());
  const Direction along = system.along_parameter(1);
  ShapeIndex result;
  const auto found = system.solve(start, 1, along, along);
  if (!found) {
    result.message = system.failure();
    return result;
  }
  const double moved = largest_distance(start, found->state);
  result.moved_mm = moved * system.model().length_unit_mm;
  result.neutral = found->neutral;
  if (moved <= same_shape) result.index = found->index;
  else result.message = "the finite elements' equilibrium lies elsewhere";
  return result;
}

}  // namespace fem_reference
