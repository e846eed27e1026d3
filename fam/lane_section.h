// A section of rods in lanes, and what a kernel reads from numbers by lane (P: a Pack).
#pragma once

#include "fam/arc_series.h"
#include "fam/lane_rods.h"
#include "fam/pack.h"
#include "fam/tendon.h"

namespace fam {

template <int D, class P>
Vector<P, D> vector_at(const P* numbers) {
  if constexpr (D == 3) return {numbers[0], numbers[1], numbers[2]};
  else return {numbers[0], numbers[1]};
}
template <int D, class P>
Angular<P, D> turn_at(const P* numbers) {
  if constexpr (D == 3) return {numbers[0], numbers[1], numbers[2]};
  else return Angular<P, 2>(numbers[2]);
}
template <int D, class P>
Eigen::Matrix<P, D, D> matrix_at(const P* numbers) {
  Eigen::Matrix<P, D, D> matrix;
  for (int row = 0; row < D; ++row) {
    for (int column = 0; column < D; ++column) matrix(row, column) = numbers[3 * row + column];
  }
  return matrix;
}
template <class P>
void load_three(const double* numbers, P (&packs)[3], double times) {
  for (int i = 0; i < 3; ++i) packs[i] = P(times * numbers[i]);
}
// From the largest of its components, so that none cancels; w >= 0.
template <class P>
Eigen::Matrix<P, 4, 1> quaternion_wxyz(const Eigen::Matrix<P, 3, 3>& m) {
  const P traces[4] = {m(0, 0) + m(1, 1) + m(2, 2), m(0, 0) - m(1, 1) - m(2, 2), m(1, 1) - m(0, 0) - m(2, 2),
                       m(2, 2) - m(0, 0) - m(1, 1)};
  const P less[3] = {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
  const P more[3] = {m(2, 1) + m(1, 2), m(0, 2) + m(2, 0), m(1, 0) + m(0, 1)};
  Eigen::Matrix<P, 4, 1> q(P(1) + traces[0], less[0], less[1], less[2]);
  P largest = traces[0];
  const auto prefer = [&](int k, const Eigen::Matrix<P, 4, 1>& other) {
    const auto better = largest < traces[k];
    for (int i = 0; i < 4; ++i) q[i] = select(better, other[i], q[i]);
    largest = larger(largest, traces[k]);
  };
  prefer(1, {less[0], P(1) + traces[1], more[2], more[1]});
  prefer(2, {less[1], more[2], P(1) + traces[2], more[0]});
  prefer(3, {less[2], more[1], more[0], P(1) + traces[3]});
  const P length = sqrt(q.dot(q));
  return q * (select(q[0] < P(0), P(-1), P(1)) / length);
}
template <class P>
P norm(const P* v) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// A section of arcs `part` as long as the span's.
template <class P, bool with_shear, int D>
class LaneSection {
 public:
  static constexpr bool gives_way = with_shear;
  LaneSection(const LaneSpan& span, const P* numbers, double part) {
    P compliance[3];
    load_three(span.angular_compliance, compliance, part);
    angular_compliance_ = turn_at<D>(compliance);
    rest_rotation_ = P(part) * turn_at<D>(numbers + lane_number::rest_rotation);
    load_three(span.linear_compliance, compliance, part);
    linear_compliance_ = vector_at<D>(compliance);
    length_mm_ = P(part * span.arc_length_mm);
  }
  BasicScrew<P, D> strain(const BasicWrench<P, D>& wrench) const {
    BasicScrew<P, D> screw{rest_rotation_ + angular_compliance_.cwiseProduct(wrench.moment_Nmm), Vector<P, D>::Zero()};
    if constexpr (with_shear) screw.translation_mm = linear_compliance_.cwiseProduct(wrench.force_N);
    screw.translation_mm[0] += length_mm_;
    return screw;
  }
  void begin_series(const BasicScrew<P, D>&) const {}
  void next(std::size_t, const Angular<P, D>& moment_Nmm, const Vector<P, D>& force_N, Angular<P, D>& rotation,
            Vector<P, D>& translation_mm) const {
    rotation = angular_compliance_.cwiseProduct(moment_Nmm);
    if constexpr (with_shear) translation_mm = linear_compliance_.cwiseProduct(force_N);
  }
  // The square of how far an arc of this screw swings (largest_swing_rad, in products with h).
  P swing_squared(const BasicScrew<P, D>& screw) const {
    P turned = screw.rotation.dot(screw.rotation);
    if constexpr (D == 3) {
      const Angular<P, 3>& a = angular_compliance_;
      const Angular<P, 3> elastic = screw.rotation - rest_rotation_;
      const P product = a[0] * a[1] * a[2], sum = a[0] + a[1] + a[2];
      P rate = turned;
      for (int i = 0; i < 3; ++i) {
        const P inverse = P(1) / a[i];
        rate += elastic[i] * inverse * (product * inverse * inverse * elastic[i] - (sum - a[i]) * screw.rotation[i]);
      }
      turned = larger(turned, larger(rate, -rate));
    }
    return turned;
  }
  // Of the shortest of straight tendons, over smallest_tendon_stretch: 0 where it has collapsed.
  P tendon_stretch(const BasicScrew<P, D>& screw, const LaneSpan& span) const {
    if (D == 3) return P(1);  // without tendons
    const P turn = screw.rotation[0];
    return length_mm_ * P(1 - smallest_tendon_stretch) -
           larger(turn * P(span.tendon_arms_mm[0]), turn * P(span.tendon_arms_mm[1]));
  }

 protected:
  Angular<P, D> angular_compliance_, rest_rotation_;
  Vector<P, D> linear_compliance_;
  P length_mm_;
};

}  // namespace fam
