#include "fam/stability.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace fam {
namespace {

// With a negative real part. Where the polynomial with its roots at their negatives meets Hurwitz's criterion, none.
int negative_eigenvalues(const Matrix3d& matrix, double determinant) {
  const double trace = matrix.trace();
  const double minors = (trace * trace - (matrix * matrix).trace()) / 2;
  if (trace > 0 && determinant > 0 && trace * minors > determinant) return 0;
  return static_cast<int>((matrix.eigenvalues().real().array() < 0).count());
}

// Of one that is singular but for round-off.
int negative_eigenvalues_but_smallest(const Matrix3d& matrix) {
  Eigen::Vector3cd values = matrix.eigenvalues();
  Eigen::Index smallest;
  values.cwiseAbs().minCoeff(&smallest);
  values[smallest] = 0;
  return static_cast<int>((values.real().array() < 0).count());
}

}  // namespace

bool agree(const Stability& a, const Stability& b, double share) {
  return a.conjugate_points == b.conjugate_points && std::abs(a.log_determinant - b.log_determinant) < 0.25 * share;
}

namespace {

// Fields of small motions that leave the tip free, started there with three turns of it, marched to the clamp and
// made the identity at each arc's end: visit(turn over the arc, whether it is the clamp's). The turns are those of the
// base frame: of an unloaded arc the identity, however it is bent. Whether all was finite.
template <class Visit>
bool march_free_tip(const LoadedRod<3>& rod, std::span<const ArcRange> segments, std::span<const SectionState<3>> nodes,
                    Visit&& visit) {
  Fields<3, 3> fields{Matrix3d::Identity(), Matrix3d::Zero(), Matrix3d::Zero()};
  int arcs_left = segments.back().end_arc;
  for (std::size_t k = segments.size(); k-- > 0;) {
    SectionState<3> state = nodes[k];
    Matrix3d distal_SB = state.rotation_SB;
    march_varied(rod, segments[k], state, fields, [&](const SectionState<3>& proximal, Fields<3, 3>& f) {
      visit(Matrix3d(proximal.rotation_SB.transpose() * f.turn * distal_SB), --arcs_left == 0);
      distal_SB = proximal.rotation_SB;
      const Matrix3d inverse = f.turn.inverse();
      f = {Matrix3d::Identity(), f.force_N * inverse, f.moment_Nmm * inverse};
    });
  }
  return fields.force_N.allFinite() && fields.moment_Nmm.allFinite();
}

}  // namespace

// The turn over one arc has a negative eigenvalue for each conjugate point in it.
Stability stability(const LoadedRod<3>& rod, std::span<const ArcRange> segments, std::span<const SectionState<3>> nodes,
                    bool is_free) {
  Stability result;
  const bool finite = march_free_tip(rod, segments, nodes, [&](const Matrix3d& turn, bool at_clamp) {
    const double determinant = turn.determinant();
    result.conjugate_points +=
        is_free && at_clamp ? negative_eigenvalues_but_smallest(turn) : negative_eigenvalues(turn, determinant);
    result.log_determinant += std::log(std::abs(determinant));
  });
  if (!finite && !is_free) result.log_determinant = std::numeric_limits<double>::quiet_NaN();
  return result;
}

void ConjugatePoints::meet(const Matrix3d& turn_B) {
  const Matrix3d over_arc = turn_B * back_;
  count_ += negative_eigenvalues(over_arc, over_arc.determinant());
  back_ = turn_B.inverse();
}

CrossTurn cross_turn(const LoadedRod<3>& rod, std::span<const ArcRange> segments,
                     std::span<const SectionState<3>> nodes) {
  CrossTurn result{1, 0};
  march_free_tip(rod, segments, nodes, [&](const Matrix3d& turn, bool) {
    const std::complex<double> across(turn(1, 1) + turn(2, 2), turn(2, 1) - turn(1, 2));
    const double size = std::abs(across);
    result.log_size += std::log(size / 2);
    if (size > 0) result.direction *= across / size;
  });
  return result;
}

Stability StabilityJudge<2>::operator()(const LoadedRod<2>& rod, std::span<const ArcRange> segments,
                                        std::span<const SectionState<2>> nodes) {
  if (!is_in_space_) in_space_.set(rod.way(), rod.arcs_per_span(), rod.law(), rod.model());
  is_in_space_ = true;
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
