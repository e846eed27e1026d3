// The published law in the plane, once more and on purpose worse: every weakness of Weakness can be switched on. Not a
// part of the library. Sines and the like are taken one precision higher and rounded, so that all results depend on
// IEEE arithmetic alone.
#pragma once

#include "fam/arc.h"
#include "studies/methods/arc_search.h"

#include <cmath>

namespace studies {

enum class Search {
  root,       // of dPi/dtheta, secant steps from the straight arc's mean moment
  bisection,  // of dPi/dtheta, between two bounds that do not depend on N
  golden,     // minimum of Pi, golden section between such bounds
  brent       // minimum of Pi, GSL's Brent between such bounds
};

// tolerance: absolute, of the unknown (rad; of the radius over L); 0: relative, as tight as the arithmetic allows.
struct Weakness {
  bool single_precision = false;
  bool unsafe_forms = false;  // (1 - cos t)/t^2 and the like, as written
  bool expanded = false;      // Pi multiplied out into powers of the angle
  Search search = Search::root;
  double tolerance = 0;
  bool radius_unknown = false;    // rho = h/theta in place of theta
  bool straight_in_arc = false;   // the force not turned along the arc, in Pi
  bool straight_to_next = false;  // the force not turned when handed to the next arc
};

template <class T>
struct PlanarArc {
  T moment, axial, normal;  // times h/EI, h^2/EI, h^2/EI, in the distal frame
  const Weakness& weakness;

  // sin t/t, (1 - cos t)/t^2, (t - sin t)/t^3 and tan(t/4)/(t/4) with its derivative.
  struct Forms {
    T A, B, C, ratio, ratio_slope, sine, cosine;
  };

  Forms forms(T angle) const {
    const double t = static_cast<double>(angle);
    const T sine = static_cast<T>(std::sin(static_cast<long double>(t)));
    const T cosine = static_cast<T>(std::cos(static_cast<long double>(t)));
    if (!weakness.unsafe_forms || angle == 0) {
      const fam::ScrewCoefficients k = fam::screw_coefficients(t * t);
      const fam::TangentRatio r = fam::tangent_ratio(t / 4);
      return {T(k.A), T(k.B), T(k.C), T(r.value), T(r.derivative), sine, cosine};
    }
    const T x = angle / 4;
    const T tangent = static_cast<T>(std::tan(static_cast<long double>(x)));
    return {sine / angle,
            (1 - cosine) / (angle * angle),
            (angle - sine) / (angle * angle * angle),
            tangent / x,
            (1 + tangent * tangent - tangent / x) / x,
            sine,
            cosine};
  }

  // Moments that the Bezier curve's control points add, and their derivatives by the angle.
  struct Moments {
    T q0, q1, q2, r0, r1, r2;
  };

  Moments moments(T angle) const {
    const Forms k = forms(angle);
    const T a = k.ratio / 3, a_slope = k.ratio_slope / 12;
    if (weakness.straight_in_arc) {  // the straight arc's moments, whatever the angle
      return {normal, normal * T(2) / 3, normal / 3, 0, 0, 0};
    }
    const T turned = axial * k.sine + normal * k.cosine, turned_slope = axial * k.cosine - normal * k.sine;
    const T q0 = k.A * normal + k.B * angle * axial;
    const T r0 = angle * (k.C - k.B) * normal + (k.A - k.B) * axial;
    return {q0, q0 - a * turned, a * normal, r0, r0 - a_slope * turned - a * turned_slope, a_slope * normal};
  }

  static T gram(T x0, T x1, T x2, T y0, T y1, T y2) {
    return x0 * (y0 / 7 + y1 / 14 + y2 / 35) + x1 * (y0 / 14 + y1 * T(3) / 35 + y2 * T(9) / 140) +
           x2 * (y0 / 35 + y1 * T(9) / 140 + y2 * T(3) / 35);
  }

  // Pi = int_0^1 (theta - M(sigma; theta))^2 dsigma.
  T functional(T angle) const {
    const Moments m = moments(angle);
    const T mean = (m.q0 + m.q1 + m.q2) / 4, square = gram(m.q0, m.q1, m.q2, m.q0, m.q1, m.q2);
    if (weakness.expanded) {
      return angle * angle - 2 * angle * (moment + mean) + (moment * moment + 2 * moment * mean + square);
    }
    const T constant = angle - moment;
    return constant * constant - 2 * constant * mean + square;
  }

  // dPi/dtheta / 2.
  T slope(T angle) const {
    const Moments m = moments(angle);
    const T mean_slope = (m.r0 + m.r1 + m.r2) / 4;
    return (angle - moment) * (1 - mean_slope) - (m.q0 + m.q1 + m.q2) / 4 + gram(m.q0, m.q1, m.q2, m.r0, m.r1, m.r2);
  }

  // The bending angle; length_over_arc = L/h.
  T angle(T length_over_arc) const {
    const T tolerance = static_cast<T>(weakness.tolerance);
    if (weakness.radius_unknown) {  // between L/7 and 1000 L: any bend that is neither a full turn nor a straight line
      const auto of_radius = [&](T radius) { return functional(1 / (radius * length_over_arc)); };
      return 1 / (golden_section<T>(of_radius, T(1) / 7, T(1000), tolerance) * length_over_arc);
    }
    const auto pi = [&](T t) { return functional(t); };
    const auto dpi = [&](T t) { return slope(t); };
    constexpr double bound = 3;  // rad; P4 bends by 2.3 in all
    switch (weakness.search) {
      case Search::golden: return golden_section<T>(pi, T(-bound), T(bound), tolerance);
      case Search::bisection: return bisect<T>(dpi, T(-bound), T(bound), tolerance);
      case Search::brent:
        return static_cast<T>(
            brent_minimum([&](double t) { return static_cast<double>(functional(static_cast<T>(t))); }, -bound, bound,
                          weakness.tolerance));
      default: return secant<T>(dpi, moment + normal / 2, tolerance, std::abs(moment) + std::abs(normal));
    }
  }
};

}  // namespace studies
