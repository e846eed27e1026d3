#include "exact_reference/stability.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <numeric>

namespace exact_reference {
namespace {

using Eigen::Matrix3d;

Matrix3d symmetric_part(const Matrix3d& m) {
  return (m + m.transpose()) / 2;
}

// (b, M_b) = [A B; C D] (a, M_a): a, b the small rotations of an interval's ends, in the base frame.
struct IntervalMap {
  Matrix3d A, B, C, D;
};

IntervalMap interval_map(const State& start, const State& end, const CoreMatrix& S) {
  const Eigen::Matrix<double, 4, 3> from = quaternion_tangent(start.head<4>());
  const Eigen::Matrix<double, 3, 4> to = 4 * quaternion_tangent(end.head<4>()).transpose();
  return {to * S.block<4, 4>(0, 0) * from, to * S.block<4, 3>(0, 7), S.block<3, 4>(7, 0) * from, S.block<3, 3>(7, 7)};
}

}  // namespace

std::optional<int> falling_directions(const Shooting& shooting, const NodeStates& y, double load, bool turns_freely) {
  constexpr double epsilon = 2.2e-16;
  const double intervals = static_cast<double>(shooting.mesh().size());
  const std::vector<double>& errors = shooting.volume_changes();
  const double unresolved = std::accumulate(errors.begin(), errors.end(), 1e-11);
  const Shooting::Linearised& linear = shooting.linearised(y, load);
  int count = 0;
  Matrix3d beyond = Matrix3d::Zero();  // form of everything distal, as a function of the rotation here
  for (std::size_t i = shooting.mesh().size(); i-- > 0;) {
    const auto [A, B, C, D] = interval_map(shooting.start_state(y, load, i), linear.ends[i], linear.sensitivities[i]);
    if (shooting.mesh()[i].ends_span) beyond += shooting.equations(i, load).arms_second_variation(y[i + 1]);
    // What varying M in the base frame adds to the symmetric forms on both sides of a node.
    const Matrix3d P = beyond + cross_matrix(linear.ends[i].segment<3>(7)) / 2, W = D + P * B;
    // Both forms of the moments that turn the interval's end, not of its rotations (Sylvester: the signs are the same);
    // measured by the interval's own, so that stiff and soft axes count alike.
    const Matrix3d pivot = symmetric_part(B.transpose() * W), own_form = symmetric_part(B.transpose() * D);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3d> eigen(pivot, own_form, Eigen::EigenvaluesOnly);
    Eigen::Vector3d values = eigen.eigenvalues();
    // No pivot before the last is singular, so that the form's zero is the last one's.
    if (turns_freely && i == 0) {
      Eigen::Index free = 0;
      values.cwiseAbs().minCoeff(&free);
      values[free] = 1;
    }
    const Eigen::Vector3d own = own_form.selfadjointView<Eigen::Lower>().eigenvalues();
    const double neutral = unresolved + 16 * intervals * epsilon * std::abs(own[2] / own[1]);
    if (!values.allFinite() || !(values.cwiseAbs().minCoeff() >= neutral)) return std::nullopt;
    count += static_cast<int>((values.array() < 0).count());
    beyond = symmetric_part(W.inverse() * (C + P * A));
  }
  return count;
}

}  // namespace exact_reference
