// Screw motions: the SE(3) exponential of a constant strain, and the wrench carried through it.
//
// Accuracy: the coefficients A, B, C have a relative error below 4e-16 at any angle; for |theta| < 1 they are Taylor
// series, because the closed forms cancel there, beyond it closed forms without cancellation.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

// Inlines all that a kernel calls: an arc takes half the time. Not under sanitizers, where it takes minutes to compile,
// and not with assertions, where GCC 12 fails on it.
#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__) || !defined(NDEBUG)
#define FAM_FLATTEN
#else
#define FAM_FLATTEN [[gnu::flatten]]
#endif

namespace fam {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Everything here is a template on the scalar T: double, or a number that carries derivatives along; and on the
// dimension D: 3, or 2 for rods in the x-y plane. Forces and positions have D components, turns and moments those about
// the axes left: three, or the one about z.
template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T, int D>
struct VectorOf {  // fam/wide.h has another
  using Type = Eigen::Matrix<T, D, 1>;
};
template <class T, int D>
using Vector = typename VectorOf<T, D>::Type;
constexpr int rotations_of(int dimension) {
  return dimension == 3 ? 3 : 1;
}
template <class T, int D>
using Angular = Vector<T, rotations_of(D)>;

// What a constant is that T is multiplied by.
template <class T>
struct FactorOf {  // fam/dual.h has another
  using Type = T;
};
template <class T>
using Factor = typename FactorOf<T>::Type;

// A vector's numbers as T.
template <class T, int D>
Vector<T, D> as(const Eigen::Matrix<double, D, 1>& v) {
  return v.template cast<T>();
}

// Cross products: turn x vector, turn x turn (nothing in the plane), and vector x vector, a turn.
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return a.cross(b);
}
template <class T>
Vector<T, 2> cross(const Eigen::Matrix<T, 1, 1>& a, const Eigen::Matrix<T, 2, 1>& b) {
  return {-a[0] * b[1], a[0] * b[0]};
}
template <class T>
Angular<T, 2> cross(const Eigen::Matrix<T, 1, 1>&, const Eigen::Matrix<T, 1, 1>&) {
  return Angular<T, 2>::Zero();
}
template <class T>
Vector3<T> arm_cross(const Vector3<T>& a, const Vector3<T>& b) {
  return a.cross(b);
}
template <class T>
Angular<T, 2> arm_cross(const Eigen::Matrix<T, 2, 1>& a, const Eigen::Matrix<T, 2, 1>& b) {
  return Angular<T, 2>(a[0] * b[1] - a[1] * b[0]);
}

// Strain times arc length: rotation vector (rad) and translation (mm), both in the arc's proximal frame.
template <class T, int D = 3>
struct BasicScrew {
  Angular<T, D> rotation = Angular<T, D>::Zero();
  Vector<T, D> translation_mm = Vector<T, D>::Zero();
};
using Screw = BasicScrew<double>;

template <class T, int D>
BasicScrew<T, D> operator+(const BasicScrew<T, D>& a, const BasicScrew<T, D>& b) {
  return {a.rotation + b.rotation, a.translation_mm + b.translation_mm};
}
template <class T, int D>
BasicScrew<T, D> operator*(double factor, const BasicScrew<T, D>& a) {
  return {a.rotation * Factor<T>(factor), a.translation_mm * Factor<T>(factor)};
}

// Lie bracket of se(D).
template <class T, int D>
BasicScrew<T, D> bracket(const BasicScrew<T, D>& a, const BasicScrew<T, D>& b) {
  return {cross(a.rotation, b.rotation), cross(a.rotation, b.translation_mm) - cross(b.rotation, a.translation_mm)};
}

// Internal force and moment in a section frame.
template <class T, int D = 3>
struct BasicWrench {
  Vector<T, D> force_N = Vector<T, D>::Zero();
  Angular<T, D> moment_Nmm = Angular<T, D>::Zero();
};
using SectionWrench = BasicWrench<double>;

template <class T, int D>
BasicWrench<T, D> operator+(const BasicWrench<T, D>& a, const BasicWrench<T, D>& b) {
  return {a.force_N + b.force_N, a.moment_Nmm + b.moment_Nmm};
}
template <class T, int D>
BasicWrench<T, D> operator*(double factor, const BasicWrench<T, D>& a) {
  return {a.force_N * Factor<T>(factor), a.moment_Nmm * Factor<T>(factor)};
}

// A = sin t / t, B = (1 - cos t) / t^2, C = (t - sin t) / t^3.
template <class T>
struct BasicCoefficients {
  T A, B, C;
};
using ScrewCoefficients = BasicCoefficients<double>;

// For an angle t below 1 rad, x = t^2: B = 1/2 - x E, C = 1/6 - x F. The first dropped term of B and C is below 1/19! =
// 8e-18.
template <class T>
struct BasicInnerCoefficients {
  T E, F;
};
template <class T>
BasicInnerCoefficients<T> inner_coefficients(const T& x) {
  // clang-format off
  return {1 / 24. - x * (1 / 720. - x * (1 / 40320. - x * (1 / 3628800. - x * (1 / 479001600.
            - x * (1 / 87178291200. - x * (1 / 20922789888000.)))))),
          1 / 120. - x * (1 / 5040. - x * (1 / 362880. - x * (1 / 39916800. - x * (1 / 6227020800.
            - x * (1 / 1307674368000. - x * (1 / 355687428096000.))))))};
  // clang-format on
}

template <class T>
BasicCoefficients<T> small_screw_coefficients(const T& x) {
  const auto [E, F] = inner_coefficients(x);
  const T C = 1 / 6. - x * F;
  return {1 - x * C, 1 / 2. - x * E, C};
}

template <class T>
BasicCoefficients<T> screw_coefficients(const T& angle_squared) {
  using std::sin;
  using std::sqrt;
  const T& x = angle_squared;
  if (x < 1) return small_screw_coefficients(x);
  const T angle = sqrt(x);
  const T a = sin(angle) / angle;
  const T half = sin(angle / 2);
  return {a, 2 * half * half / x, (1 - a) / x};
}

// exp of a screw, kept as increments to the identity so that products of many small ones do not lose digits:
// R x = x + A w x x + B w x (w x x).
template <class T, int D = 3>
struct BasicMotion {
  Angular<T, D> rotation;    // w, rad
  Vector<T, D> position_mm;  // p = (I + B [w]x + C [w]x^2) d
  T A, B;

  Vector<T, D> rotate(const Vector<T, D>& x) const {
    const Vector<T, D> wx = cross(rotation, x);
    return x + (A * wx + B * cross(rotation, wx));
  }
  Vector<T, D> rotate_back(const Vector<T, D>& x) const {
    const Vector<T, D> wx = cross(rotation, x);
    return x + (B * cross(rotation, wx) - A * wx);
  }
  // A moment; in the plane it stays as it is.
  Angular<T, D> rotate_moment(const Angular<T, D>& m) const {
    if constexpr (D == 3) return rotate(m);
    else return m;
  }
};
using RigidMotion = BasicMotion<double>;

template <class T, int D>
BasicMotion<T, D> exponential(const BasicScrew<T, D>& screw) {
  const Angular<T, D>& w = screw.rotation;
  const Vector<T, D>& d = screw.translation_mm;
  const T angle_squared = w.dot(w);
  const BasicCoefficients<T> k = screw_coefficients(angle_squared);
  const Vector<T, D> wd = cross(w, d);
  return {w, d + (k.B * wd + k.C * cross(w, wd)), k.A, k.B};
}

// A turn about the tangent.
inline RigidMotion twist(double angle_rad) {
  return exponential(Screw{{angle_rad, 0, 0}, Vector3d::Zero()});
}

// Wrench at the proximal end of a motion from the one at its distal end: n_p = R n_d, m_p = R m_d + p x n_p.
template <class T, int D>
BasicWrench<T, D> transport(const BasicMotion<T, D>& motion, const BasicWrench<T, D>& distal) {
  const Vector<T, D> force = motion.rotate(distal.force_N);
  return {force, motion.rotate_moment(distal.moment_Nmm) + arm_cross(motion.position_mm, force)};
}

// Pose of a section frame S in the base frame B; the rows of the rotation are turned one by one.
template <int D>
struct BasicPose {
  Eigen::Matrix<double, D, D> rotation_BS = Eigen::Matrix<double, D, D>::Identity();
  Vector<double, D> position_B_mm = Vector<double, D>::Zero();

  BasicPose then(const BasicMotion<double, D>& motion) const {
    BasicPose next;
    next.position_B_mm = position_B_mm + rotation_BS * motion.position_mm;
    for (int row = 0; row < D; ++row) {
      next.rotation_BS.row(row) = motion.rotate_back(rotation_BS.row(row).transpose()).transpose();
    }
    return next;
  }
};
using SectionPose = BasicPose<3>;

}  // namespace fam
