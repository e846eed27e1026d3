#include "exact_reference/elastica.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <gsl/gsl_sf_ellint.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

namespace exact_reference {
namespace {

using std::numbers::pi;

constexpr double smallest_complement =
    1e-200;  // of k'^2: below it R_D overflows, and the shape no longer depends on it

// Root of f between two values of different sign, to the last digits (Brent).
double root_between(double a, double b, const std::function<double(double)>& f) {
  gsl_set_error_handler_off();
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  gsl_function function{
      [](double x, void* target) { return (*static_cast<std::function<double(double)>*>(target))(x); },
      const_cast<std::function<double(double)>*>(&f)};
  gsl_root_fsolver_set(solver.get(), &function, std::min(a, b), std::max(a, b));
  for (int i = 0; i < 1000; ++i) {
    gsl_root_fsolver_iterate(solver.get());
    const double low = gsl_root_fsolver_x_lower(solver.get()), high = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(low, high, 0, 4e-16) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

struct Legendre {
  double F, E;
};

// Carlson's forms on |phi| <= pi/2, k' carried exactly: 1 - k^2 sin^2 = cos^2 + k'^2 sin^2.
Legendre reduced_integrals(double sine, double cosine, double complement) {
  gsl_set_error_handler_off();
  const double x = cosine * cosine, y = x + complement * sine * sine;
  const double F = sine * gsl_sf_ellint_RF(x, y, 1, GSL_PREC_DOUBLE);
  const double D = sine * sine * sine / 3 * gsl_sf_ellint_RD(x, y, 1, GSL_PREC_DOUBLE);
  return {F, F - (1 - complement) * D};
}

// Any amplitude, as sine and cosine of it less `half_turns` pi: exact where the cosine is.
Legendre integrals(double sine, double cosine, double half_turns, double complement) {
  Legendre result = reduced_integrals(sine, cosine, complement);
  if (half_turns != 0) {
    const Legendre complete = reduced_integrals(1, 0, complement);
    result.F += 2 * half_turns * complete.F;
    result.E += 2 * half_turns * complete.E;
  }
  return result;
}

Legendre integrals(double phi, double complement) {
  const double half_turns = std::round(phi / pi), rest = phi - half_turns * pi;
  return integrals(std::sin(rest), std::cos(rest), half_turns, complement);
}

struct SineCosine {
  double sn, cn;
};

// Jacobi's sn and cn for |u| <= K by descending Landen steps on the cotangent, which keeps the digits of a small cn
// where the usual recursion on the angle takes an arc sine near 1 (Bulirsch, Numerische Mathematik 7, 1965, sncndn).
SineCosine jacobi_functions(double u, double complement) {
  constexpr int most_steps = 20;
  constexpr double quadratic_end = 1e-9;  // the means meet quadratically: the next ones agree to 1e-18
  std::array<double, most_steps> arithmetic, geometric;
  double a = 1, product = complement, mean = 1;
  int n = 0;
  for (;; ++n) {
    arithmetic[n] = a;
    geometric[n] = std::sqrt(product);
    mean = (a + geometric[n]) / 2;
    if (n + 1 == most_steps || a - geometric[n] <= quadratic_end * a) break;
    product = geometric[n] * a;
    a = mean;
  }
  const double sine = std::sin(mean * u);
  if (sine == 0) return {0, 1};
  double ratio = std::cos(mean * u) / sine, cotangent = mean * ratio, dn = 1;
  for (; n >= 0; --n) {
    ratio *= cotangent;
    cotangent *= dn;
    dn = (geometric[n] + ratio) / (arithmetic[n] + ratio);
    ratio = cotangent / arithmetic[n];
  }
  const double sn = std::copysign(1 / std::hypot(cotangent, 1), sine);
  return {sn, cotangent * sn};
}

}  // namespace

double elliptic_integral_F(double phi, double complement) {
  return integrals(phi, complement).F;
}
double elliptic_integral_E(double phi, double complement) {
  return integrals(phi, complement).E;
}

double jacobi_amplitude(double u, double complement) {
  const double K = reduced_integrals(1, 0, complement).F, half_turns = std::round(u / (2 * K));
  const SineCosine here = jacobi_functions(u - 2 * half_turns * K, complement);
  return half_turns * pi + std::atan2(here.sn, here.cn);
}

Elastica::Elastica(double length_mm, double w, double force_angle, double angle_to_force, double curvature)
    : length_mm_(length_mm), w_(w), force_angle_(force_angle), angle_to_force_(angle_to_force), curvature_(curvature) {}

// With chi = psi -+ pi the pendulum hangs: chi'' = -w^2 sin chi, distances counted from the tip.
// k'^2 = cos^2(chi/2) - (chi'/2w)^2 at the tip, a product that keeps its digits when the rod is almost straight.
Elastica::FromTip Elastica::from_tip(double distance) const {
  if (w_ == 0) {  // a circle
    const double turn = -curvature_ * distance;
    const double half = turn / 2, sinc = half == 0 ? 1 : std::sin(half) / half, middle = angle_to_force_ + half;
    return {angle_to_force_ + turn, distance * sinc * Eigen::Vector2d(std::cos(middle), std::sin(middle))};
  }
  const double upright = std::abs(std::sin(angle_to_force_ / 2)), speed = std::abs(curvature_) / (2 * w_);
  if (upright == 0 && speed == 0) {  // along the force
    return {angle_to_force_, distance * Eigen::Vector2d(std::cos(angle_to_force_), 0)};
  }
  return upright >= speed ? swinging(distance) : rolling(distance);
}

// sin(chi/2) = k sn(U), chi' = 2 w k cn(U), cos(chi/2) = dn(U), U = U_0 + w distance.
Elastica::FromTip Elastica::swinging(double distance) const {
  const double side = std::sin(angle_to_force_ / 2) < 0 ? -1 : 1;
  const double sin_half = -side * std::cos(angle_to_force_ / 2), cos_half = std::abs(std::sin(angle_to_force_ / 2));
  const double speed = -curvature_ / (2 * w_);
  const double complement = std::max((cos_half - std::abs(speed)) * (cos_half + std::abs(speed)), smallest_complement);
  const double k = std::hypot(sin_half, speed);
  if (k == 0) return {angle_to_force_, distance * Eigen::Vector2d(std::cos(angle_to_force_), 0)};  // against the force
  const double sn_0 = sin_half / k, cn_0 = speed / k;
  const Legendre tip =
      cn_0 < 0 ? integrals(-sn_0, -cn_0, sn_0 < 0 ? -1 : 1, complement) : integrals(sn_0, cn_0, 0, complement);
  const double amplitude = jacobi_amplitude(tip.F + w_ * distance, complement);
  const double sn = std::sin(amplitude), cn = std::cos(amplitude);
  const double dn = std::sqrt(complement * sn * sn + cn * cn);
  const double cos_integral = 2 / w_ * (integrals(amplitude, complement).E - tip.E) - distance;
  const double sin_integral = 2 / w_ * (speed - k * cn);
  const double chi_0 = 2 * std::atan2(sin_half, cos_half), chi = 2 * std::atan2(k * sn, dn);
  return {angle_to_force_ + (chi - chi_0), Eigen::Vector2d(-cos_integral, -sin_integral)};
}

// chi/2 = +-am(W, 1/k), W = W_0 + k w distance.
Elastica::FromTip Elastica::rolling(double distance) const {
  const double side = std::sin(angle_to_force_ / 2) < 0 ? -1 : 1;
  const double direction = curvature_ < 0 ? 1 : -1;  // of chi
  const double sin_half = -side * std::cos(angle_to_force_ / 2), cos_half = std::abs(std::sin(angle_to_force_ / 2));
  const double speed = std::abs(curvature_) / (2 * w_);
  const double k = std::hypot(sin_half, speed);
  const double complement = std::max((speed - cos_half) * (speed + cos_half) / (k * k), smallest_complement);
  const double amplitude_0 = direction * std::atan2(sin_half, cos_half);
  const Legendre tip = integrals(direction * sin_half, cos_half, 0, complement);
  const double advance = k * w_ * distance;
  const double amplitude = jacobi_amplitude(tip.F + advance, complement);
  const double sine = std::sin(amplitude), cosine = std::cos(amplitude);
  const double dn = std::sqrt(cosine * cosine + complement * sine * sine);
  const double cos_integral = distance - 2 * k / w_ * (advance - (integrals(amplitude, complement).E - tip.E));
  const double sin_integral = direction * 2 / w_ * (speed - k * dn);
  const double chi_change = 2 * direction * (amplitude - amplitude_0);
  return {angle_to_force_ + chi_change, Eigen::Vector2d(-cos_integral, -sin_integral)};
}

Elastica Elastica::with_follower_load(const PlanarCantilever& cantilever) {
  const double L = cantilever.length_mm, EI = cantilever.bending_stiffness_Nmm2;
  const Eigen::Vector2d force = cantilever.tip_force_N;
  const double in_tip_frame = force.isZero(0) ? 0 : std::atan2(force[1], force[0]);
  Elastica result(L, std::sqrt(force.norm() / EI) * L, 0, -in_tip_frame, cantilever.tip_moment_Nmm * L / EI);
  result.force_angle_ = -result.from_tip(1).angle_to_force;  // the clamp's tangent is the base frame's x
  return result;
}

std::optional<Elastica> Elastica::with_fixed_load(const PlanarCantilever& cantilever) {
  const double L = cantilever.length_mm, EI = cantilever.bending_stiffness_Nmm2;
  const Eigen::Vector2d force = cantilever.tip_force_N;
  const double w = std::sqrt(force.norm() / EI) * L, curvature = cantilever.tip_moment_Nmm * L / EI;
  if (w == 0) return with_follower_load(cantilever);
  const double gamma = std::atan2(force[1], force[0]);
  if (curvature == 0 && force[1] == 0) return Elastica(L, w, gamma, -gamma, 0);

  // Clamp angle for a trial angle of the tip to the force; 0 wanted.
  const auto clamp_angle = [&](double trial, double load) {
    return Elastica(L, w * std::sqrt(load), gamma, trial, load * curvature).from_tip(1).angle_to_force + gamma;
  };
  if (curvature == 0) {
    // The angle grows from tip to clamp by cosh w at most; the first root from below is the branch that grows from 0.
    double low = -gamma / (2 * std::cosh(w));
    double high = low;
    while (clamp_angle(high, 1) * gamma > 0 && std::abs(high) < std::abs(gamma)) {
      low = high;
      high = std::abs(1.1 * high) < std::abs(gamma) ? 1.1 * high : -gamma;
    }
    return Elastica(L, w, gamma, root_between(low, high, [&](double x) { return clamp_angle(x, 1); }), 0);
  }
  constexpr int steps = 400;
  double root = -gamma, last = -gamma;
  for (int i = 1; i <= steps; ++i) {
    const double load = static_cast<double>(i) / steps, predicted = 2 * root - last;
    const double middle = clamp_angle(predicted, load);
    double reach = 1e-6, side = 0;
    for (; side == 0 && reach < 0.5; reach *= 1.5) {
      if (clamp_angle(predicted + reach, load) * middle <= 0) side = reach;
      if (clamp_angle(predicted - reach, load) * middle <= 0) side = -reach;
    }
    if (side == 0) return std::nullopt;
    last = root;
    root = root_between(predicted, predicted + side, [&](double x) { return clamp_angle(x, load); });
  }
  return Elastica(L, w, gamma, root, curvature);
}

PlanarPose Elastica::at(double s_mm) const {
  const FromTip clamp = from_tip(1), here = from_tip(1 - s_mm / length_mm_);
  const Eigen::Vector2d along = length_mm_ * (clamp.along_force - here.along_force);
  const double c = std::cos(force_angle_), s = std::sin(force_angle_);
  return {{c * along[0] - s * along[1], s * along[0] + c * along[1]}, here.angle_to_force + force_angle_};
}

}  // namespace exact_reference
