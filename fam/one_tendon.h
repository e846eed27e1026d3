// A section with one tendon: of its strain the tendon's tangent t alone is unknown (fam/tendon.h has the equations).
//
// With X = X0 + C (W - T B^T d), d = t/|t|, the tangent t = B X is where
//   t + G d = B (X0 + C W),   G = T B C B^T,
// D equations with the derivative 1 + G (1 - d d^T) / |t|, and each coefficient of t's series along an arc a linear
// equation with that matrix. The energy is convex, so that there is one such t.
#pragma once

#include "fam/arc_section.h"

#include <Eigen/LU>

namespace fam {

// The arc laws' `Section`, as TendonSection, which is asked where Newton's method alone does not find the strain.
template <bool with_shear, class T, int D>
class OneTendonSection {
 public:
  static constexpr bool gives_way = with_shear;

  explicit OneTendonSection(const BasicArcConstants<D>& arc) : arc_(arc) {
    for (int axis = 0; axis < D; ++axis) {
      const Vector<double, D> pull_N = tendon().tension_N * Vector<double, D>::Unit(axis);
      const Angular<double, D> turn = arc_.angular_compliance.cwiseProduct(arm_cross(tendon().arm_mm, pull_N));
      give_.col(axis) = cross(turn, tendon().arm_mm);
      if constexpr (with_shear) give_(axis, axis) += arc_.linear_compliance[axis] * pull_N[axis];
    }
  }

  bool collapsed() const { return collapsed_; }

  [[gnu::noinline]] BasicScrew<T, D> strain(const BasicWrench<T, D>& wrench) {
    BasicScrew<T, D> loose = give(wrench.moment_Nmm, wrench.force_N);
    loose.rotation += arc_.rest_rotation.template cast<T>();
    loose.translation_mm += arc_.rest_translation_mm.template cast<T>();
    const Vector<T, D> loose_t = tangent(loose);
    Vector<double, D> found;
    for (int i = 0; i < D; ++i) found[i] = value_of(loose_t[i]);
    Square<double> inverse;
    if (!solve(found, inverse)) return robust_strain(wrench);
    Vector<T, D> t = found.template cast<T>();
    if constexpr (!std::is_same_v<T, double>) {  // one more step in T, whose derivatives are those of the solution
      const Vector<T, D> miss = t + product<T>(give_, direction_of(t)) - loose_t;
      t -= product<T>(inverse, miss);
    }
    return less_pull(loose, direction_of(t));
  }

  void begin_series(const BasicScrew<T, D>& first) {
    t_[0] = tangent(first);
    using std::sqrt;
    length_[0] = sqrt(t_[0].dot(t_[0]));
    inverse_length_ = T(1) / length_[0];
    direction_[0] = t_[0] * inverse_length_;
    inverse_ = derivative<T>(direction_[0], inverse_length_).inverse();
  }

  void next(std::size_t k, const Angular<T, D>& moment_Nmm, const Vector<T, D>& force_N, Angular<T, D>& rotation,
            Vector<T, D>& translation_mm) {
    // What coefficient k of |t| and d has without that of t.
    T length(0);
    Vector<T, D> known = Vector<T, D>::Zero();
    for (std::size_t j = 1; j < k; ++j) {
      length += t_[j].dot(t_[k - j]) - length_[j] * length_[k - j];
      known -= direction_[k - j] * length_[j];
    }
    length *= T(0.5) * inverse_length_;
    known = (known - direction_[0] * length) * inverse_length_;

    const BasicScrew<T, D> loose = give(moment_Nmm, force_N);
    t_[k] = inverse_ * (tangent(loose) - product<T>(give_, known));
    const T along = direction_[0].dot(t_[k]);
    length_[k] = length + along;
    direction_[k] = known + (t_[k] - direction_[0] * along) * inverse_length_;
    const BasicScrew<T, D> strain = less_pull(loose, direction_[k]);
    rotation = strain.rotation;
    if constexpr (with_shear) translation_mm = strain.translation_mm;
  }

 private:
  static constexpr std::size_t terms = 8;
  static constexpr int most_steps = 8;  // of Newton's method, two to four suffice where the tendon is nearly straight
  static constexpr double largest_step = 0.5, least_length = 0.1;  // over |t|, and over h; chosen, not measured
  template <class Number>
  using Square = Eigen::Matrix<Number, D, D>;

  const BasicTendon<D>& tendon() const { return arc_.tendons.front(); }
  BasicScrew<T, D> robust_strain(const BasicWrench<T, D>& wrench) {
    TendonSection<with_shear, T, D> section(arc_);
    const BasicScrew<T, D> strain = section.strain(wrench);
    collapsed_ = collapsed_ || section.collapsed();
    return strain;
  }
  template <class Number>
  static Vector<Number, D> product(const Square<double>& a, const Vector<Number, D>& x) {
    return a.template cast<Number>() * x;
  }
  // C W; without shear that of the turn alone.
  BasicScrew<T, D> give(const Angular<T, D>& moment_Nmm, const Vector<T, D>& force_N) const {
    BasicScrew<T, D> result{arc_.angular_compliance.template cast<T>().cwiseProduct(moment_Nmm), Vector<T, D>::Zero()};
    if constexpr (with_shear) result.translation_mm = arc_.linear_compliance.template cast<T>().cwiseProduct(force_N);
    return result;
  }
  Vector<T, D> tangent(const BasicScrew<T, D>& strain) const {
    return strain.translation_mm + cross(strain.rotation, Vector<T, D>(tendon().arm_mm.template cast<T>()));
  }
  static Vector<T, D> direction_of(const Vector<T, D>& t) {
    using std::sqrt;
    return t * (T(1) / sqrt(t.dot(t)));
  }
  // The strain less C T B^T d.
  BasicScrew<T, D> less_pull(const BasicScrew<T, D>& strain, const Vector<T, D>& d) const {
    const Vector<T, D> force_N = d * T(tendon().tension_N);
    const BasicScrew<T, D> by = give(arm_cross(Vector<T, D>(tendon().arm_mm.template cast<T>()), force_N), force_N);
    return {strain.rotation - by.rotation, strain.translation_mm - by.translation_mm};
  }
  // 1 + G (1 - d d^T) / |t|.
  template <class Number>
  Square<Number> derivative(const Vector<Number, D>& d, const Number& inverse_length) const {
    const Vector<Number, D> along = product<Number>(give_, d) * inverse_length;
    Square<Number> result;
    for (int row = 0; row < D; ++row) {
      for (int column = 0; column < D; ++column) {
        result(row, column) = Number(give_(row, column)) * inverse_length - along[row] * d[column];
      }
      result(row, row) += Number(1);
    }
    return result;
  }

  // From B (X0 + C W) to t, and the inverse of the derivative of one step before. Newton's method from the straight
  // tendon's; false where it does not converge at once.
  bool solve(Vector<double, D>& t, Square<double>& inverse) const {
    const Vector<double, D> loose = t;
    t -= give_.col(0);
    double last = 1;
    for (int step = 0; step < most_steps; ++step) {
      const double length = t.norm();
      if (!(length > least_length * arc_.rest_translation_mm[0])) return false;
      const Vector<double, D> d = t / length;
      inverse = derivative<double>(d, 1 / length).inverse();
      const Vector<double, D> newton = inverse * (t + give_ * d - loose);
      t -= newton;
      const double size = newton.norm() / length;
      if (!(size < largest_step)) return false;
      if (size * std::min(1.0, size / last) <= 1e-16) return true;
      last = size;
    }
    return false;
  }

  const BasicArcConstants<D>& arc_;
  Square<double> give_;  // G
  Square<T> inverse_;    // of the derivative where the series begins
  std::array<Vector<T, D>, terms> t_, direction_;
  std::array<T, terms> length_;
  T inverse_length_;  // of the first t
  bool collapsed_ = false;
};

}  // namespace fam
