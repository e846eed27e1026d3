// A section in space, of rods in lanes, with tendons (fam/tendon.h has the equations). Here their pulls are counted
// from those of tendons along the tangent, which `rest_rotation` holds. To be asked for a strain before its series.
#pragma once

#include "fam/elimination.h"
#include "fam/lane_section.h"

namespace fam {

template <class P, bool with_shear>
class LaneTendonSection : public LaneSection<P, with_shear, 3> {
  using Base = LaneSection<P, with_shear, 3>;

 public:
  LaneTendonSection(const LaneSpan& span, const P* numbers, double part) : Base(span, numbers, part) {
    count_ = span.tendons;
    for (int i = 0; i < count_; ++i) {
      tendons_[i].y_mm = P(span.tendon_y_mm[i]);
      tendons_[i].z_mm = P(span.tendon_z_mm[i]);
      tendons_[i].tension_N = numbers[lane_number::tension + i];
    }
    compliance_.template head<3>() = this->angular_compliance_;
    if constexpr (with_shear) compliance_.template tail<3>() = this->linear_compliance_;
  }

  // Newton's method from where the last arc's series end, or from tendons along the tangent. Each lane ends by itself,
  // whatever the others do.
  BasicScrew<P, 3> strain(const BasicWrench<P, 3>& wrench) {
    const BasicScrew<P, 3> straight = straight_strain(wrench);
    const Strain loose = vector(straight.rotation, straight.translation_mm);
    Strain x = has_ahead_ ? ahead_ : loose;
    P last(1);  // squared, as the sizes
    auto active = P(0) <= P(0);
    found_ = active;
    for (int step = 0; step < most_steps && P::any(active); ++step) {
      Strain newton = x - loose + compliance_.cwiseProduct(set_first(screw(x, straight.translation_mm)));
      substitute(factors_, newton);
      P size(0);
      for (int i = 0; i < count_; ++i) {
        const Vector<P, 3> change = tangent(tendons_[i], screw(newton, Vector<P, 3>(Vector<P, 3>::Zero())));
        size = larger(size, change.dot(change) * (tendons_[i].inverse_length * tendons_[i].inverse_length));
      }
      for (int k = 0; k < unknowns; ++k) x[k] = select(active, x[k] - newton[k], x[k]);
      const auto ends = active & (size * smaller(last, size) <= P(1e-32) * last);
      const auto goes_on = active & ~ends & (size < P(largest_step * largest_step));
      found_ &= ~active | ends | goes_on;
      active = goes_on;
      last = size;
    }
    found_ &= ~active;
    return screw(x, straight.translation_mm);
  }

  void begin_series(const BasicScrew<P, 3>& first) {
    ahead_ = vector(first.rotation, first.translation_mm);
    has_ahead_ = true;
    set_first(first);
  }
  void next(std::size_t k, const Vector<P, 3>& moment_Nmm, const Vector<P, 3>& force_N, Vector<P, 3>& rotation,
            Vector<P, 3>& translation_mm) {
    Strain x = vector(moment_Nmm, force_N);
    for (int i = 0; i < count_; ++i) {
      set_known_parts(tendons_[i], k);
      const Tendon& tendon = tendons_[i];
      x -= tendon.tension_N * pull(tendon, tendon.direction[k]);
    }
    x = compliance_.cwiseProduct(x).eval();
    substitute(factors_, x);
    ahead_ += x;
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
  using Square = Eigen::Matrix<P, unknowns, unknowns>;
  struct Tendon {  // and the series of t h, |t| h and t/|t|
    P y_mm, z_mm, tension_N, inverse_length;
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
    const Vector<P, 3>& turn = strain.rotation;
    return strain.translation_mm +
           Vector<P, 3>(turn[1] * tendon.z_mm - turn[2] * tendon.y_mm, -(turn[0] * tendon.z_mm), turn[0] * tendon.y_mm);
  }
  BasicScrew<P, 3> straight_strain(const BasicWrench<P, 3>& wrench) const {
    BasicScrew<P, 3> strain = Base::strain(wrench);
    if constexpr (with_shear) {
      for (int i = 0; i < count_; ++i) strain.translation_mm[0] -= this->linear_compliance_[0] * tendons_[i].tension_N;
    }
    return strain;
  }

  static Vector<P, 3> moment(const Tendon& tendon, const Vector<P, 3>& d) {
    return {tendon.y_mm * d[2] - tendon.z_mm * d[1], tendon.z_mm * d[0], -(tendon.y_mm * d[0])};
  }
  static Strain pull(const Tendon& tendon, const Vector<P, 3>& d) { return vector(moment(tendon, d), d); }

  // The first coefficients and the factors of 1 + C S; returns what the tendons pull otherwise than along the tangent.
  Strain set_first(const BasicScrew<P, 3>& strain) {
    Strain pulls = Strain::Zero();
    Square S = Square::Zero();  // its upper half
    for (int i = 0; i < count_; ++i) {
      Tendon& tendon = tendons_[i];
      tendon.t[0] = tangent(tendon, strain);
      tendon.length[0] = sqrt(tendon.t[0].dot(tendon.t[0]));
      tendon.inverse_length = P(1) / tendon.length[0];
      tendon.direction[0] = tendon.t[0] * tendon.inverse_length;
      Vector<P, 3> across = tendon.direction[0];
      across[0] -= P(1);
      pulls += tendon.tension_N * pull(tendon, across);
      add_stiffness(tendon, S);
    }
    for (int i = 0; i < unknowns; ++i) {
      for (int j = 0; j < unknowns; ++j) factors_(i, j) = compliance_[i] * (i < j ? S(i, j) : S(j, i));
      factors_(i, i) += P(1);
    }
    factorise(factors_);
    return pulls;
  }
  static void add_stiffness(const Tendon& tendon, Square& S) {
    const Vector<P, 3>& d = tendon.direction[0];
    const Vector<P, 3> c = moment(tendon, d);
    const P &y = tendon.y_mm, &z = tendon.z_mm, pulled = tendon.tension_N * tendon.inverse_length;
    S(0, 0) += pulled * (y * y + z * z - c[0] * c[0]);
    S(0, 1) -= pulled * (c[0] * c[1]);
    S(0, 2) -= pulled * (c[0] * c[2]);
    S(1, 1) += pulled * (z * z - c[1] * c[1]);
    S(1, 2) -= pulled * (y * z + c[1] * c[2]);
    S(2, 2) += pulled * (y * y - c[2] * c[2]);
    if constexpr (with_shear) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) S(i, j + 3) -= pulled * (c[i] * d[j]);
        for (int j = i; j < 3; ++j) S(i + 3, j + 3) -= pulled * (d[i] * d[j]);
        S(i + 3, i + 3) += pulled;
      }
      S(0, 4) -= pulled * z;
      S(0, 5) += pulled * y;
      S(1, 3) += pulled * z;
      S(2, 3) -= pulled * y;
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

  Strain compliance_, ahead_;  // ahead: the series' sum, where the next arc begins
  bool has_ahead_ = false;
  Square factors_;
  int count_ = 0;
  Tendon tendons_[most_lane_tendons];  // touched only as far as there are tendons
  typename P::Mask found_;
};

}  // namespace fam
