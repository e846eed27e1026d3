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
#include "fam/wide.h"

#include <array>

namespace fam {

// Coefficients of a tendon's direction and of |t|. T: double or Wide.
template <class T, std::size_t terms>
struct TendonSeries {
  std::array<Vector<T, 3>, terms> direction;
  std::array<T, terms> length;
  T inverse_length;  // of the first

  TendonSeries() = default;
  TendonSeries(const Vector3d& arm_mm, const std::array<Vector<T, 3>, terms>& rotation,
               const std::array<Vector<T, 3>, terms>& translation) {
    const Vector<T, 3> arm = as<T>(arm_mm);
    std::array<Vector<T, 3>, terms> t;
    for (std::size_t k = 0; k < terms; ++k) {
      t[k] = translation[k] + Vector<T, 3>(cross(rotation[k], arm));
      if (k == 0) {
        length[0] = t[0].norm();
        inverse_length = 1 / length[0];
        direction[0] = t[0] * inverse_length;
        continue;
      }
      T along = t[0].dot(t[k]);
      for (std::size_t j = 1; j < k; ++j) along = along + 0.5 * (t[j].dot(t[k - j]) - length[j] * length[k - j]);
      length[k] = along * inverse_length;
      direction[k] = t[k];
      for (std::size_t j = 1; j <= k; ++j) direction[k] -= direction[k - j] * length[j];
      direction[k] = direction[k] * inverse_length;
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

template <bool with_shear, std::size_t terms, class T = double>
class SectionSlopes {
 public:
  static constexpr int unknowns = with_shear ? 6 : 3;
  using Square = Eigen::Matrix<double, unknowns, unknowns>;
  using Block = std::array<Vector<T, 3>, 3>;  // symmetric, by columns
  using Series = std::array<Vector<T, 3>, terms>;

  // The strain's coefficients; without shear those of the translation are (h, 0, 0), 0, 0 ...
  SectionSlopes(const BasicArcConstants<3>& arc, const Series& rotation, const Series& translation)
      : arc_(arc), rotation_(rotation), translation_(translation) {
    if (arc.tendons.empty()) return;
    stiffness_.setZero();
    if constexpr (!with_shear)
      turn_stiffness_.fill({Vector<T, 3>::Zero(), Vector<T, 3>::Zero(), Vector<T, 3>::Zero()});
    for (std::size_t i = 0; i < arc.tendons.size(); ++i) set(arc.tendons[i], tendons_[i]);
    if constexpr (!with_shear) stiffness_ = matrix(turn_stiffness_[0]);
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
  // With shear a tendon's part of S is B^T P B: its arm, that makes B, and the coefficients of P = T/|t| (1 - d d^T).
  struct Tendon {
    Vector3d arm_mm;
    TendonSeries<T, terms> series;
    std::array<Block, terms> across;
  };
  std::span<const Tendon> tendons() const { return {tendons_.data(), arc_.tendons.size()}; }
  // Without shear: the coefficients of S.
  const std::array<Block, terms>& turn_stiffness() const { return turn_stiffness_; }

  // The changes of the wrench that a changed constant is.
  ConstantSeries<terms> constant_series(Constant constant, const TendonArms& tendon_arms) const {
    ConstantSeries<terms> result;
    if (constant == Constant::tension) {
      for (int i = 0; i < 3; ++i) {
        const std::optional<Vector3d>& arm_mm = tendon_arms[static_cast<std::size_t>(i)];
        if (!arm_mm) continue;
        const TendonSeries<T, terms> tendon = series_at(*arm_mm);
        for (std::size_t k = 0; k < terms; ++k) {
          result.moment[k].col(i) = -narrow(Vector<T, 3>(arm_cross(as<T>(*arm_mm), tendon.direction[k])));
          result.force[k].col(i) = -narrow(tendon.direction[k]);
        }
      }
    } else if (constant == Constant::stiffness) {
      for (std::size_t k = 0; k < terms; ++k) result.moment[k].diagonal() = -narrow(rotation_[k]) / arc_.length_mm;
      result.moment[0].diagonal() += arc_.rest_rotation / arc_.length_mm;
    } else if (constant == Constant::rest_curvature) {
      result.moment[0].diagonal() = arc_.length_mm * arc_.angular_compliance.cwiseInverse();
    }
    return result;
  }

 private:
  static Matrix3d matrix(const Block& block) {
    Matrix3d result;
    result << narrow(block[0]), narrow(block[1]), narrow(block[2]);
    return result;
  }
  TendonSeries<T, terms> series_at(const Vector3d& arm_mm) const {
    for (std::size_t i = 0; i < arc_.tendons.size(); ++i)
      if (arc_.tendons[i].arm_mm == arm_mm) return tendons_[i].series;
    return {arm_mm, rotation_, translation_};
  }

  void set(const BasicTendon<3>& tendon, Tendon& slopes) {
    slopes.arm_mm = tendon.arm_mm;
    slopes.series = {tendon.arm_mm, rotation_, translation_};
    const Vector<T, 3> arm = as<T>(tendon.arm_mm);
    // P, or without shear S, is the series of T/|t| times a constant, less that of T/|t| a a^T: a = d, or r x d.
    std::array<Vector<T, 3>, terms> a, pulled;  // pulled: T/|t| a
    std::array<T, terms> pull;                  // T/|t|
    for (std::size_t k = 0; k < terms; ++k) {
      a[k] = slopes.series.direction[k];
      if constexpr (!with_shear) a[k] = arm_cross(arm, a[k]);
      pull[k] = k == 0 ? tendon.tension_N : 0.0;
      for (std::size_t j = 1; j <= k; ++j) pull[k] = pull[k] - slopes.series.length[j] * pull[k - j];
      pull[k] = pull[k] * slopes.series.inverse_length;
      pulled[k] = a[k] * pull[0];
      for (std::size_t j = 1; j <= k; ++j) pulled[k] += a[k - j] * pull[j];
    }
    for (std::size_t column = 0; column < 3; ++column) {
      const int i = static_cast<int>(column);
      Vector<T, 3> constant = as<T>(Vector3d(Vector3d::Unit(i)));
      if constexpr (!with_shear) constant = constant * T(tendon.arm_mm.squaredNorm()) - arm * T(tendon.arm_mm[i]);
      for (std::size_t k = 0; k < terms; ++k) {
        Vector<T, 3> sum = constant * pull[k];
        for (std::size_t j = 0; j <= k; ++j) sum -= pulled[j] * T(a[k - j][i]);
        if constexpr (with_shear) slopes.across[k][column] = sum;
        else turn_stiffness_[k][column] += sum;
      }
    }
    if constexpr (with_shear) add_stiffness(skew(tendon.arm_mm), matrix(slopes.across[0]));
  }
  void add_stiffness(const Matrix3d& arm, const Matrix3d& P) {
    stiffness_.template topLeftCorner<3, 3>() -= arm * P * arm;
    stiffness_.template topRightCorner<3, 3>() += arm * P;
    stiffness_.template bottomLeftCorner<3, 3>() -= P * arm;
    stiffness_.template bottomRightCorner<3, 3>() += P;
  }

  const BasicArcConstants<3>& arc_;
  const Series &rotation_, &translation_;
  Square stiffness_, compliance_;  // S, A; not set without tendons
  std::array<Block, terms> turn_stiffness_;
  std::array<Tendon, scene::max_tendon_offsets> tendons_;  // on the stack, touched only as far as there are tendons
};

}  // namespace fam
