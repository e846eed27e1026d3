// The rod's differential equations, dimensionless (scaled_rod.h), Kirchhoff and Reissner alike, in two forms:
// with the wrench in the base frame (boundary_value) and in the section frame (initial_value).
//
//   p' = R v      q' = 1/2 q (0, u)      N' = -f_B - R f_S                M' = -(R v) x N         base frame
//                                        n' = -u x n - f                  m' = -u x m - v x n     section frame
//   u = u0 + K_u^-1 (R^T M - m_tendons)   v = e_x + K_v^-1 (R^T N - n_tendons)
//
// N, M: what the distal part, tendons included, exerts on the proximal one; nothing of it jumps where a tendon ends.
// The rod's own share is that less the tendons' pulls along v + u x r (tendon_strains.h). q is a unit quaternion
// (w, x, y, z) taken as four plain unknowns: q' keeps |q|, so that one condition |q| = 1 at the clamp is enough, and
// full turns need no care.
#pragma once

#include "exact_reference/scaled_rod.h"

namespace exact_reference {

// Base-frame state: q 0-3, N 4-6, M 7-9, p 10-12. Nothing depends on p, so the unknowns of the solver are the first
// ten.
constexpr int core_size = 10;
constexpr int state_size = 13;
using State = Eigen::Matrix<double, state_size, 1>;
using Core = Eigen::Matrix<double, core_size, 1>;
using CoreMatrix = Eigen::Matrix<double, core_size, core_size>;

// Rotation of the quaternion, in the form that is quadratic in q (|q|^2 times a rotation).
Eigen::Matrix3d rotation_of(const Eigen::Vector4d& q);

struct Strains {
  Eigen::Vector3d curvature_S;  // u
  Eigen::Vector3d stretch_S;    // v
};

// A span on the way from the loads before, at a load_factor of 0, to its own, at 1 (tendons are loads; the rest
// curvature is not). The span must outlive it.
class RodEquations {
 public:
  RodEquations(const ScaledSpan& span, double load_factor);

  State derivative(const State& y) const;
  // And those of the first ten derivatives by the first ten unknowns.
  State derivative(const State& y, CoreMatrix& jacobian) const;

  // u and v under a wrench in the section frame. Not a number where a tendon's path has no length.
  Strains strains_S(const Eigen::Vector3d& force_S, const Eigen::Vector3d& moment_S) const;
  Strains strains(const State& y) const;

  // The rod's own share of a wrench in the section frame: less the tendons' pulls.
  scene::Wrench own_wrench_S(const Eigen::Vector3d& force_S, const Eigen::Vector3d& moment_S) const;

  // n and m of the section frame; follower densities only.
  void wrench_derivative_S(const Eigen::Vector3d& force_S, const Eigen::Vector3d& moment_S, const Strains& strains,
                           Eigen::Vector3d& d_force_S, Eigen::Vector3d& d_moment_S) const;

  // State just beyond the point loads at the span's end, and its derivative by the state before them.
  State beyond_point_loads(const State& y) const;
  CoreMatrix beyond_point_loads_jacobian(const State& y) const;

  // Second variation of the energy of the fixed forces off the centreline at the span's end, by a small rotation in the
  // base frame: 1/2 theta . (...) theta. With a = R r that is sum (F.a) I - sym(F a^T).
  Eigen::Matrix3d arms_second_variation(const State& y) const;

 private:
  struct Compliance {
    Eigen::Matrix3d um, un, vn;
  };
  Compliance compliance(const Strains& strains) const;
  State derivative(const State& y, const Eigen::Matrix3d& R, const Strains& strains) const;
  TendonStrains tendon_strains() const;

  const ScaledSpan& span_;
  double load_factor_;
  SpanLoads loads_;
};

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a);  // times b: a x b

// q' = 1/2 q (0, u).
Eigen::Vector4d quaternion_derivative(const Eigen::Vector4d& q, const Eigen::Vector3d& curvature_S);

// 4x3 matrix T with dq = T dtheta for a small rotation dtheta in the base frame; T^T T = I/4.
Eigen::Matrix<double, 4, 3> quaternion_tangent(const Eigen::Vector4d& q);

}  // namespace exact_reference
