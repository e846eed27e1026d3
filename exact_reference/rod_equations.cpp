#include "exact_reference/rod_equations.h"

#include <Eigen/Geometry>

namespace exact_reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

// d(R x)/dq for sign = +1, d(R^T x)/dq for sign = -1, of R x = (w^2 - v.v) x + 2 v (v.x) + 2 w v x x.
Matrix34 rotated_by_quaternion(const Vector4d& q, const Vector3d& x, double sign) {
  const double w = q[0];
  const Vector3d v = q.tail<3>();
  Matrix34 m;
  m.col(0) = 2 * w * x + 2 * sign * v.cross(x);
  m.rightCols<3>() = 2 * (v * x.transpose() - x * v.transpose() - sign * w * cross_matrix(x));
  m.rightCols<3>().diagonal().array() += 2 * v.dot(x);
  return m;
}

}  // namespace

Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

Matrix3d rotation_of(const Vector4d& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Matrix3d m;
  m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return m;
}

Vector4d quaternion_derivative(const Vector4d& q, const Vector3d& u) {
  const Vector3d v = q.tail<3>();
  Vector4d dq;
  dq[0] = -0.5 * v.dot(u);
  dq.tail<3>() = 0.5 * (q[0] * u + v.cross(u));
  return dq;
}

Eigen::Matrix<double, 4, 3> quaternion_tangent(const Vector4d& q) {  // dq = 1/2 (0, dtheta) q
  Eigen::Matrix<double, 4, 3> m;
  m.row(0) = -0.5 * q.tail<3>().transpose();
  m.bottomRows<3>() = -0.5 * cross_matrix(q.tail<3>());
  m.bottomRows<3>().diagonal().array() += 0.5 * q[0];
  return m;
}

RodEquations::RodEquations(const ScaledSpan& span, double load_factor) : span_(span), load_factor_(load_factor) {
  const auto grown = [&](auto& value, const auto& from, const auto& to) { value = from + load_factor * (to - from); };
  const SpanLoads& from = span.before;
  grown(loads_.follower_density_S, from.follower_density_S, span.follower_density_S);
  grown(loads_.fixed_density_B, from.fixed_density_B, span.fixed_density_B);
  grown(loads_.follower_load_S.force_N, from.follower_load_S.force_N, span.follower_load_S.force_N);
  grown(loads_.follower_load_S.moment_Nmm, from.follower_load_S.moment_Nmm, span.follower_load_S.moment_Nmm);
  grown(loads_.fixed_load_B.force_N, from.fixed_load_B.force_N, span.fixed_load_B.force_N);
  grown(loads_.fixed_load_B.moment_Nmm, from.fixed_load_B.moment_Nmm, span.fixed_load_B.moment_Nmm);
  grown(loads_.fixed_force_arms_BS, from.fixed_force_arms_BS, span.fixed_force_arms_BS);
}

TendonStrains RodEquations::tendon_strains() const {
  Vector6d rest, compliance;
  rest << span_.rest_curvature_S, Vector3d::UnitX();
  compliance << span_.bending_compliance, span_.shear_compliance;
  return {span_.tendons, load_factor_, rest, compliance};
}

Strains RodEquations::strains_S(const Vector3d& n, const Vector3d& m) const {
  if (span_.tendons.empty()) {
    return {span_.rest_curvature_S + span_.bending_compliance.cwiseProduct(m),
            Vector3d::UnitX() + span_.shear_compliance.cwiseProduct(n)};
  }
  Vector6d wrench;
  wrench << m, n;
  const Vector6d strains = tendon_strains().strains(wrench);
  return {strains.head<3>(), strains.tail<3>()};
}

Strains RodEquations::strains(const State& y) const {
  const Matrix3d R = rotation_of(y.head<4>());
  return strains_S(R.transpose() * y.segment<3>(4), R.transpose() * y.segment<3>(7));
}

scene::Wrench RodEquations::own_wrench_S(const Vector3d& n, const Vector3d& m) const {
  if (span_.tendons.empty()) return {n, m};
  Vector6d strains;
  const Strains uv = strains_S(n, m);
  strains << uv.curvature_S, uv.stretch_S;
  const Vector6d pull = tendon_strains().pull(strains);
  return {n - pull.tail<3>(), m - pull.head<3>()};
}

// du/dm, du/dn, dv/dn; dv/dm is the transpose of du/dn.
RodEquations::Compliance RodEquations::compliance(const Strains& strains) const {
  if (span_.tendons.empty()) {
    return {span_.bending_compliance.asDiagonal(), Matrix3d::Zero(), span_.shear_compliance.asDiagonal()};
  }
  Vector6d uv;
  uv << strains.curvature_S, strains.stretch_S;
  const Matrix6d C = tendon_strains().strains_by_wrench(uv);
  return {C.topLeftCorner<3, 3>(), C.topRightCorner<3, 3>(), C.bottomRightCorner<3, 3>()};
}

State RodEquations::derivative(const State& y, const Matrix3d& R, const Strains& strains) const {
  const Vector3d tangent = R * strains.stretch_S;
  State dy;
  dy.head<4>() = quaternion_derivative(y.head<4>(), strains.curvature_S);
  dy.segment<3>(4) = -loads_.fixed_density_B - R * loads_.follower_density_S;
  dy.segment<3>(7) = -tangent.cross(y.segment<3>(4));
  dy.tail<3>() = tangent;
  return dy;
}

State RodEquations::derivative(const State& y) const {
  return derivative(y, rotation_of(y.head<4>()), strains(y));
}

State RodEquations::derivative(const State& y, CoreMatrix& J) const {
  const Vector4d q = y.head<4>();
  const Vector3d N = y.segment<3>(4), M = y.segment<3>(7);
  const Matrix3d R = rotation_of(q);
  const Strains strains = strains_S(R.transpose() * N, R.transpose() * M);
  const auto& [u, v] = strains;
  const Vector3d tangent = R * v;
  const Matrix34 m_by_q = rotated_by_quaternion(q, M, -1), n_by_q = rotated_by_quaternion(q, N, -1);
  const Compliance C = compliance(strains);

  // q' = W(u) q = 2 E(q) u with E = dq'/du.
  Eigen::Matrix<double, 4, 3> dq_by_u;
  dq_by_u.row(0) = -0.5 * q.tail<3>().transpose();
  dq_by_u.bottomRows<3>() = 0.5 * cross_matrix(q.tail<3>());
  dq_by_u.bottomRows<3>().diagonal().array() += 0.5 * q[0];
  Eigen::Matrix4d dq_by_q;
  dq_by_q << 0, -0.5 * u.transpose(), 0.5 * u, -0.5 * cross_matrix(u);

  const Matrix34 tangent_by_q = rotated_by_quaternion(q, v, 1) + R * (C.vn * n_by_q + C.un.transpose() * m_by_q);
  const Matrix3d tangent_by_N = R * C.vn * R.transpose(), u_by_N = C.un * R.transpose();

  J.setZero();
  J.block<4, 4>(0, 0) = dq_by_q + dq_by_u * (C.um * m_by_q + C.un * n_by_q);
  J.block<4, 3>(0, 4) = dq_by_u * u_by_N;
  J.block<4, 3>(0, 7) = dq_by_u * (C.um * R.transpose());
  J.block<3, 4>(4, 0) = -rotated_by_quaternion(q, loads_.follower_density_S, 1);
  J.block<3, 4>(7, 0) = cross_matrix(N) * tangent_by_q;
  J.block<3, 3>(7, 4) = cross_matrix(N) * tangent_by_N - cross_matrix(tangent);
  J.block<3, 3>(7, 7) = cross_matrix(N) * (R * C.un.transpose() * R.transpose());
  return derivative(y, R, strains);
}

void RodEquations::wrench_derivative_S(const Vector3d& n, const Vector3d& m, const Strains& strains, Vector3d& dn,
                                       Vector3d& dm) const {
  const auto& [u, v] = strains;
  dn = -u.cross(n) - loads_.follower_density_S;
  dm = -u.cross(m) - v.cross(n);
}

State RodEquations::beyond_point_loads(const State& y) const {
  const Matrix3d R = rotation_of(y.head<4>());
  State out = y;
  out.segment<3>(4) -= loads_.fixed_load_B.force_N + R * loads_.follower_load_S.force_N;
  out.segment<3>(7) -= loads_.fixed_load_B.moment_Nmm + R * loads_.follower_load_S.moment_Nmm;
  out.segment<3>(7) -= scene::moment_of_arms<double>(loads_.fixed_force_arms_BS * R.transpose());
  return out;
}

CoreMatrix RodEquations::beyond_point_loads_jacobian(const State& y) const {
  CoreMatrix J = CoreMatrix::Identity();
  J.block<3, 4>(4, 0) = -rotated_by_quaternion(y.head<4>(), loads_.follower_load_S.force_N, 1);
  J.block<3, 4>(7, 0) = -rotated_by_quaternion(y.head<4>(), loads_.follower_load_S.moment_Nmm, 1);
  for (int axis = 1; axis < 3; ++axis) {  // the moment is sum (R e_axis) x arms.col(axis)
    if (loads_.fixed_force_arms_BS.col(axis).isZero(0)) continue;
    J.block<3, 4>(7, 0) += cross_matrix(loads_.fixed_force_arms_BS.col(axis)) *
                           rotated_by_quaternion(y.head<4>(), Vector3d::Unit(axis), 1);
  }
  return J;
}

Matrix3d RodEquations::arms_second_variation(const State& y) const {
  const Matrix3d arms_B = loads_.fixed_force_arms_BS * rotation_of(y.head<4>()).transpose();  // sum F a^T
  return arms_B.trace() * Matrix3d::Identity() - (arms_B + arms_B.transpose()) / 2;
}

}  // namespace exact_reference
