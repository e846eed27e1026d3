// Screw motions: the SE(3) exponential of a constant strain, and the wrench carried through it (theory: one arc).
//
// Accuracy: the coefficients A, B, C have a relative error below 4e-16 at any angle; for |theta| < 1 they are Taylor
// series, because the closed forms cancel there, beyond it closed forms without cancellation.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

// Inlines all that a kernel calls: an arc takes half the time. Not under sanitizers, where it takes minutes to compile.
#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__)
#define FAM_FLATTEN
#else
#define FAM_FLATTEN [[gnu::flatten]]
#endif

namespace fam {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Everything here is a template on the scalar: double, or a number that carries derivatives along.
template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

// Strain times arc length: rotation vector (rad) and translation (mm), both in the arc's proximal frame.
template <class T>
struct BasicScrew {
  Vector3<T> rotation = Vector3<T>::Zero();
  Vector3<T> translation_mm = Vector3<T>::Zero();
};
using Screw = BasicScrew<double>;

template <class T>
BasicScrew<T> operator+(const BasicScrew<T>& a, const BasicScrew<T>& b) {
  return {a.rotation + b.rotation, a.translation_mm + b.translation_mm};
}
template <class T>
BasicScrew<T> operator*(double factor, const BasicScrew<T>& a) {
  return {a.rotation * T(factor), a.translation_mm * T(factor)};
}

// Lie bracket of se(3).
template <class T>
BasicScrew<T> bracket(const BasicScrew<T>& a, const BasicScrew<T>& b) {
  return {a.rotation.cross(b.rotation), a.rotation.cross(b.translation_mm) + a.translation_mm.cross(b.rotation)};
}

// Internal force and moment in a section frame.
template <class T>
struct BasicWrench {
  Vector3<T> force_N = Vector3<T>::Zero();
  Vector3<T> moment_Nmm = Vector3<T>::Zero();
};
using SectionWrench = BasicWrench<double>;

template <class T>
BasicWrench<T> operator+(const BasicWrench<T>& a, const BasicWrench<T>& b) {
  return {a.force_N + b.force_N, a.moment_Nmm + b.moment_Nmm};
}
template <class T>
BasicWrench<T> operator*(double factor, const BasicWrench<T>& a) {
  return {a.force_N * T(factor), a.moment_Nmm * T(factor)};
}

// A = sin t / t, B = (1 - cos t) / t^2, C = (t - sin t) / t^3.
template <class T>
struct BasicCoefficients {
  T A, B, C;
};
using ScrewCoefficients = BasicCoefficients<double>;

template <class T>
BasicCoefficients<T> screw_coefficients(const T& angle_squared) {
  using std::sin;
  using std::sqrt;
  const T& x = angle_squared;
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
  const T angle = sqrt(x);
  const T a = sin(angle) / angle;
  const T half = sin(angle / 2);
  return {a, 2 * half * half / x, (1 - a) / x};
}

// exp of a screw, kept as increments to the identity so that products of many small ones do not lose digits:
// R x = x + A w x x + B w x (w x x).
template <class T>
struct BasicMotion {
  Vector3<T> rotation;     // w, rad
  Vector3<T> position_mm;  // p = (I + B [w]x + C [w]x^2) d
  T A, B;

  Vector3<T> rotate(const Vector3<T>& x) const {
    const Vector3<T> wx = rotation.cross(x);
    return x + (A * wx + B * rotation.cross(wx));
  }
  Vector3<T> rotate_back(const Vector3<T>& x) const {
    const Vector3<T> wx = rotation.cross(x);
    return x + (B * rotation.cross(wx) - A * wx);
  }
};
using RigidMotion = BasicMotion<double>;

template <class T>
BasicMotion<T> exponential(const BasicScrew<T>& screw) {
  const Vector3<T>& w = screw.rotation;
  const Vector3<T>& d = screw.translation_mm;
  const T angle_squared = w.dot(w);
  const BasicCoefficients<T> k = screw_coefficients(angle_squared);
  const Vector3<T> wd = w.cross(d);
  return {w, d + (k.B * wd + k.C * w.cross(wd)), k.A, k.B};
}

// A turn about the tangent.
inline RigidMotion twist(double angle_rad) {
  return exponential(Screw{{angle_rad, 0, 0}, Vector3d::Zero()});
}

// Wrench at the proximal end of a motion from the one at its distal end: n_p = R n_d, m_p = R m_d + p x n_p.
template <class T>
BasicWrench<T> transport(const BasicMotion<T>& motion, const BasicWrench<T>& distal) {
  const Vector3<T> force = motion.rotate(distal.force_N);
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
