#include "fem_reference/section_strain.h"

namespace fem_reference {

namespace {

// f = F / rho with F quadratic in p: from the gradient of f and the Hessian of F to the Hessian of f.
Eigen::Matrix4d hessian_of_quotient(const Quaternion& p, double f, const Quaternion& gradient,
                                    const Eigen::Matrix4d& quadratic_hessian) {
  const Eigen::Matrix4d mixed = p * gradient.transpose();
  return (quadratic_hessian - 2 * f * Eigen::Matrix4d::Identity() - 2 * (mixed + mixed.transpose())) / p.squaredNorm();
}

}  // namespace

Matrix34 rotated_by_p(const Quaternion& p, const Eigen::Vector3d& a) {
  const double w = p[0];
  const Eigen::Vector3d x = p.tail<3>();
  Matrix34 derivative;
  derivative.col(0) = 2 * (w * a + x.cross(a));
  derivative.rightCols<3>() =
      2 * (x * a.transpose() - a * x.transpose() + x.dot(a) * Eigen::Matrix3d::Identity() - w * skew(a));
  derivative -= 2 * rotated(p, a) * p.transpose();
  return derivative / p.squaredNorm();
}

Matrix34 rotated_back_by_p(const Quaternion& p, const Eigen::Vector3d& a) {
  Matrix34 derivative = rotated_by_p(conjugate(p), a);
  derivative.rightCols<3>() *= -1;
  return derivative;
}

Eigen::Matrix4d power_by_p_p(const Quaternion& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // F = rho a . R(p) b = (w^2 - x.x) a.b + 2 (x.a)(x.b) + 2 w x.(b x a) is a quadratic form in p.
  Eigen::Matrix4d quadratic;
  quadratic(0, 0) = 2 * a.dot(b);
  quadratic.block<3, 1>(1, 0) = 2 * b.cross(a);
  quadratic.block<1, 3>(0, 1) = quadratic.block<3, 1>(1, 0).transpose();
  quadratic.block<3, 3>(1, 1) =
      2 * (a * b.transpose() + b * a.transpose()) - 2 * a.dot(b) * Eigen::Matrix3d::Identity();
  const double rho = p.squaredNorm();
  const Quaternion half_gradient = quadratic * p;
  const double f = 0.5 * p.dot(half_gradient) / rho;
  return hessian_of_quotient(p, f, (half_gradient - 2 * f * p) / rho, quadratic);
}

Curvature curvature(const Quaternion& p, const Quaternion& dp) {
  const double w = p[0], dw = dp[0], rho = p.squaredNorm();
  const Eigen::Vector3d x = p.tail<3>(), dx = dp.tail<3>();
  Curvature u;
  u.value = 2 * (w * dx - dw * x - x.cross(dx)) / rho;
  u.by_p.col(0) = 2 * dx;
  u.by_p.rightCols<3>() = 2 * (skew(dx) - dw * Eigen::Matrix3d::Identity());
  u.by_p -= 2 * u.value * p.transpose();
  u.by_p /= rho;
  u.by_dp.col(0) = -2 * x;
  u.by_dp.rightCols<3>() = 2 * (w * Eigen::Matrix3d::Identity() - skew(x));
  u.by_dp /= rho;
  return u;
}

CurvaturePower curvature_power(const Quaternion& p, const Quaternion& dp, const Eigen::Vector3d& m) {
  // rho m . u = p^T B p' with the skew-symmetric B below.
  Eigen::Matrix4d bilinear;
  bilinear(0, 0) = 0;
  bilinear.block<1, 3>(0, 1) = 2 * m.transpose();
  bilinear.block<3, 1>(1, 0) = -2 * m;
  bilinear.block<3, 3>(1, 1) = 2 * skew(m);
  const double rho = p.squaredNorm();
  const Quaternion by_p = bilinear * dp;
  const Quaternion by_dp = bilinear.transpose() * p;
  const double f = p.dot(by_p) / rho;
  CurvaturePower power;
  power.by_p_p = hessian_of_quotient(p, f, (by_p - 2 * f * p) / rho, Eigen::Matrix4d::Zero());
  power.by_p_dp = (bilinear - 2 * p * by_dp.transpose() / rho) / rho;
  return power;
}

}  // namespace fem_reference
