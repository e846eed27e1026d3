// Screw motions: the SE(3) exponential of a constant strain, and the wrench carried through it (theory: one arc).
//
// Accuracy: the coefficients A, B, C have a relative error below 4e-16 at any angle; for |theta| < 1 they are Taylor
// series, because the closed forms cancel there, beyond it closed forms without cancellation.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace fam {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Strain times arc length: rotation vector (rad) and translation (mm), both in the arc's proximal frame.
struct Screw {
  Vector3d rotation = Vector3d::Zero();
  Vector3d translation_mm = Vector3d::Zero();
};

inline Screw operator+(const Screw& a, const Screw& b) {
  return {a.rotation + b.rotation, a.translation_mm + b.translation_mm};
}
inline Screw operator*(double factor, const Screw& a) {
  return {factor * a.rotation, factor * a.translation_mm};
}

// Lie bracket of se(3).
inline Screw bracket(const Screw& a, const Screw& b) {
  return {a.rotation.cross(b.rotation), a.rotation.cross(b.translation_mm) + a.translation_mm.cross(b.rotation)};
}

// Internal force and moment in a section frame.
struct SectionWrench {
  Vector3d force_N = Vector3d::Zero();
  Vector3d moment_Nmm = Vector3d::Zero();
};

// A = sin t / t, B = (1 - cos t) / t^2, C = (t - sin t) / t^3.
struct ScrewCoefficients {
  double A, B, C;
};

inline ScrewCoefficients screw_coefficients(double angle_squared) {
  const double x = angle_squared;
  if (x < 1) {  // the first dropped term is below 1/19! = 8e-18
    // clang-format off
    return {1 - x * (1 / 6. - x * (1 / 120. - x * (1 / 5040. - x * (1 / 362880. - x * (1 / 39916800.
              - x * (1 / 6227020800. - x * (1 / 1307674368000. - x * (1 / 355687428096000.)))))))),
            1 / 2. - x * (1 / 24. - x * (1 / 720. - x * (1 / 40320. - x * (1 / 3628800. - x * (1 / 479001600.
              - x * (1 / 87178291200. - x * (1 / 20922789888000.))))))),
            1 / 6. - x * (1 / 120. - x * (1 / 5040. - x * (1 / 362880. - x * (1 / 39916800. - x * (1 / 6227020800.
              - x * (1 / 1307674368000. - x * (1 / 355687428096000.)))))))};
    // clang-format on
  }
  const double angle = std::sqrt(x);
  const double a = std::sin(angle) / angle;
  const double half = std::sin(angle / 2);
  return {a, 2 * half * half / x, (1 - a) / x};
}

// exp of a screw, kept as increments to the identity so that products of many small ones do not lose digits:
// R x = x + A w x x + B w x (w x x).
struct RigidMotion {
  Vector3d rotation;     // w, rad
  Vector3d position_mm;  // p = (I + B [w]x + C [w]x^2) d
  double A, B;

  Vector3d rotate(const Vector3d& x) const {
    const Vector3d wx = rotation.cross(x);
    return x + (A * wx + B * rotation.cross(wx));
  }
  Vector3d rotate_back(const Vector3d& x) const {
    const Vector3d wx = rotation.cross(x);
    return x + (B * rotation.cross(wx) - A * wx);
  }
};

inline RigidMotion exponential(const Screw& screw) {
  const Vector3d& w = screw.rotation;
  const Vector3d& d = screw.translation_mm;
  const auto [A, B, C] = screw_coefficients(w.squaredNorm());
  const Vector3d wd = w.cross(d);
  return {w, d + (B * wd + C * w.cross(wd)), A, B};
}

// Wrench at the proximal end of a motion from the one at its distal end: n_p = R n_d, m_p = R m_d + p x n_p.
inline SectionWrench transport(const RigidMotion& motion, const SectionWrench& distal) {
  const Vector3d force = motion.rotate(distal.force_N);
  return {force, motion.rotate(distal.moment_Nmm) + motion.position_mm.cross(force)};
}

// Pose of a section frame S in the base frame B; the rows of the rotation are turned one by one.
struct SectionPose {
  Matrix3d rotation_BS = Matrix3d::Identity();
  Vector3d position_B_mm = Vector3d::Zero();

  SectionPose then(const RigidMotion& motion) const {
    SectionPose next;
    next.position_B_mm = position_B_mm + rotation_BS * motion.position_mm;
    for (int row = 0; row < 3; ++row) {
      next.rotation_BS.row(row) = motion.rotate_back(rotation_BS.row(row).transpose()).transpose();
    }
    return next;
  }
};

}  // namespace fam
