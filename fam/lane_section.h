// A section of rods in lanes, and what a kernel reads from numbers by lane (P: a Pack).
#pragma once

#include "fam/arc_series.h"
#include "fam/elimination.h"
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

// The same in space with tendons (fam/tendon.h has the equations; here the pulls are counted from those of tendons along
// the tangent, which `rest_rotation` holds). To be asked for a strain before its series.
template <class P, bool with_shear>
class LaneTendonSection : public LaneSection<P, with_shear, 3> {
  using Base = LaneSection<P, with_shear, 3>;

 public:
  LaneTendonSection(const LaneSpan& span, const P* numbers, double part) : Base(span, numbers, part) {
    count_ = span.tendons;
    for (int i = 0; i < count_; ++i) {
      tendons_[i].arm_mm = {P(0), P(span.tendon_y_mm[i]), P(span.tendon_z_mm[i])};
      tendons_[i].tension_N = numbers[lane_number::tension + i];
    }
    compliance_.template head<3>() = this->angular_compliance_;
    if constexpr (with_shear) compliance_.template tail<3>() = this->linear_compliance_;
  }

  // Newton's method from tendons along the tangent. Each lane ends by itself, whatever the others do.
  BasicScrew<P, 3> strain(const BasicWrench<P, 3>& wrench) {
    const BasicScrew<P, 3> straight = straight_strain(wrench);
    const Strain loose = vector(straight.rotation, straight.translation_mm);
    Strain x = loose;
    P last(1);
    auto active = P(0) <= P(0);
    found_ = active;
    for (int step = 0; step < most_steps && P::any(active); ++step) {
      Strain newton = x - loose;
      factors_.setIdentity();
      const BasicScrew<P, 3> now = screw(x, straight.translation_mm);
      for (int i = 0; i < count_; ++i) set_first(tendons_[i], now, newton);
      factorise(factors_);
      substitute(factors_, newton);
      P size(0);
      for (int i = 0; i < count_; ++i) {
        const Vector<P, 3> change = tangent(tendons_[i], screw(newton, Vector<P, 3>(Vector<P, 3>::Zero())));
        size = larger(size, sqrt(change.dot(change)) * tendons_[i].inverse_length);
      }
      for (int k = 0; k < unknowns; ++k) x[k] = select(active, x[k] - newton[k], x[k]);
      const auto ends = active & (size * smaller(P(1), size / last) <= P(1e-16));
      const auto goes_on = active & ~ends & (size < P(largest_step));
      found_ &= ~active | ends | goes_on;
      active = goes_on;
      last = size;
    }
    found_ &= ~active;
    return screw(x, straight.translation_mm);
  }

  void begin_series(const BasicScrew<P, 3>& first) {
    Strain unused = Strain::Zero();
    factors_.setIdentity();
    for (int i = 0; i < count_; ++i) set_first(tendons_[i], first, unused);
    factorise(factors_);
  }
  void next(std::size_t k, const Vector<P, 3>& moment_Nmm, const Vector<P, 3>& force_N, Vector<P, 3>& rotation,
            Vector<P, 3>& translation_mm) {
    Strain x = vector(moment_Nmm, force_N);
    for (int i = 0; i < count_; ++i) {
      set_known_parts(tendons_[i], k);
      const Tendon& tendon = tendons_[i];
      x -= tendon.tension_N * vector(arm_cross(tendon.arm_mm, tendon.direction[k]), tendon.direction[k]);
    }
    x = compliance_.cwiseProduct(x).eval();
    substitute(factors_, x);
    const BasicScrew<P, 3> result = screw(x, Vector<P, 3>(Vector<P, 3>::Zero()));
    for (int i = 0; i < count_; ++i) {
      Tendon& tendon = tendons_[i];
      tendon.t[k] = tangent(tendon, result);
      const P along = tendon.direction[0].dot(tendon.t[k]);
      tendon.length[k] += along;
      tendon.direction[k] += (tendon.t[k] - tendon.direction[0] * along) * tendon.inverse_length;
    }
    rotation = result.rotation;
    if constexpr (with_shear) translation_mm = result.translation_mm;
  }

  // Not positive where a tendon's tangent strays from the rod's by more than a third of that, or was not found: nearer
  // ones have a length, and turn from one arc to the next by less than unseen_turn_rad (fam/shape.h) asks for.
  P tendon_stretch(const BasicScrew<P, 3>& strain, const LaneSpan&) const {
    P farthest(0);
    for (int i = 0; i < count_; ++i) {
      Vector<P, 3> stray = tangent(tendons_[i], strain);
      stray[0] -= this->length_mm_;
      farthest = larger(farthest, stray.dot(stray));
    }
    const P left = this->length_mm_ * this->length_mm_ * P(1. / 9) - farthest;
    return select(found_, left, P(0));
  }

 private:
  static constexpr int unknowns = with_shear ? 6 : 3;
  static constexpr std::size_t terms = 7;
  static constexpr int most_steps = 8;           // as OneTendonSection
  static constexpr double largest_step = 0.5;    // the same
  using Strain = Eigen::Matrix<P, unknowns, 1>;  // u h, then v h where it gives way
  struct Tendon {                                // and the series of t h, |t| h and t/|t|
    Vector<P, 3> arm_mm;
    P tension_N, inverse_length;
    Vector<P, 3> t[terms], direction[terms];
    P length[terms];
  };

  static Strain vector(const Vector<P, 3>& turn, const Vector<P, 3>& translation) {
    Strain x;
    x.template head<3>() = turn;
    if constexpr (with_shear) x.template tail<3>() = translation;
    return x;
  }
  static BasicScrew<P, 3> screw(const Strain& x, const Vector<P, 3>& rigid) {
    if constexpr (with_shear) return {x.template head<3>(), x.template tail<3>()};
    else return {x, rigid};
  }
  static Vector<P, 3> tangent(const Tendon& tendon, const BasicScrew<P, 3>& strain) {
    return strain.translation_mm + cross(strain.rotation, tendon.arm_mm);
  }
  BasicScrew<P, 3> straight_strain(const BasicWrench<P, 3>& wrench) const {
    BasicScrew<P, 3> strain = Base::strain(wrench);
    if constexpr (with_shear) {
      for (int i = 0; i < count_; ++i)
        strain.translation_mm[0] -= this->linear_compliance_[0] * tendons_[i].tension_N;
    }
    return strain;
  }

  // The first coefficients; adds what the tendon pulls otherwise than along the tangent to the residual, and its part of
  // C S to the factors.
  void set_first(Tendon& tendon, const BasicScrew<P, 3>& strain, Strain& residual) {
    tendon.t[0] = tangent(tendon, strain);
    tendon.length[0] = sqrt(tendon.t[0].dot(tendon.t[0]));
    tendon.inverse_length = P(1) / tendon.length[0];
    tendon.direction[0] = tendon.t[0] * tendon.inverse_length;
    Vector<P, 3> across = tendon.direction[0];
    across[0] -= P(1);
    residual += compliance_.cwiseProduct(tendon.tension_N * vector(arm_cross(tendon.arm_mm, across), across));
    const Vector<P, 3>&r = tendon.arm_mm, &d = tendon.direction[0], c = arm_cross(r, d);
    const P pull = tendon.tension_N * tendon.inverse_length, r_squared = r.dot(r);
    const Vector<P, 3> skew[3] = {{P(0), -r[2], r[1]}, {r[2], P(0), -r[0]}, {-r[1], r[0], P(0)}};  // [r] by rows
    for (int i = 0; i < 3; ++i) {
      const P by_turn = pull * compliance_[i];
      for (int j = 0; j < 3; ++j) {
        factors_(i, j) += by_turn * ((i == j ? r_squared : P(0)) - r[i] * r[j] - c[i] * c[j]);
        if constexpr (with_shear) factors_(i, j + 3) += by_turn * (skew[i][j] - c[i] * d[j]);
      }
      if constexpr (!with_shear) continue;
      else {
        const P by_way = pull * compliance_[i + 3];
        for (int j = 0; j < 3; ++j) {
          factors_(i + 3, j) -= by_way * (skew[i][j] + d[i] * c[j]);
          factors_(i + 3, j + 3) += by_way * ((i == j ? P(1) : P(0)) - d[i] * d[j]);
        }
      }
    }
  }
  // What coefficient k of |t| and d has without that of t.
  static void set_known_parts(Tendon& s, std::size_t k) {
    P length(0);
    Vector<P, 3> direction = Vector<P, 3>::Zero();
    for (std::size_t j = 1; j < k; ++j) {
      length += s.t[j].dot(s.t[k - j]) - s.length[j] * s.length[k - j];
      direction -= s.direction[k - j] * s.length[j];
    }
    s.length[k] = P(0.5) * s.inverse_length * length;
    s.direction[k] = (direction - s.direction[0] * s.length[k]) * s.inverse_length;
  }

  Strain compliance_;
  Eigen::Matrix<P, unknowns, unknowns> factors_;
  int count_ = 0;
  Tendon tendons_[most_lane_tendons];  // touched only as far as there are tendons
  typename P::Mask found_;
};

}  // namespace fam
