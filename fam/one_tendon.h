// A section with one tendon: of its strain the tendon's tangent t alone is unknown (fam/tendon.h has the equations).
//
// With X = X0 + C (W - T B^T d), d = t/|t|, the tangent t = B X is where
//   t + G d = B (X0 + C W),   G = T B C B^T,
// D equations with the derivative 1 + G (1 - d d^T) / |t|, and each coefficient of t's series along an arc a linear
// equation with that matrix. The energy is convex, so that there is one such t.
#pragma once

#include "fam/arc_section.h"
#include "fam/wide.h"

#include <Eigen/LU>

namespace fam {

// Columns of the inverse of the matrix with these rows.
template <class T, int D, std::size_t count>
std::array<Eigen::Matrix<T, D, 1>, count> inverse_of_rows(const std::array<Eigen::Matrix<T, D, 1>, count>& rows) {
  Eigen::Matrix<T, D, D> matrix;
  for (int i = 0; i < D; ++i) matrix.row(i) = rows[static_cast<std::size_t>(i)].transpose();
  const Eigen::Matrix<T, D, D> inverse = matrix.inverse();
  std::array<Eigen::Matrix<T, D, 1>, count> columns;
  for (int i = 0; i < D; ++i) columns[static_cast<std::size_t>(i)] = inverse.col(i);
  return columns;
}

// A vector of the same numbers, as V.
template <class V, class From>
V numbers(const From& vector) {
  if constexpr (std::is_same_v<V, From>) return vector;
  else return as<typename V::Scalar>(vector);
}
// Of a matrix with these columns.
template <class V, class Column, std::size_t count>
V product(const std::array<Column, count>& a, const V& x) {
  V sum = numbers<V>(a[0]) * x[0];
  for (std::size_t i = 1; i < count; ++i) sum += numbers<V>(a[i]) * x[static_cast<int>(i)];
  return sum;
}

// A strain by TendonSection's search for the least energy.
template <bool with_shear, class T, int D>
BasicScrew<T, D> robust_strain(const BasicArcConstants<D>& arc, const BasicWrench<T, D>& wrench, bool& collapsed) {
  if constexpr (std::is_same_v<T, Wide>) {
    return wide(robust_strain<with_shear>(arc, narrow(wrench), collapsed));
  } else {
    TendonSection<with_shear, T, D> section(arc);
    const BasicScrew<T, D> strain = section.strain(wrench);
    collapsed = collapsed || section.collapsed();
    return strain;
  }
}

// The arc laws' `Section`, as TendonSection, which is asked where Newton's method alone does not find the strain.
template <bool with_shear, class T, int D>
class OneTendonSection {
 public:
  static constexpr bool gives_way = with_shear;

  explicit OneTendonSection(const BasicArcConstants<D>& arc) : arc_(arc) {
    const Vector<Value, D> arm = as<Value>(tendon().arm_mm);
    for (int axis = 0; axis < D; ++axis) {
      const Vector<Value, D> pull_N = unit(axis) * Value(tendon().tension_N);
      const BasicScrew<Value, D> by = give<Value>(arm_cross(arm, pull_N), pull_N);
      give_[static_cast<std::size_t>(axis)] = by.translation_mm + cross(by.rotation, arm);
    }
  }

  bool collapsed() const { return collapsed_; }

  BasicScrew<T, D> strain(const BasicWrench<T, D>& wrench) {
    BasicScrew<T, D> loose = give<T>(wrench.moment_Nmm, wrench.force_N);
    loose.rotation += as<T>(arc_.rest_rotation);
    loose.translation_mm += as<T>(arc_.rest_translation_mm);
    const Vector<T, D> loose_t = tangent(loose);
    Square<Value> inverse;
    if constexpr (has_slopes) {  // one more step in T, whose derivatives are those of the solution
      Vector<double, D> found;
      for (int i = 0; i < D; ++i) found[i] = value_of(loose_t[i]);
      if (!solve(found, inverse)) return robust_strain<with_shear>(arc_, wrench, collapsed_);
      Vector<T, D> t = as<T>(found);
      const Vector<T, D> miss = t + product(give_, direction_of(t)) - loose_t;
      t -= product(inverse, miss);
      return less_pull(loose, direction_of(t));
    } else {
      Vector<T, D> t = loose_t;
      if (!solve(t, inverse)) return robust_strain<with_shear>(arc_, wrench, collapsed_);
      return less_pull(loose, direction_of(t));
    }
  }

  void begin_series(const BasicScrew<T, D>& first) {
    t_[0] = tangent(first);
    using std::sqrt;
    length_[0] = sqrt(t_[0].dot(t_[0]));
    inverse_length_ = T(1) / length_[0];
    direction_[0] = t_[0] * inverse_length_;
    inverse_ = inverse_derivative<T>(direction_[0], inverse_length_);
  }

  void next(std::size_t k, const Angular<T, D>& moment_Nmm, const Vector<T, D>& force_N, Angular<T, D>& rotation,
            Vector<T, D>& translation_mm) {
    // What coefficient k of |t| and d has without that of t.
    T length(0);
    Vector<T, D> known = Vector<T, D>::Zero();
    for (std::size_t j = 1; j < k; ++j) {
      length = length + (t_[j].dot(t_[k - j]) - length_[j] * length_[k - j]);
      known -= direction_[k - j] * length_[j];
    }
    length = T(0.5) * inverse_length_ * length;
    known = (known - direction_[0] * length) * inverse_length_;

    const BasicScrew<T, D> loose = give<T>(moment_Nmm, force_N);
    t_[k] = product(inverse_, Vector<T, D>(tangent(loose) - product(give_, known)));
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
  static constexpr bool has_slopes = !std::is_convertible_v<T, double>;
  using Value = std::conditional_t<has_slopes, double, T>;
  template <class Number>
  using Square = std::array<Vector<Number, D>, D>;  // by columns

  const BasicTendon<D>& tendon() const { return arc_.tendons.front(); }
  static Vector<Value, D> unit(int axis) { return as<Value>(Vector<double, D>(Vector<double, D>::Unit(axis))); }
  // C W; without shear that of the turn alone.
  template <class Number>
  BasicScrew<Number, D> give(const Angular<Number, D>& moment_Nmm, const Vector<Number, D>& force_N) const {
    BasicScrew<Number, D> result{as<Number>(arc_.angular_compliance).cwiseProduct(moment_Nmm),
                                 Vector<Number, D>::Zero()};
    if constexpr (with_shear) result.translation_mm = as<Number>(arc_.linear_compliance).cwiseProduct(force_N);
    return result;
  }
  Vector<T, D> tangent(const BasicScrew<T, D>& strain) const {
    return strain.translation_mm + cross(strain.rotation, as<T>(tendon().arm_mm));
  }
  static Vector<T, D> direction_of(const Vector<T, D>& t) {
    using std::sqrt;
    return t * (T(1) / sqrt(t.dot(t)));
  }
  // The strain less C T B^T d.
  BasicScrew<T, D> less_pull(const BasicScrew<T, D>& strain, const Vector<T, D>& d) const {
    const Vector<T, D> force_N = d * T(tendon().tension_N);
    const BasicScrew<T, D> by = give<T>(arm_cross(as<T>(tendon().arm_mm), force_N), force_N);
    return {strain.rotation - by.rotation, strain.translation_mm - by.translation_mm};
  }
  // Of 1 + G (1 - d d^T) / |t|; G is symmetric.
  template <class Number>
  Square<Number> inverse_derivative(const Vector<Number, D>& d, const Number& inverse_length) const {
    const Vector<Number, D> along = product(give_, d) * inverse_length;
    Square<Number> rows;
    for (int i = 0; i < D; ++i) {
      const auto row = static_cast<std::size_t>(i);
      rows[row] = as<Number>(Vector<double, D>(Vector<double, D>::Unit(i))) +
                  numbers<Vector<Number, D>>(give_[row]) * inverse_length - d * Number(along[i]);
    }
    return inverse_of_rows(rows);
  }

  // From B (X0 + C W) to t, and the inverse of the derivative of one step before. Newton's method from the straight
  // tendon's; false where it does not converge at once.
  bool solve(Vector<Value, D>& t, Square<Value>& inverse) const {
    const Vector<Value, D> loose = t;
    t -= give_[0];
    double last = 1;
    for (int step = 0; step < most_steps; ++step) {
      const double length = t.norm();
      if (!(length > least_length * arc_.rest_translation_mm[0])) return false;
      const Vector<Value, D> d = t * (1 / length);
      inverse = inverse_derivative<Value>(d, 1 / length);
      const Vector<Value, D> newton = product(inverse, Vector<Value, D>(t + product(give_, d) - loose));
      t -= newton;
      const double size = newton.norm() / length;
      if (!(size < largest_step)) return false;
      if (size * std::min(1.0, size / last) <= 1e-16) return true;
      last = size;
    }
    return false;
  }

  const BasicArcConstants<D>& arc_;
  Square<Value> give_;  // G
  Square<T> inverse_;   // of the derivative where the series begins
  std::array<Vector<T, D>, terms> t_, direction_;
  std::array<T, terms> length_;
  T inverse_length_;  // of the first t
  bool collapsed_ = false;
};

}  // namespace fam
