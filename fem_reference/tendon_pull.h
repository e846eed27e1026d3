// What the tendons of a section do to the rod there.
//
// A tendon of tension T at r in the section has the tangent t = v + u x r (section frame; Rucker and Webster, IEEE T-RO
// 27(6), 2011) and, per length of the rod, the energy T |t|. The sums over the tendons of its derivatives, d = t / |t|:
//   by v: the force T d,  by u: the moment r x T d,  twice: (T / |t|) (dt)^T (I - d d^T) (dt) with dt = dv - [r]x du.
#pragma once

#include "fem_reference/beam_model.h"

#include <optional>

namespace fem_reference {

struct TendonPull {
  Eigen::Vector3d force_S = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_S = Eigen::Vector3d::Zero();
  // Second derivatives of the energy; symmetric as a whole, positive semidefinite.
  Eigen::Matrix3d by_v_v = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d by_v_u = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d by_u_u = Eigen::Matrix3d::Zero();
};

// At load_factor times the tensions. Not finite where |t| = 0.
TendonPull tendon_pull(const ElementData& data, const SectionStrain& strain, double load_factor);

// The strains under a total internal force and moment (section frame), tendons included, at the full tensions:
//   K_u (u - u_rest) + sum r x T d = m,   v - e_x = C (n - sum T d),
// by Newton's iteration from `guess`. Empty if it does not converge.
std::optional<SectionStrain> strain_under(const ElementData& data, const Eigen::Vector3d& force_S,
                                          const Eigen::Vector3d& moment_S, const SectionStrain& guess);

// A tendon has collapsed where |v + u x r| is at most this (1: as long as the rod's axis), or where its tangent turns
// by a right angle or more in the section in one load step, so that |t| = 0 lies between.
constexpr double collapsed_tendon = 1e-3;
bool collapses(const ElementData& data, const SectionStrain& from, const SectionStrain& to);

}  // namespace fem_reference
