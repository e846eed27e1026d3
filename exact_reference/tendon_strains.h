// The strains of a section through which tendons run (Rucker and Webster, IEEE T-RO 27(6), 2011), dimensionless.
//
// With x = (u, v), total wrench W = (m, n), compliance C = diag(K_u^-1, K_v^-1) and a tendon's tangent
// t = v + u x r = A x, A = [-[r]x, I]:
//
//   x = x0 + C (W - g(x))     g = sum T A^T t/|t|     S = dg/dx = sum (T/|t|) A^T (I - t t^T/|t|^2) A >= 0
//
// With C = D^2, x = x0 + D z, this is the minimum of the strictly convex 1/2 z.z + sum T |t| - W.D z, which Newton's
// iteration with a line search finds, zeros in C included; dx/dW = D (I + D S D)^-1 D = (I + C S)^-1 C. Near a |t| of
// zero, where the energy has a kink, from the minima of energies with the kink rounded off less and less.
#pragma once

#include <Eigen/Core>

#include <span>

namespace exact_reference {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// The tendons held at one place of the section.
struct ScaledTendon {
  Eigen::Vector3d arm_S = Eigen::Vector3d::Zero();  // r = (0, y, z)
  double tension = 0;
  double tension_before = 0;  // that it grows from
};

// v + u x r of strains (u, v).
Eigen::Vector3d tendon_tangent_S(const Vector6d& strains, const Eigen::Vector3d& arm_S);

class TendonStrains {
 public:
  // `tendons` must outlive this; load_factor: the share of the way from the tensions before, 0, to their own, 1.
  TendonStrains(std::span<const ScaledTendon> tendons, double load_factor, const Vector6d& rest,
                const Vector6d& compliance);

  // (u, v) under the total wrench (m, n). Not a number where a tendon's path has no length: its pull has no direction.
  Vector6d strains(const Vector6d& wrench) const;
  Matrix6d strains_by_wrench(const Vector6d& strains) const;  // symmetric

  // g: moment and force with which the tendons press the section.
  Vector6d pull(const Vector6d& strains) const { return pull(strains, 0); }

 private:
  // With T sqrt(|t|^2 + rounding^2) for T |t|. The Hessian is I + D S D.
  Vector6d pull(const Vector6d& strains, double rounding) const;
  Matrix6d hessian(const Vector6d& strains, double rounding) const;
  double energy(const Vector6d& z, const Vector6d& weighted_wrench, double rounding) const;
  bool newton(Vector6d& z, const Vector6d& weighted_wrench, double rounding) const;

  double shortest_tangent(const Vector6d& z) const;
  double tension(const ScaledTendon& tendon) const {
    return tendon.tension_before + load_factor_ * (tendon.tension - tendon.tension_before);
  }

  std::span<const ScaledTendon> tendons_;
  double load_factor_;
  Vector6d rest_, root_compliance_;
};

}  // namespace exact_reference
