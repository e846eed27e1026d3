// Sections with tendons: the strain under a total wrench, and its series along an arc.
//
// A frictionless tendon of tension T at r in the section pulls along its own tangent t = v + u x r (Rucker and Webster,
// IEEE T-RO 27(6), 2011). With the strain X = (u, v), t = B X, and its direction d = t / |t|,
//   X = X0 + C (W - sum T B^T d),     C = K^-1, W the total wrench (m, n),
// is where the convex energy 1/2 (X - X0) K (X - X0) + sum T |B X| - W X is least. Along the arc the series'
// coefficients of d follow from |t|^2 = t.t and |t| d = t; each coefficient of X is then a linear equation with the
// same matrix I + C S, S = sum T/|t| B^T (1 - d d^T) B. All strains times the arc length h, as everywhere in arc_law.h.
//
// A rod in the plane without shear has t along e_x: its tendons are a constant moment, and none of this is needed.
#pragma once

#include "fam/dual.h"
#include "fam/elimination.h"
#include "fam/screw.h"

#include "scene/scene.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace fam {

// The tendons of a span, tension times the load factor; in the plane without the offsets normal to it.
template <int D>
struct BasicTendon {
  Vector<double, D> arm_mm;
  double tension_N;
};

// Where |v + u x r| is smaller the tendon has collapsed to a point: its direction is not defined, the rod's strain is
// that of a kink of the energy, which no smooth arc has. Half of double's digits.
constexpr double smallest_tendon_stretch = 1e-8;

// Pulls T t/|t| and their moments r x T t/|t| on a section under a strain times h (section frame).
template <int D>
BasicWrench<double, D> tendon_pulls(std::span<const BasicTendon<D>> tendons, const BasicScrew<double, D>& strain) {
  BasicWrench<double, D> sum;
  for (const BasicTendon<D>& tendon : tendons) {
    const Vector<double, D> t = strain.translation_mm + cross(strain.rotation, tendon.arm_mm);
    const Vector<double, D> force = tendon.tension_N / t.norm() * t;
    sum = sum + BasicWrench<double, D>{force, arm_cross(tendon.arm_mm, force)};
  }
  return sum;
}

// Strain times h from a wrench, in a section with tendons; the arc laws' `Section`.
template <bool with_shear, class T, int D>
class TendonSection {
 public:
  static constexpr bool gives_way = with_shear;
  static constexpr int rotations = rotations_of(D);
  static constexpr int unknowns = with_shear ? rotations + D : rotations;
  using Strain = Eigen::Matrix<T, unknowns, 1>;  // u h, then v h where it gives way

  template <class Constants>  // BasicArcConstants<D>
  explicit TendonSection(const Constants& arc) : tendons_(arc.tendons), rest_translation_mm_(arc.rest_translation_mm) {
    compliance_.template head<rotations>() = arc.angular_compliance;
    rest_.template head<rotations>() = arc.rest_rotation;
    if constexpr (with_shear) {
      compliance_.template tail<D>() = arc.linear_compliance;
      rest_.template tail<D>() = arc.rest_translation_mm;
    }
  }

  // A tendon was found collapsed, or the strain not found; it is NaN then.
  bool collapsed() const { return collapsed_; }

  [[gnu::noinline]] BasicScrew<T, D> strain(const BasicWrench<T, D>& wrench) {
    Eigen::Matrix<double, unknowns, 1> loads;
    const Strain w = vector(wrench.moment_Nmm, wrench.force_N);
    for (int i = 0; i < unknowns; ++i) loads[i] = value_of(w[i]);
    const Eigen::Matrix<double, unknowns, 1> found = minimise(loads);
    Strain x = found.template cast<T>();
    if constexpr (!std::is_same_v<T, double>) x = with_derivatives(w, found);
    return screw<T>(x, Vector<T, D>(rest_translation_mm_.template cast<T>()));
  }

  // An arc's series: begin_series() after its first strain, then coefficient k of the strain from that of the wrench.
  [[gnu::noinline]] void begin_series(const BasicScrew<T, D>& first) {
    factors_.setIdentity();
    for (std::size_t i = 0; i < tendons_.size(); ++i) {
      Series& s = series_[i];
      s.t[0] = tangent<T>(first, arm(i));
      using std::sqrt;
      s.length[0] = sqrt(s.t[0].dot(s.t[0]));
      s.direction[0] = s.t[0] * (T(1) / s.length[0]);
      add_stiffness<T>(factors_, i, s.direction[0], s.length[0]);
    }
    factorise(factors_);
  }

  [[gnu::noinline]] void next(std::size_t k, const Angular<T, D>& moment_Nmm, const Vector<T, D>& force_N,
                              Angular<T, D>& rotation, Vector<T, D>& translation_mm) {
    Strain x = vector(moment_Nmm, force_N);
    for (std::size_t i = 0; i < tendons_.size(); ++i) {
      known_parts(series_[i], k);
      x -= T(tendons_[i].tension_N) * pull(series_[i].direction[k], arm(i));
    }
    x = compliance_.template cast<T>().cwiseProduct(x).eval();
    substitute(factors_, x);
    const BasicScrew<T, D> result = screw<T>(x, Vector<T, D>(Vector<T, D>::Zero()));
    for (std::size_t i = 0; i < tendons_.size(); ++i) {
      Series& s = series_[i];
      s.t[k] = tangent<T>(result, arm(i));
      const T along = s.direction[0].dot(s.t[k]);
      s.length[k] += along;
      s.direction[k] += (s.t[k] - s.direction[0] * along) * (T(1) / s.length[0]);
    }
    rotation = result.rotation;
    if constexpr (with_shear) translation_mm = result.translation_mm;
  }

 private:
  static constexpr std::size_t terms = 8;
  struct Series {  // of t h, |t| h and t/|t|
    std::array<Vector<T, D>, terms> t, direction;
    std::array<T, terms> length;
  };

  static Strain vector(const Angular<T, D>& turn, const Vector<T, D>& translation) {
    Strain x;
    x.template head<rotations>() = turn;
    if constexpr (with_shear) x.template tail<D>() = translation;
    return x;
  }
  template <class Number>
  static BasicScrew<Number, D> screw(const Eigen::Matrix<Number, unknowns, 1>& x, const Vector<Number, D>& rigid) {
    if constexpr (with_shear) return {x.template head<rotations>(), x.template tail<D>()};
    else return {x, rigid};
  }
  Vector<T, D> arm(std::size_t i) const { return tendons_[i].arm_mm.template cast<T>(); }

  template <class Number>
  static Vector<Number, D> tangent(const BasicScrew<Number, D>& strain, const Vector<Number, D>& arm) {
    return strain.translation_mm + cross(strain.rotation, arm);
  }
  static Strain pull(const Vector<T, D>& direction, const Vector<T, D>& arm) {
    return vector(arm_cross(arm, direction), direction);
  }

  // += C T/|t| B^T (1 - d d^T) B.
  template <class Number>
  void add_stiffness(Eigen::Matrix<Number, unknowns, unknowns>& matrix, std::size_t i, const Vector<Number, D>& d,
                     const Number& length) const {
    const Vector<Number, D> arm = tendons_[i].arm_mm.template cast<Number>();
    const Number pull = Number(tendons_[i].tension_N) / length;
    Eigen::Matrix<Number, D, D> across;
    for (int row = 0; row < D; ++row) {
      for (int column = 0; column < D; ++column) {
        across(row, column) = pull * (Number(row == column ? 1 : 0) - d[row] * d[column]);
      }
    }
    const auto add = [&](int column, const Vector<Number, D>& force) {
      const Angular<Number, D> moment = arm_cross(arm, force);
      for (int row = 0; row < rotations; ++row) matrix(row, column) += Number(compliance_[row]) * moment[row];
      if constexpr (!with_shear) return;
      for (int row = rotations; row < unknowns; ++row) {
        matrix(row, column) += Number(compliance_[row]) * force[row - rotations];
      }
    };
    for (int turn = 0; turn < rotations; ++turn) {  // across times (unit turn x arm)
      if constexpr (D == 2) {
        add(turn, across.col(1) * arm[0] - across.col(0) * arm[1]);
      } else {
        const int next = (turn + 1) % 3, last = (turn + 2) % 3;
        add(turn, across.col(last) * arm[next] - across.col(next) * arm[last]);
      }
    }
    for (int axis = 0; with_shear && axis < D; ++axis) add(rotations + axis, across.col(axis));
  }

  // X - X0 - C (W - sum T B^T d) at a strain; the tangent's matrix too where asked for. False: a tendon collapsed.
  // With `rounding` for the energy T sqrt(|t|^2 + rounding^2), which has no kink.
  template <class Number>
  bool residual(const Eigen::Matrix<Number, unknowns, 1>& loads, const Eigen::Matrix<Number, unknowns, 1>& x,
                Eigen::Matrix<Number, unknowns, 1>& result, Eigen::Matrix<double, unknowns, unknowns>* matrix,
                double rounding = 0) const {
    Eigen::Matrix<Number, unknowns, 1> rest_loads = loads;
    const BasicScrew<Number, D> strain =
        screw<Number>(x, Vector<Number, D>(rest_translation_mm_.template cast<Number>()));
    for (std::size_t i = 0; i < tendons_.size(); ++i) {
      const Vector<Number, D> arm = tendons_[i].arm_mm.template cast<Number>();
      const Vector<Number, D> t = tangent<Number>(strain, arm);
      using std::sqrt;
      const Number length = sqrt(t.dot(t) + Number(rounding * rounding));
      if (!(value_of(length) > smallest_tendon_stretch * rest_translation_mm_[0])) return false;
      const Vector<Number, D> d = t * (Number(1) / length);
      const Number tension(tendons_[i].tension_N);
      rest_loads.template head<rotations>() -= arm_cross(arm, d) * tension;
      if constexpr (with_shear) rest_loads.template tail<D>() -= d * tension;
      if constexpr (std::is_same_v<Number, double>) {
        if (matrix) add_stiffness<double>(*matrix, i, d, length);
      }
    }
    result = x - rest_.template cast<Number>() - compliance_.template cast<Number>().cwiseProduct(rest_loads);
    return true;
  }

  // Of a strain, from its rest, less a constant.
  double energy(const Eigen::Matrix<double, unknowns, 1>& loads, const Eigen::Matrix<double, unknowns, 1>& x,
                double rounding) const {
    const BasicScrew<double, D> strain = screw<double>(x, rest_translation_mm_);
    double sum = 0;
    for (const BasicTendon<D>& tendon : tendons_)
      sum += tendon.tension_N * std::hypot(tangent<double>(strain, tendon.arm_mm).norm(), rounding);
    for (int i = 0; i < unknowns; ++i) {
      const double change = x[i] - rest_[i];
      if (compliance_[i] > 0) sum += change * (change / (2 * compliance_[i]) - loads[i]);
    }
    return sum;
  }
  // Its derivative along a direction where the residual is `miss`; compliances of zero do not move.
  double energy_slope(const Eigen::Matrix<double, unknowns, 1>& miss,
                      const Eigen::Matrix<double, unknowns, 1>& direction) const {
    double slope = 0;
    for (int i = 0; i < unknowns; ++i) {
      if (compliance_[i] > 0) slope += miss[i] * direction[i] / compliance_[i];
    }
    return slope;
  }

  // The strain of least energy: from that with straight tendons, or, where a kink of the energy is in the way, by
  // energies with the kinks rounded off less and less.
  [[gnu::noinline]] Eigen::Matrix<double, unknowns, 1> minimise(const Eigen::Matrix<double, unknowns, 1>& loads) {
    using Unknowns = Eigen::Matrix<double, unknowns, 1>;
    Unknowns x = rest_, direct = loads;
    for (const BasicTendon<D>& tendon : tendons_) {
      const Vector<double, D> e_x = Vector<double, D>::Unit(0);
      direct.template head<rotations>() -= tendon.tension_N * arm_cross(tendon.arm_mm, e_x);
      if constexpr (with_shear) direct.template tail<D>() -= tendon.tension_N * e_x;
    }
    x += compliance_.cwiseProduct(direct);
    Unknowns scale = direct.cwiseAbs() + loads.cwiseAbs();  // of the loads, then of the strains
    for (const BasicTendon<D>& tendon : tendons_) {
      scale.template head<rotations>().array() += tendon.tension_N * tendon.arm_mm.norm();
      if constexpr (with_shear) scale.template tail<D>().array() += tendon.tension_N;
    }
    scale = (rest_.cwiseAbs() + compliance_.cwiseProduct(scale)).eval();
    if (newton(loads, scale, 0, x)) return x;
    x = rest_;
    constexpr double least_rounding = smallest_tendon_stretch, finer = 0.1;  // the latter chosen, not measured
    bool found = true;
    for (double rounding = 1; found && rounding > least_rounding; rounding *= finer)
      found = newton(loads, scale, rounding * rest_translation_mm_[0], x);
    if (found && newton(loads, scale, 0, x)) return x;
    collapsed_ = true;
    return Unknowns::Constant(std::numeric_limits<double>::quiet_NaN());
  }

  // Newton's method, its steps halved until the energy, which is convex, falls along them.
  bool newton(const Eigen::Matrix<double, unknowns, 1>& loads, const Eigen::Matrix<double, unknowns, 1>& scale,
              double rounding, Eigen::Matrix<double, unknowns, 1>& x) const {
    using Unknowns = Eigen::Matrix<double, unknowns, 1>;
    constexpr int max_steps = 60;
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < max_steps; ++step) {
      Eigen::Matrix<double, unknowns, unknowns> matrix = Eigen::Matrix<double, unknowns, unknowns>::Identity();
      Unknowns miss;
      if (!residual<double>(loads, x, miss, &matrix, rounding)) return false;
      factorise(matrix);
      Unknowns newton = miss;
      substitute(matrix, newton);
      double size = 0;  // of the step, relative
      for (int i = 0; i < unknowns; ++i) {
        if (newton[i] != 0) size = std::max(size, std::abs(newton[i]) / scale[i]);
      }
      if (!newton.allFinite() || !std::isfinite(size)) return false;
      // What the next step would be at most, as the last two tell; or round-off.
      const double shrinkage = std::isfinite(last) ? std::min(1.0, size / last) : 1;
      if (size * shrinkage <= 1e-16 || (size < 1e-10 && size >= last / 2)) {
        x -= newton;
        return true;
      }
      double part = 1;
      if (size > 1e-6) {  // closer to the minimum whole steps converge
        const double before = energy(loads, x, rounding), slope = energy_slope(miss, newton);
        while (energy(loads, x - part * newton, rounding) > before - 1e-4 * part * slope && part > 1e-6) part /= 2;
      }
      x -= part * newton;
      last = size;
    }
    return false;
  }

  // One more step in T, whose derivatives are those of the solution.
  [[gnu::noinline]] Strain with_derivatives(const Strain& loads,
                                            const Eigen::Matrix<double, unknowns, 1>& found) const {
    Strain miss;
    Eigen::Matrix<double, unknowns, unknowns> matrix = Eigen::Matrix<double, unknowns, unknowns>::Identity();
    Eigen::Matrix<double, unknowns, 1> value, values;
    for (int i = 0; i < unknowns; ++i) values[i] = value_of(loads[i]);
    Strain x = found.template cast<T>();
    if (!residual<double>(values, found, value, &matrix) || !residual<T>(loads, x, miss, nullptr)) return x;
    const Eigen::Matrix<double, unknowns, unknowns> inverse = matrix.inverse();
    for (int i = 0; i < unknowns; ++i) {
      for (int j = 0; j < unknowns; ++j) x[i] -= T(inverse(i, j)) * miss[j];
    }
    return x;
  }

  // What coefficient k of |t| and t/|t| has without that of t.
  static void known_parts(Series& s, std::size_t k) {
    T length(0);
    Vector<T, D> direction = Vector<T, D>::Zero();
    for (std::size_t j = 1; j < k; ++j) {
      length += s.t[j].dot(s.t[k - j]) - s.length[j] * s.length[k - j];
      direction -= s.direction[k - j] * s.length[j];
    }
    const T inverse = T(1) / s.length[0];
    s.length[k] = T(0.5) * length * inverse;
    s.direction[k] = (direction - s.direction[0] * s.length[k]) * inverse;
  }

  const std::span<const BasicTendon<D>> tendons_;
  const Vector<double, D>& rest_translation_mm_;
  Eigen::Matrix<double, unknowns, 1> compliance_, rest_;
  Eigen::Matrix<T, unknowns, unknowns> factors_;
  std::array<Series, scene::max_tendon_offsets> series_;  // on the stack, touched only as far as there are tendons
  bool collapsed_ = false;
};

}  // namespace fam
