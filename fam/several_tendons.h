// A section in space with several tendons: of its strain X = (u, v) h all is unknown (fam/tendon.h has the equations).
//
// Newton's method and each coefficient of the strain's series along an arc are linear equations with 1 + C S, solved in
// blocks of turns and ways. With t = v + u x r, d = t/|t| and c = r x d
//   S = sum T/|t| [ |r|^2 - r r^T - c c^T   [r] - c d^T ]
//                 [ -[r] - d c^T            1 - d d^T   ],
// of which a rod without shear has the first block alone.
#pragma once

#include "fam/one_tendon.h"

#include <algorithm>
#include <array>

namespace fam {

// The arc laws' `Section`, as TendonSection, which is asked where Newton's method alone does not find the strain.
template <bool with_shear, class T>
class SeveralTendonsSection {
 public:
  static constexpr bool gives_way = with_shear;
  using Vector = fam::Vector<T, 3>;
  using Strain = BasicScrew<T, 3>;

  explicit SeveralTendonsSection(const ArcConstants& arc)
      : arc_(arc), turn_give_(as<T>(arc.angular_compliance)), way_give_(as<T>(arc.linear_compliance)) {}

  bool collapsed() const { return collapsed_; }

  Strain strain(const BasicWrench<T, 3>& wrench) {
    Strain loose = give(wrench);
    loose.rotation += as<T>(arc_.rest_rotation);
    loose.translation_mm += as<T>(arc_.rest_translation_mm);
    BasicWrench<T, 3> straight{Vector::Zero(), Vector::Zero()};
    for (const BasicTendon<3>& tendon : arc_.tendons) add_pull(tendon, as<T>(Vector3d(Vector3d::UnitX())), straight);
    Strain x = loose + -1.0 * give(straight);
    return solve(loose, x) ? x : robust_strain<with_shear>(arc_, wrench, collapsed_);
  }

  void begin_series(const Strain& first) {
    Blocks stiffness = no_stiffness();
    for (std::size_t i = 0; i < arc_.tendons.size(); ++i) {
      Series& s = series_[i];
      s.t[0] = tangent(first, i);
      s.length[0] = s.t[0].norm();
      s.inverse_length = T(1) / s.length[0];
      s.direction[0] = s.t[0] * s.inverse_length;
      add_stiffness(arc_.tendons[i], s.direction[0], s.inverse_length, stiffness);
    }
    factorise(stiffness);
  }

  void next(std::size_t k, const Vector& moment_Nmm, const Vector& force_N, Vector& rotation, Vector& translation_mm) {
    BasicWrench<T, 3> pulls{Vector::Zero(), Vector::Zero()};
    for (std::size_t i = 0; i < arc_.tendons.size(); ++i) {
      set_known_parts(series_[i], k);
      add_pull(arc_.tendons[i], series_[i].direction[k], pulls);
    }
    const Strain x = solved(give({force_N - pulls.force_N, moment_Nmm - pulls.moment_Nmm}));
    for (std::size_t i = 0; i < arc_.tendons.size(); ++i) {
      Series& s = series_[i];
      s.t[k] = tangent(x, i);
      const T along = s.direction[0].dot(s.t[k]);
      s.length[k] = s.length[k] + along;
      s.direction[k] += (s.t[k] - s.direction[0] * along) * s.inverse_length;
    }
    rotation = x.rotation;
    if constexpr (with_shear) translation_mm = x.translation_mm;
  }

 private:
  static constexpr std::size_t terms = 8;
  static constexpr int most_steps = 8;                             // as OneTendonSection
  static constexpr double largest_step = 0.5, least_length = 0.1;  // the same
  using Square = std::array<Vector, 3>;                            // by columns
  struct Blocks {  // of S: by turns, by ways; the rows of turns, of ways
    Square turn_by_turn, turn_by_way, way_by_turn, way_by_way;
  };
  struct Series {  // of t h, |t| h and t/|t|
    std::array<Vector, terms> t, direction;
    std::array<T, terms> length;
    T inverse_length;  // of the first
  };

  static Square no_block() { return {Vector::Zero(), Vector::Zero(), Vector::Zero()}; }
  static Blocks no_stiffness() { return {no_block(), no_block(), no_block(), no_block()}; }
  static Vector unit(int axis) { return as<T>(Vector3d(Vector3d::Unit(axis))); }

  // C W; without shear that of the turn alone.
  Strain give(const BasicWrench<T, 3>& wrench) const {
    Strain result{turn_give_.cwiseProduct(wrench.moment_Nmm), Vector::Zero()};
    if constexpr (with_shear) result.translation_mm = way_give_.cwiseProduct(wrench.force_N);
    return result;
  }
  Vector tangent(const Strain& strain, std::size_t tendon) const {
    const Vector turned = cross(strain.rotation, as<T>(arc_.tendons[tendon].arm_mm));
    return strain.translation_mm + turned;
  }
  static void add_pull(const BasicTendon<3>& tendon, const Vector& direction, BasicWrench<T, 3>& sum) {
    const Vector force_N = direction * T(tendon.tension_N);
    if constexpr (with_shear) sum.force_N += force_N;
    sum.moment_Nmm += Vector(arm_cross(as<T>(tendon.arm_mm), force_N));
  }
  static void add_stiffness(const BasicTendon<3>& tendon, const Vector& d, const T& inverse_length, Blocks& sum) {
    const Vector3d& r = tendon.arm_mm;
    const Vector arm = as<T>(r), c = arm_cross(arm, d);
    const T pull = T(tendon.tension_N) * inverse_length;
    const double r_squared = r.squaredNorm();
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      sum.turn_by_turn[i] += (unit(axis) * T(r_squared) - arm * T(r[axis]) - c * T(c[axis])) * pull;
      if constexpr (!with_shear) continue;
      sum.way_by_turn[i] += (Vector(cross(unit(axis), arm)) - d * T(c[axis])) * pull;
      sum.turn_by_way[i] += (Vector(arm_cross(arm, unit(axis))) - c * T(d[axis])) * pull;
      sum.way_by_way[i] += (unit(axis) - d * T(d[axis])) * pull;
    }
  }

  // For solved(). Both matrices that are inverted are 1 + C times a symmetric one, whose columns are its rows.
  void factorise(const Blocks& s) {
    Square rows = s.turn_by_turn;
    if constexpr (with_shear) {
      way_inverse_ = inverse_of_one_and(way_give_, s.way_by_way);
      turn_by_way_ = s.turn_by_way;
      for (std::size_t i = 0; i < 3; ++i) {
        way_by_turn_[i] = product(way_inverse_, Vector(way_give_.cwiseProduct(s.way_by_turn[i])));
        rows[i] -= product(turn_by_way_, way_by_turn_[i]);
      }
    }
    turn_inverse_ = inverse_of_one_and(turn_give_, rows);
  }
  static Square inverse_of_one_and(const Vector& give, const Square& symmetric) {
    Square rows;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      rows[i] = unit(axis) + symmetric[i] * T(give[axis]);
    }
    return inverse_of_rows(rows);
  }
  // (1 + C S) solved = x.
  Strain solved(const Strain& x) const {
    if constexpr (!with_shear) return {product(turn_inverse_, x.rotation), Vector::Zero()};
    const Vector way = product(way_inverse_, x.translation_mm);
    const Vector back = turn_give_.cwiseProduct(product(turn_by_way_, way));
    const Vector turn = product(turn_inverse_, Vector(x.rotation - back));
    return {turn, way - product(way_by_turn_, turn)};
  }

  // From the strain under straight tendons to that where X + C sum T B^T d = loose. False where Newton's method does
  // not converge at once.
  bool solve(const Strain& loose, Strain& x) {
    double last = 1;
    for (int step = 0; step < most_steps; ++step) {
      Blocks stiffness = no_stiffness();
      BasicWrench<T, 3> pulls{Vector::Zero(), Vector::Zero()};
      for (std::size_t i = 0; i < arc_.tendons.size(); ++i) {
        const Vector t = tangent(x, i);
        const double length = t.norm();
        if (!(length > least_length * arc_.rest_translation_mm[0])) return false;
        series_[i].inverse_length = T(1 / length);
        const Vector d = t * series_[i].inverse_length;
        add_pull(arc_.tendons[i], d, pulls);
        add_stiffness(arc_.tendons[i], d, series_[i].inverse_length, stiffness);
      }
      factorise(stiffness);
      const Strain newton = solved(x + give(pulls) + -1.0 * loose);
      x = x + -1.0 * newton;
      double size = 0;
      for (std::size_t i = 0; i < arc_.tendons.size(); ++i)
        size = std::max<double>(size, tangent(newton, i).norm() * series_[i].inverse_length);
      if (!(size < largest_step)) return false;
      if (size * std::min(1.0, size / last) <= 1e-16) return true;
      last = size;
    }
    return false;
  }

  // What coefficient k of |t| and d has without that of t.
  static void set_known_parts(Series& s, std::size_t k) {
    T length(0);
    Vector direction = Vector::Zero();
    for (std::size_t j = 1; j < k; ++j) {
      length = length + (s.t[j].dot(s.t[k - j]) - s.length[j] * s.length[k - j]);
      direction -= s.direction[k - j] * s.length[j];
    }
    s.length[k] = T(0.5) * s.inverse_length * length;
    s.direction[k] = (direction - s.direction[0] * s.length[k]) * s.inverse_length;
  }

  const ArcConstants& arc_;
  const Vector turn_give_, way_give_;  // C
  Square turn_inverse_, way_inverse_, turn_by_way_, way_by_turn_;
  std::array<Series, scene::max_tendon_offsets> series_;  // on the stack, touched only as far as there are tendons
  bool collapsed_ = false;
};

}  // namespace fam
