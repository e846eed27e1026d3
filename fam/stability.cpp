#include "fam/stability.h"

#include "fam/rotation.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace fam {
namespace {

using Number = Dual<3>;
using WrenchSlopes = Eigen::Matrix<double, 6, 3>;

// Three small motions of a section: each turns it about one axis and changes the wrench by a column of the slopes.
void set_fields(SectionState<3, Number>& state, const SectionState<3>& value, const WrenchSlopes& wrench_slopes) {
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d column = value.rotation_SB.col(axis);
      Number& entry = state.rotation_SB(i, axis);
      entry = value.rotation_SB(i, axis);
      for (int field = 0; field < 3; ++field) entry.slope[field] = -Vector3d::Unit(field).cross(column)[i];
    }
    state.wrench.force_N[i] = {value.wrench.force_N[i], wrench_slopes.row(i).transpose().array()};
    state.wrench.moment_Nmm[i] = {value.wrench.moment_Nmm[i], wrench_slopes.row(3 + i).transpose().array()};
  }
}

SectionState<3> values_of(const SectionState<3, Number>& state) {
  SectionState<3> value;
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) value.rotation_SB(i, axis) = state.rotation_SB(i, axis).value;
    value.wrench.force_N[i] = state.wrench.force_N[i].value;
    value.wrench.moment_Nmm[i] = state.wrench.moment_Nmm[i].value;
  }
  return value;
}

// The small turn of the section in each field, a column each.
Matrix3d turns_of(const SectionState<3, Number>& state, const SectionState<3>& value) {
  Matrix3d turn;
  for (int field = 0; field < 3; ++field) {
    Matrix3d slope;
    for (int i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis) slope(i, axis) = state.rotation_SB(i, axis).slope[field];
    }
    turn.col(field) = -sine_vector<double>(Matrix3d(slope * value.rotation_SB.transpose()));
  }
  return turn;
}

WrenchSlopes wrench_slopes_of(const SectionState<3, Number>& state) {
  WrenchSlopes slopes;
  for (int i = 0; i < 3; ++i) {
    slopes.row(i) = state.wrench.force_N[i].slope.matrix().transpose();
    slopes.row(3 + i) = state.wrench.moment_Nmm[i].slope.matrix().transpose();
  }
  return slopes;
}

}  // namespace

bool agree(const Stability& a, const Stability& b) {
  return a.conjugate_points == b.conjugate_points && std::abs(a.log_determinant - b.log_determinant) < 0.25;
}

// Fields of small motions that leave the tip free, started there with three turns of it, marched to the clamp and
// made the identity at each arc's end: their turn over one arc has a negative eigenvalue for each conjugate point in
// it.
Stability stability(const LoadedRod<3>& rod, std::span<const ArcRange> segments,
                    std::span<const SectionState<3>> nodes) {
  Stability result;
  SectionState<3, Number> state;
  WrenchSlopes wrench_slopes = WrenchSlopes::Zero();
  for (std::size_t k = segments.size(); k-- > 0;) {
    set_fields(state, nodes[k], wrench_slopes);
    rod.march(segments[k], state, [&](int, const auto&, const auto&, SectionState<3, Number>& s) {
      const SectionState<3> value = values_of(s);
      const Matrix3d turn = turns_of(s, value);
      result.conjugate_points += static_cast<int>((turn.eigenvalues().real().array() < 0).count());
      result.log_determinant += std::log(std::abs(turn.determinant()));
      wrench_slopes = wrench_slopes_of(s) * turn.inverse();
      set_fields(s, value, wrench_slopes);
    });
  }
  if (!wrench_slopes.allFinite()) result.log_determinant = std::numeric_limits<double>::quiet_NaN();
  return result;
}

Stability StabilityJudge<2>::operator()(const LoadedRod<2>& rod, std::span<const ArcRange> segments,
                                        std::span<const SectionState<2>> nodes) {
  in_space_.set_load(rod.load_factor());
  nodes_.resize(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    nodes_[k].rotation_SB.setIdentity();
    nodes_[k].rotation_SB.topLeftCorner<2, 2>() = nodes[k].rotation_SB;
    nodes_[k].wrench = {};
    nodes_[k].wrench.force_N.head<2>() = nodes[k].wrench.force_N;
    nodes_[k].wrench.moment_Nmm.tail<1>() = nodes[k].wrench.moment_Nmm;
  }
  return stability(in_space_, segments, nodes_);
}

}  // namespace fam
