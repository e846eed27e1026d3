#include "fem_reference/tendon_pull.h"

#include <Eigen/LU>

#include <algorithm>

namespace fem_reference {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Eigen::Vector3d tangent_of(const scene::SectionTendon& tendon, const SectionStrain& strain) {
  return strain.v + strain.u.cross(tendon.arm_S_mm);
}

// Newton's increment of (v, u).
Vector6 increment(const ElementData& data, const Eigen::Vector3d& force_S, const Eigen::Vector3d& moment_S,
                  const SectionStrain& strain) {
  const TendonPull pull = tendon_pull(data, strain, 1);
  const auto C = data.force_compliance.asDiagonal();
  Vector6 excess;
  excess.head<3>() = strain.v - Eigen::Vector3d::UnitX() - C * (force_S - pull.force_S);
  excess.tail<3>() = data.moment_stiffness.cwiseProduct(strain.u - data.rest_curvature) + pull.moment_S - moment_S;
  Matrix6 J;
  J.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() + C * pull.by_v_v;
  J.topRightCorner<3, 3>() = C * pull.by_v_u;
  J.bottomLeftCorner<3, 3>() = pull.by_v_u.transpose();
  J.bottomRightCorner<3, 3>() = Eigen::Matrix3d(data.moment_stiffness.asDiagonal()) + pull.by_u_u;
  return -J.partialPivLu().solve(excess);
}

}  // namespace

TendonPull tendon_pull(const ElementData& data, const SectionStrain& strain, double load_factor) {
  TendonPull pull;
  for (const scene::SectionTendon& tendon : data.tendons) {
    const Eigen::Vector3d t = tangent_of(tendon, strain);
    const Eigen::Vector3d d = t / t.norm();
    const Eigen::Matrix3d arm = skew(tendon.arm_S_mm);
    const double tension = load_factor * tendon.tension_N;
    pull.force_S += tension * d;
    pull.moment_S += tension * (arm * d);
    const Eigen::Matrix3d across = tension / t.norm() * (Eigen::Matrix3d::Identity() - d * d.transpose());
    pull.by_v_v += across;
    pull.by_v_u -= across * arm;
    pull.by_u_u += arm.transpose() * across * arm;
  }
  return pull;
}

std::optional<SectionStrain> strain_under(const ElementData& data, const Eigen::Vector3d& force_S,
                                          const Eigen::Vector3d& moment_S, const SectionStrain& guess) {
  constexpr int max_iterations = 20;
  constexpr double tolerance = 1e-10;  // the iteration converges quadratically: the strain left is round-off
  SectionStrain strain = guess;
  for (int i = 0; i < max_iterations; ++i) {
    const Vector6 step = increment(data, force_S, moment_S, strain);
    if (!step.allFinite()) return {};
    strain.v += step.head<3>();
    strain.u += step.tail<3>();
    if (step.norm() <= tolerance * (1 + strain.u.norm())) return strain;
  }
  return {};
}

bool collapses(const ElementData& data, const SectionStrain& from, const SectionStrain& to) {
  return std::any_of(data.tendons.begin(), data.tendons.end(), [&](const scene::SectionTendon& tendon) {
    const Eigen::Vector3d t = tangent_of(tendon, to);
    return t.norm() <= collapsed_tendon || t.dot(tangent_of(tendon, from)) <= 0;
  });
}

}  // namespace fem_reference
