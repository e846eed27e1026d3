#include "exact_reference/rod_equations.h"

#include <Eigen/Geometry>

namespace exact_reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

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

RodEquations::RodEquations(const ScaledSpan& span, double load_factor)
    : bending_compliance_(span.bending_compliance),
      shear_compliance_(span.shear_compliance),
      rest_curvature_(span.rest_curvature_S +
                      load_factor * span.bending_compliance.cwiseProduct(span.tendon_S.moment_Nmm)),
      rest_stretch_(Vector3d::UnitX() + load_factor * span.shear_compliance.cwiseProduct(span.tendon_S.force_N)),
      follower_density_(load_factor * span.follower_density_S),
      fixed_density_(load_factor * span.fixed_density_B),
      follower_load_{load_factor * span.follower_load_S.force_N, load_factor * span.follower_load_S.moment_Nmm},
      fixed_load_{load_factor * span.fixed_load_B.force_N, load_factor * span.fixed_load_B.moment_Nmm} {}

State RodEquations::derivative(const State& y) const {
  const Vector4d q = y.head<4>();
  const Vector3d N = y.segment<3>(4);
  const Matrix3d R = rotation_of(q);
  const Vector3d u = curvature_S(R.transpose() * y.segment<3>(7));
  const Vector3d tangent = R * stretch_S(R.transpose() * N);
  State dy;
  dy.head<4>() = quaternion_derivative(q, u);
  dy.segment<3>(4) = -fixed_density_ - R * follower_density_;
  dy.segment<3>(7) = -tangent.cross(N);
  dy.tail<3>() = tangent;
  return dy;
}

CoreMatrix RodEquations::jacobian(const State& y) const {
  const Vector4d q = y.head<4>();
  const Vector3d N = y.segment<3>(4), M = y.segment<3>(7);
  const Matrix3d R = rotation_of(q);
  const Vector3d u = curvature_S(R.transpose() * M);
  const Vector3d v = stretch_S(R.transpose() * N);
  const Vector3d tangent = R * v;

  // q' = W(u) q = 2 E(q) u with E = dq'/du.
  Eigen::Matrix<double, 4, 3> dq_by_u;
  dq_by_u.row(0) = -0.5 * q.tail<3>().transpose();
  dq_by_u.bottomRows<3>() = 0.5 * cross_matrix(q.tail<3>());
  dq_by_u.bottomRows<3>().diagonal().array() += 0.5 * q[0];
  Eigen::Matrix4d dq_by_q;
  dq_by_q << 0, -0.5 * u.transpose(), 0.5 * u, -0.5 * cross_matrix(u);

  const Matrix34 tangent_by_q =
      rotated_by_quaternion(q, v, 1) + R * shear_compliance_.asDiagonal() * rotated_by_quaternion(q, N, -1);
  const Matrix3d tangent_by_N = R * shear_compliance_.asDiagonal() * R.transpose();

  CoreMatrix J = CoreMatrix::Zero();
  J.block<4, 4>(0, 0) = dq_by_q + dq_by_u * bending_compliance_.asDiagonal() * rotated_by_quaternion(q, M, -1);
  J.block<4, 3>(0, 7) = dq_by_u * bending_compliance_.asDiagonal() * R.transpose();
  J.block<3, 4>(4, 0) = -rotated_by_quaternion(q, follower_density_, 1);
  J.block<3, 4>(7, 0) = cross_matrix(N) * tangent_by_q;
  J.block<3, 3>(7, 4) = cross_matrix(N) * tangent_by_N - cross_matrix(tangent);
  return J;
}

void RodEquations::wrench_derivative_S(const Vector3d& n, const Vector3d& m, Vector3d& dn, Vector3d& dm) const {
  const Vector3d u = curvature_S(m);
  dn = -u.cross(n) - follower_density_;
  dm = -u.cross(m) - stretch_S(n).cross(n);
}

State RodEquations::beyond_point_loads(const State& y) const {
  const Matrix3d R = rotation_of(y.head<4>());
  State out = y;
  out.segment<3>(4) -= fixed_load_.force_N + R * follower_load_.force_N;
  out.segment<3>(7) -= fixed_load_.moment_Nmm + R * follower_load_.moment_Nmm;
  return out;
}

CoreMatrix RodEquations::beyond_point_loads_jacobian(const State& y) const {
  CoreMatrix J = CoreMatrix::Identity();
  J.block<3, 4>(4, 0) = -rotated_by_quaternion(y.head<4>(), follower_load_.force_N, 1);
  J.block<3, 4>(7, 0) = -rotated_by_quaternion(y.head<4>(), follower_load_.moment_Nmm, 1);
  return J;
}

}  // namespace exact_reference
