#include "exact_reference/tendon_strains.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace exact_reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Eigen::Matrix<double, 3, 6> tangent_by_strains(const Vector3d& r) {
  Eigen::Matrix<double, 3, 6> A;
  A << 0, r[2], -r[1], 1, 0, 0, -r[2], 0, r[0], 0, 1, 0, r[1], -r[0], 0, 0, 0, 1;
  return A;
}

}  // namespace

Vector3d tendon_tangent_S(const Vector6d& strains, const Vector3d& arm_S) {
  return strains.tail<3>() + strains.head<3>().cross(arm_S);
}

TendonStrains::TendonStrains(std::span<const ScaledTendon> tendons, double load_factor, const Vector6d& rest,
                             const Vector6d& compliance)
    : tendons_(tendons), load_factor_(load_factor), rest_(rest), root_compliance_(compliance.cwiseSqrt()) {}

Vector6d TendonStrains::pull(const Vector6d& strains, double rounding) const {
  Vector6d sum = Vector6d::Zero();
  for (const ScaledTendon& tendon : tendons_) {
    const Vector3d t = tendon_tangent_S(strains, tendon.arm_S);
    const Vector3d force = (tension(tendon) / std::sqrt(t.squaredNorm() + rounding * rounding)) * t;
    sum.head<3>() += tendon.arm_S.cross(force);
    sum.tail<3>() += force;
  }
  return sum;
}

double TendonStrains::energy(const Vector6d& z, const Vector6d& weighted_wrench, double rounding) const {
  const Vector6d strains = rest_ + root_compliance_.cwiseProduct(z);
  double sum = 0.5 * z.squaredNorm() - weighted_wrench.dot(z);
  for (const ScaledTendon& tendon : tendons_) {
    sum += tension(tendon) * std::sqrt(tendon_tangent_S(strains, tendon.arm_S).squaredNorm() + rounding * rounding);
  }
  return sum;
}

Matrix6d TendonStrains::hessian(const Vector6d& strains, double rounding) const {
  Matrix6d H = Matrix6d::Identity();
  for (const ScaledTendon& tendon : tendons_) {
    const Vector3d t = tendon_tangent_S(strains, tendon.arm_S);
    const double length = std::sqrt(t.squaredNorm() + rounding * rounding);
    const Vector3d direction = t / length;
    const Eigen::Matrix<double, 3, 6> A = tangent_by_strains(tendon.arm_S) * root_compliance_.asDiagonal();
    const Matrix3d across = Matrix3d::Identity() - direction * direction.transpose();
    H.noalias() += (tension(tendon) / length) * A.transpose() * (across * A);
  }
  return H;
}

Matrix6d TendonStrains::strains_by_wrench(const Vector6d& strains) const {
  const Matrix6d D = root_compliance_.asDiagonal();
  return D * hessian(strains, 0).llt().solve(D);
}

bool TendonStrains::newton(Vector6d& z, const Vector6d& weighted_wrench, double rounding) const {
  constexpr int most_iterations = 20;
  constexpr double converged = 1e-13, roundoff_range = 1e-10, smallest_share = 1e-4;
  double last = HUGE_VAL;
  for (int i = 0; i < most_iterations; ++i) {
    const Vector6d x = rest_ + root_compliance_.cwiseProduct(z);
    const Vector6d slope = z + root_compliance_.cwiseProduct(pull(x, rounding)) - weighted_wrench;
    const Vector6d step = -hessian(x, rounding).llt().solve(slope);
    const double size = step.lpNorm<Eigen::Infinity>() / (1 + z.lpNorm<Eigen::Infinity>());
    if (!(size < HUGE_VAL)) return false;
    double share = 1;
    if (size > roundoff_range) {
      const double start = energy(z, weighted_wrench, rounding), fall = -step.dot(slope);
      const double roundoff = 1e-15 * (std::abs(start) + z.squaredNorm());
      const auto falls = [&] {
        return energy(z + share * step, weighted_wrench, rounding) <= start - 1e-4 * share * fall + roundoff;
      };
      while (!falls()) {
        if ((share /= 2) < smallest_share) return false;
      }
    }
    z += share * step;
    if (size <= converged || (size < roundoff_range && size >= last / 2)) return true;
    last = size;
  }
  return false;
}

double TendonStrains::shortest_tangent(const Vector6d& z) const {
  const Vector6d x = rest_ + root_compliance_.cwiseProduct(z);
  double shortest = HUGE_VAL;
  for (const ScaledTendon& tendon : tendons_) {
    shortest = std::min(shortest, tendon_tangent_S(x, tendon.arm_S).norm());
  }
  return shortest;
}

Vector6d TendonStrains::strains(const Vector6d& wrench) const {
  constexpr double collapsed = 1e-9;  // |t| of a straight rod is 1
  const Vector6d weighted_wrench = root_compliance_.cwiseProduct(wrench);
  const auto strains_of = [&](const Vector6d& z) { return rest_ + root_compliance_.cwiseProduct(z); };
  // Starts from tendons as they lie in the unloaded rod; exact where they do not tilt.
  Vector6d z = weighted_wrench - root_compliance_.cwiseProduct(pull(rest_, 0));
  if (z.allFinite() && newton(z, weighted_wrench, 0) && shortest_tangent(z) > collapsed) return strains_of(z);
  z = weighted_wrench;
  for (double rounding = 1; z.allFinite() && rounding > collapsed; rounding /= 4) {
    newton(z, weighted_wrench, rounding);
    if (shortest_tangent(z) < rounding) continue;
    Vector6d sharp = z;
    if (newton(sharp, weighted_wrench, 0) && shortest_tangent(sharp) > collapsed) return strains_of(sharp);
  }
  return Vector6d::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace exact_reference
