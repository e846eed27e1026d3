#include "fem_reference/point_terms.h"

namespace fem_reference {

PointGradient::PointGradient(const ElementData& data, const Eigen::Vector3d& dr_B, const Quaternion& p,
                             const Quaternion& dp, const Eigen::Vector3d& n, double load_factor)
    : R(rotation_matrix(p)), u(curvature(p, dp)) {
  const Eigen::Vector3d v = R.transpose() * dr_B;
  pull = tendon_pull(data, {v, u.value}, load_factor);
  n_total = n + pull.force_S;
  m_total = data.moment_stiffness.cwiseProduct(u.value - data.rest_curvature) + pull.moment_S;
  by_n_p = rotated_back_by_p(p, dr_B);
  by_dr = R * n_total;
  by_n = v - Eigen::Vector3d::UnitX() - data.force_compliance.cwiseProduct(n);
  by_p = by_n_p.transpose() * n_total + u.by_p.transpose() * m_total;
  by_dp = u.by_dp.transpose() * m_total;
  load_B = load_factor * (data.fixed_force_B + R * data.follower_force_S);
}

PointHessian::PointHessian(const ElementData& data, const Eigen::Vector3d& dr_B, const Quaternion& p,
                           const Quaternion& dp, const PointGradient& at, double load_factor) {
  // The section's frame turns, the moment changes with u,
  const CurvaturePower power = curvature_power(p, dp, at.m_total);
  const Eigen::Matrix3d K = Eigen::Matrix3d(data.moment_stiffness.asDiagonal()) + at.pull.by_u_u;
  const Matrix34 m_by_p = K * at.u.by_p, m_by_dp = K * at.u.by_dp;
  by_dr_p = rotated_by_p(p, at.n_total);
  by_p_p = power_by_p_p(p, dr_B, at.n_total) + power.by_p_p + at.u.by_p.transpose() * m_by_p;
  by_p_dp = power.by_p_dp + at.u.by_p.transpose() * m_by_dp;
  by_dp_dp = at.u.by_dp.transpose() * m_by_dp;
  by_dr_dr.setZero();
  by_dr_dp.setZero();
  if (!data.tendons.empty()) add_tendons(at);
  load_by_p.setZero();
  if (!data.follower_force_S.isZero(0)) load_by_p = load_factor * rotated_by_p(p, data.follower_force_S);
}

// and so do the tendons' pull and its moment with v and u.
void PointHessian::add_tendons(const PointGradient& at) {
  const TendonPull& pull = at.pull;
  const Matrix34 n_by_p = pull.by_v_v * at.by_n_p + pull.by_v_u * at.u.by_p, n_by_dp = pull.by_v_u * at.u.by_dp;
  by_dr_dr = at.R * pull.by_v_v * at.R.transpose();
  by_dr_p += at.R * n_by_p;
  by_dr_dp = at.R * n_by_dp;
  by_p_p += at.by_n_p.transpose() * n_by_p + at.u.by_p.transpose() * (pull.by_v_u.transpose() * at.by_n_p);
  by_p_dp += at.by_n_p.transpose() * n_by_dp;
}

}  // namespace fem_reference
