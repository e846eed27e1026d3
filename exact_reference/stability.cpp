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

// Second variation of one interval: 1/2 (a, b) K (a, b) with a, b the small rotations of its ends, in the base frame.
struct IntervalForm {
  Matrix3d start_start, start_end, end_end;
};

// From (b, M_b) = [A B; C D] (a, M_a): M_a = B^-1 (b - A a), and the form's gradient is (-M_a, M_b). The diagonal
// blocks have the skew parts -+ [M]x/2 that come of varying M in the base frame; they cancel where intervals meet.
IntervalForm interval_form(const State& start, const State& end, const CoreMatrix& S) {
  const Eigen::Matrix<double, 4, 3> from = quaternion_tangent(start.head<4>());
  const Eigen::Matrix<double, 3, 4> to = 4 * quaternion_tangent(end.head<4>()).transpose();
  const Matrix3d A = to * S.block<4, 4>(0, 0) * from;
  const Matrix3d B_inverse = (to * S.block<4, 3>(0, 7)).inverse();
  const Matrix3d D = S.block<3, 3>(7, 7);
  return {symmetric_part(B_inverse * A), -B_inverse, symmetric_part(D * B_inverse)};
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
    const IntervalForm form = interval_form(shooting.start_state(y, load, i), linear.ends[i], linear.sensitivities[i]);
    if (shooting.mesh()[i].ends_span) beyond += shooting.equations(i, load).arms_second_variation(y[i + 1]);
    const Matrix3d pivot = form.end_end + beyond;
    // Measured by the interval's own form, so that stiff and soft axes count alike; signs are the same (Sylvester).
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3d> eigen(pivot, form.end_end, Eigen::EigenvaluesOnly);
    Eigen::Vector3d values = eigen.eigenvalues();
    // No pivot before the last is singular, so that the form's zero is the last one's.
    if (turns_freely && i == 0) {
      Eigen::Index free = 0;
      values.cwiseAbs().minCoeff(&free);
      values[free] = 1;
    }
    const Eigen::Vector3d own = form.end_end.selfadjointView<Eigen::Lower>().eigenvalues();
    const double neutral = unresolved + 16 * intervals * epsilon * std::abs(own[1] / own[0]);
    if (!values.allFinite() || !(values.cwiseAbs().minCoeff() >= neutral)) return std::nullopt;
    count += static_cast<int>((values.array() < 0).count());
    beyond = form.start_start - symmetric_part(form.start_end * pivot.inverse() * form.start_end.transpose());
  }
  return count;
}

}  // namespace exact_reference
