#include "fam/stability.h"

#include "fam/varied_march.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace fam {
namespace {

int negative_eigenvalues(const Matrix3d& matrix) {
  return static_cast<int>((matrix.eigenvalues().real().array() < 0).count());
}

}  // namespace

bool agree(const Stability& a, const Stability& b, double share) {
  return a.conjugate_points == b.conjugate_points && std::abs(a.log_determinant - b.log_determinant) < 0.25 * share;
}

// Fields of small motions that leave the tip free, started there with three turns of it, marched to the clamp and
// made the identity at each arc's end: their turn over one arc has a negative eigenvalue for each conjugate point in
// it.
Stability stability(const LoadedRod<3>& rod, std::span<const ArcRange> segments,
                    std::span<const SectionState<3>> nodes) {
  Stability result;
  Fields<3, 3> fields{Matrix3d::Identity(), Matrix3d::Zero(), Matrix3d::Zero()};
  for (std::size_t k = segments.size(); k-- > 0;) {
    SectionState<3> state = nodes[k];
    march_varied(rod, segments[k], state, fields, [&](const SectionState<3>&, Fields<3, 3>& f) {
      result.conjugate_points += negative_eigenvalues(f.turn);
      result.log_determinant += std::log(std::abs(f.turn.determinant()));
      const Matrix3d inverse = f.turn.inverse();
      f = {Matrix3d::Identity(), f.force_N * inverse, f.moment_Nmm * inverse};
    });
  }
  if (!(fields.force_N.allFinite() && fields.moment_Nmm.allFinite()))
    result.log_determinant = std::numeric_limits<double>::quiet_NaN();
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
