// What one Gauss point adds to an element: gradient and Hessian of the functional's integrand (beam_element.h) by r',
// the quaternion p, p' and the internal force n, and the external force per length.
#pragma once

#include "fem_reference/section_strain.h"
#include "fem_reference/tendon_pull.h"

namespace fem_reference {

struct PointGradient {
  PointGradient(const ElementData& data, const Eigen::Vector3d& dr_B, const Quaternion& p, const Quaternion& dp,
                const Eigen::Vector3d& n, double load_factor);

  Eigen::Matrix3d R;
  Curvature u;
  TendonPull pull;
  Eigen::Vector3d n_total, m_total;  // with the tendons, section frame
  Matrix34 by_n_p;                   // of v by p

  Eigen::Vector3d by_dr;  // the total force in the base frame
  Eigen::Vector3d by_n;   // v - e_x - C n
  Quaternion by_p, by_dp;
  Eigen::Vector3d load_B;
};

// Second derivatives, rows by the first, columns by the second name.
struct PointHessian {
  PointHessian(const ElementData& data, const Eigen::Vector3d& dr_B, const Quaternion& p, const Quaternion& dp,
               const PointGradient& at, double load_factor);

  Eigen::Matrix3d by_dr_dr;
  Matrix34 by_dr_p, by_dr_dp;
  Eigen::Matrix4d by_p_p, by_p_dp, by_dp_dp;
  Matrix34 load_by_p;  // of load_B

 private:
  void add_tendons(const PointGradient& at);
};

}  // namespace fem_reference
