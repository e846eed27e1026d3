// A section's compliance, its tendons included, along an arc: what a change of the wrench does to the strain.
//
// With the strain X = (u, v) h, its tendons' t = v + u x r = B X and their directions d = t/|t| (fam/tendon.h) a change
// of the wrench W = (m, n) gives dX = C (dW - S dX), S = sum T/|t| B^T (1 - d d^T) B, whose Taylor series along the arc
// follows from that of X: with A = (I + C S_0)^-1 C, dX_k = A (dW_k - sum_{j>0} S_j dX_{k-j}). Changes of constants are
// changes of W, as the strain feels them: K of the rest curvature, -(u - u0) of the stiffness K, -B^T d of a tension.
#pragma once

#include "fam/arc_section.h"
#include "fam/arc_slopes.h"
#include "fam/elimination.h"
#include "fam/skew.h"

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

// Coefficients of three changes of the wrench.
template <std::size_t terms>
struct ConstantSeries {
  std::array<Matrix3d, terms> moment, force;
  ConstantSeries() {
    moment.fill(Matrix3d::Zero());
    force.fill(Matrix3d::Zero());
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
    stiffness_.setZero();
    for (std::size_t i = 0; i < arc.tendons.size(); ++i) set(arc.tendons[i], tendons_[i]);
    Eigen::Matrix<double, unknowns, 1> compliance;
    compliance.template head<3>() = arc.angular_compliance;
    if constexpr (with_shear) compliance.template tail<3>() = arc.linear_compliance;
    Square factors = compliance.asDiagonal() * stiffness_;
    factors.diagonal().array() += 1;
    factorise(factors);
    compliance_ = compliance.asDiagonal();
    substitute(factors, compliance_);
  }

  // All with tendons: A and S at the distal end.
  const Square& compliance() const { return compliance_; }
  const Square& tendon_stiffness() const { return stiffness_; }
  // A tendon's part of S is B^T P B: its arm, that makes B, and the coefficients of P = T/|t| (1 - d d^T).
  struct Tendon {
    Vector3d arm_mm;
    std::array<Matrix3d, terms> across;
  };
  std::span<const Tendon> tendons() const { return {tendons_.data(), arc_.tendons.size()}; }

  // The changes of the wrench that a changed constant is.
  ConstantSeries<terms> constant_series(Constant constant, const TendonArms& tendon_arms) const {
    ConstantSeries<terms> result;
    if (constant == Constant::tension) {
      for (int i = 0; i < 3; ++i) {
        const std::optional<Vector3d>& arm_mm = tendon_arms[static_cast<std::size_t>(i)];
        if (!arm_mm) continue;
        const TendonSeries<terms> tendon(*arm_mm, rotation_, translation_);
        for (std::size_t k = 0; k < terms; ++k) {
          result.moment[k].col(i) = -arm_mm->cross(tendon.direction[k]);
          result.force[k].col(i) = -tendon.direction[k];
        }
      }
    } else if (constant == Constant::stiffness) {
      for (std::size_t k = 0; k < terms; ++k) result.moment[k].diagonal() = -rotation_[k] / arc_.length_mm;
      result.moment[0].diagonal() += arc_.rest_rotation / arc_.length_mm;
    } else if (constant == Constant::rest_curvature) {
      result.moment[0].diagonal() = arc_.length_mm * arc_.angular_compliance.cwiseInverse();
    }
    return result;
  }

 private:
  void set(const BasicTendon<3>& tendon, Tendon& slopes) {
    const TendonSeries<terms> series(tendon.arm_mm, rotation_, translation_);
    std::array<double, terms> pull;      // T/|t|
    std::array<Matrix3d, terms> across;  // 1 - d d^T
    slopes.arm_mm = tendon.arm_mm;
    for (std::size_t k = 0; k < terms; ++k) {
      pull[k] = k == 0 ? tendon.tension_N : 0;
      for (std::size_t j = 1; j <= k; ++j) pull[k] -= series.length[j] * pull[k - j];
      pull[k] /= series.length[0];
      across[k] = (k == 0 ? 1 : 0) * Matrix3d::Identity();
      for (std::size_t j = 0; j <= k; ++j) across[k] -= series.direction[j] * series.direction[k - j].transpose();
      slopes.across[k].setZero();
      for (std::size_t j = 0; j <= k; ++j) slopes.across[k] += pull[j] * across[k - j];
    }
    const Matrix3d arm = skew(tendon.arm_mm), &P = slopes.across[0];
    stiffness_.template topLeftCorner<3, 3>() -= arm * P * arm;
    if constexpr (with_shear) {
      stiffness_.template topRightCorner<3, 3>() += arm * P;
      stiffness_.template bottomLeftCorner<3, 3>() -= P * arm;
      stiffness_.template bottomRightCorner<3, 3>() += P;
    }
  }

  const BasicArcConstants<3>& arc_;
  const Series &rotation_, &translation_;
  Square stiffness_, compliance_;                           // S, A; not set without tendons
  std::array<Tendon, scene::max_tendon_offsets> tendons_;  // on the stack, touched only as far as there are tendons
};

}  // namespace fam
