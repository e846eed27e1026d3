// A section's compliance, its tendons included, along an arc: what a change of the wrench does to the strain.
//
// With the strain X = (u, v) h, its tendons' t = v + u x r = B X and their directions d = t/|t| (fam/tendon.h) a change
// of the wrench W = (m, n) gives dX = A dW, (I + C S) A = C, S = sum T/|t| B^T (1 - d d^T) B. Taylor series of all of
// them along the arc follow from that of X. Changes of constants are changes of W, as the strain feels them: K of the
// rest curvature, -(u - u0) of the stiffness K, -B^T d of a tension.
#pragma once

#include "fam/arc_section.h"
#include "fam/arc_slopes.h"
#include "fam/skew.h"

#include <Eigen/LU>

#include <array>

namespace fam {

// Coefficients of a tendon's direction and of |t|.
template <std::size_t terms>
struct TendonSeries {
  std::array<Vector3d, terms> direction;
  std::array<double, terms> length;

  TendonSeries(const Vector3d& arm, const std::array<Vector3d, terms>& rotation,
               const std::array<Vector3d, terms>& translation) {
    std::array<Vector3d, terms> t;
    for (std::size_t k = 0; k < terms; ++k) {
      t[k] = translation[k] + rotation[k].cross(arm);
      if (k == 0) {
        length[0] = t[0].norm();
        direction[0] = t[0] / length[0];
        continue;
      }
      double along = t[0].dot(t[k]);
      for (std::size_t j = 1; j < k; ++j) along += 0.5 * (t[j].dot(t[k - j]) - length[j] * length[k - j]);
      length[k] = along / length[0];
      direction[k] = t[k];
      for (std::size_t j = 1; j <= k; ++j) direction[k] -= direction[k - j] * length[j];
      direction[k] /= length[0];
    }
  }
};

template <bool with_shear, std::size_t terms>
class SectionSlopes {
 public:
  static constexpr int unknowns = with_shear ? 6 : 3;
  using Square = Eigen::Matrix<double, unknowns, unknowns>;
  using Series = std::array<Vector3d, terms>;

  // The strain's coefficients; without shear those of the translation are (h, 0, 0), 0, 0 ...
  SectionSlopes(const BasicArcConstants<3>& arc, const Series& rotation, const Series& translation)
      : arc_(arc), rotation_(rotation), translation_(translation) {
    if (arc.tendons.empty()) return;
    for (Square& matrix : stiffness_) matrix.setZero();
    for (const BasicTendon<3>& tendon : arc.tendons) add(tendon);
    Eigen::Matrix<double, unknowns, 1> compliance;
    compliance.template head<3>() = arc.angular_compliance;
    if constexpr (with_shear) compliance.template tail<3>() = arc.linear_compliance;
    const Square C = compliance.asDiagonal();
    compliance_[0] = (Square::Identity() + C * stiffness_[0]).partialPivLu().solve(C);
    for (std::size_t k = 1; k < terms; ++k) {
      Square sum = Square::Zero();
      for (std::size_t j = 1; j <= k; ++j) sum += stiffness_[j] * compliance_[k - j];
      compliance_[k] = -compliance_[0] * sum;
    }
  }

  // Coefficient k of the strain's change from those of the moment's and the force's up to it.
  template <int N>
  void strain(std::size_t k, const std::array<Slopes3<N>, terms>& moment, const std::array<Slopes3<N>, terms>& force,
              Slopes3<N>& rotation, Slopes3<N>& translation) const {
    if (arc_.tendons.empty()) {
      for (int i = 0; i < 3; ++i) rotation.row(i) = arc_.angular_compliance[i] * moment[k].row(i);
      if constexpr (with_shear) {
        for (int i = 0; i < 3; ++i) translation.row(i) = arc_.linear_compliance[i] * force[k].row(i);
      }
      return;
    }
    rotation.setZero();
    if constexpr (with_shear) translation.setZero();
    for (std::size_t j = 0; j <= k; ++j) {
      const Square& A = compliance_[j];
      rotation += A.template topLeftCorner<3, 3>() * moment[k - j];
      if constexpr (with_shear) {
        rotation += A.template topRightCorner<3, 3>() * force[k - j];
        translation += A.template bottomLeftCorner<3, 3>() * moment[k - j];
        translation += A.template bottomRightCorner<3, 3>() * force[k - j];
      }
    }
  }

  // Coefficient k of the change of the wrench that a changed constant is.
  template <int N>
  void add_constant(const ArcChange<N>& change, std::size_t k, Slopes3<N>& moment, Slopes3<N>& force) const {
    if (N != 3 || change.constant == Constant::none) return;
    if (change.constant == Constant::tension) {
      const TendonSeries<terms> tendon(change.tendon_arm_mm, rotation_, translation_);
      moment.col(0) -= change.tendon_arm_mm.cross(tendon.direction[k]);
      force.col(0) -= tendon.direction[k];
      return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double strain = rotation_[k][axis] - (k == 0 ? arc_.rest_rotation[axis] : 0);
      if (change.constant == Constant::stiffness) moment(axis, axis) -= strain / arc_.length_mm;
      else if (k == 0) moment(axis, axis) += arc_.length_mm / arc_.angular_compliance[axis];
    }
  }

  // S at the distal end; zero without tendons is not written.
  const Square& tendon_stiffness() const { return stiffness_[0]; }

 private:
  void add(const BasicTendon<3>& tendon) {
    const TendonSeries<terms> series(tendon.arm_mm, rotation_, translation_);
    std::array<double, terms> pull;      // T/|t|
    std::array<Matrix3d, terms> across;  // 1 - d d^T
    const Matrix3d arm = skew(tendon.arm_mm);
    for (std::size_t k = 0; k < terms; ++k) {
      pull[k] = k == 0 ? tendon.tension_N : 0;
      for (std::size_t j = 1; j <= k; ++j) pull[k] -= series.length[j] * pull[k - j];
      pull[k] /= series.length[0];
      across[k] = (k == 0 ? 1 : 0) * Matrix3d::Identity();
      for (std::size_t j = 0; j <= k; ++j) across[k] -= series.direction[j] * series.direction[k - j].transpose();
      Matrix3d P = Matrix3d::Zero();
      for (std::size_t j = 0; j <= k; ++j) P += pull[j] * across[k - j];
      stiffness_[k].template topLeftCorner<3, 3>() -= arm * P * arm;
      if constexpr (with_shear) {
        stiffness_[k].template topRightCorner<3, 3>() += arm * P;
        stiffness_[k].template bottomLeftCorner<3, 3>() -= P * arm;
        stiffness_[k].template bottomRightCorner<3, 3>() += P;
      }
    }
  }

  const BasicArcConstants<3>& arc_;
  const Series &rotation_, &translation_;
  std::array<Square, terms> stiffness_, compliance_;  // S and A; not set without tendons
};

}  // namespace fam
