#include "fam/published_arc.h"

#include <cmath>

namespace fam {
namespace {

// dPi/dtheta / 2 and its Gauss-Newton slope. The Bezier curve makes the moment along the arc a Bernstein sum
// M(sigma) = moment + B0 q0 + B1 q1 + B2 q2 with q_i = (P3 - P_i) x F, so the integrals are those of Bernstein
// polynomials: int B_i = 1/4, int B_i B_j = binom(3,i) binom(3,j) / (7 binom(6,i+j)).
struct Residual {
  double value, slope;
};

Residual moment_residual(const PlaneLoad& load, double angle) {
  const ScrewCoefficients k = screw_coefficients(angle * angle);
  const double sine = k.A * angle;
  const double cosine = 1 - k.B * angle * angle;
  const TangentRatio ratio = tangent_ratio(angle / 4);
  const double a = ratio.value / 3;  // length of the Bezier handles
  const double a_slope = ratio.derivative / 12;
  const double turned_normal = load.axial * sine + load.normal * cosine;  // force turned with the arc
  const double turned_normal_slope = load.axial * cosine - load.normal * sine;

  const double q0 = k.A * load.normal + k.B * angle * load.axial;
  const double q1 = q0 - a * turned_normal;
  const double q2 = a * load.normal;
  const double r0 = angle * (k.C - k.B) * load.normal + (k.A - k.B) * load.axial;  // dq0/dtheta
  const double r1 = r0 - a_slope * turned_normal - a * turned_normal_slope;
  const double r2 = a_slope * load.normal;

  const auto gram = [](double x0, double x1, double x2, double y0, double y1, double y2) {
    return x0 * (y0 / 7 + y1 / 14 + y2 / 35) + x1 * (y0 / 14 + y1 * (3 / 35.) + y2 * (9 / 140.)) +
           x2 * (y0 / 35 + y1 * (9 / 140.) + y2 * (3 / 35.));
  };
  const double mean_slope = (r0 + r1 + r2) / 4;
  const double constant = angle - load.moment;
  return {constant * (1 - mean_slope) - (q0 + q1 + q2) / 4 + gram(q0, q1, q2, r0, r1, r2),
          1 - 2 * mean_slope + gram(r0, r1, r2, r0, r1, r2)};
}

}  // namespace

bool published_angle(const PlaneLoad& load, double& angle_rad) {
  double angle = load.moment + load.normal / 2;  // curvature of the straight arc's mean moment
  const double scale = std::abs(load.moment) + std::abs(load.normal);
  Residual last = moment_residual(load, angle);
  double step = -last.value / last.slope;
  for (int iteration = 0; iteration < max_angle_steps; ++iteration) {
    angle += step;
    if (std::abs(step) <= angle_step_tolerance * (scale + std::abs(angle))) {
      angle_rad = angle;
      return true;
    }
    const Residual residual = moment_residual(load, angle);
    const double secant_slope = (residual.value - last.value) / step;
    const double slope = secant_slope > 0.1 * residual.slope ? secant_slope : residual.slope;
    last = residual;
    step = -residual.value / slope;
  }
  return false;
}

bool published_arc(const ArcConstants& constants, const SectionWrench& distal, TwistOrder order, Arc& arc) {
  const double h = constants.length_mm;
  const Vector3d& F = distal.force_N;
  // h K^-1 M with the rest curvature and the tendons, in their directions at the distal end, as moments.
  const Vector3d turn = strain_under<false>(constants, distal).rotation;
  const double bending_compliance = constants.angular_compliance[1];

  // Bending plane on the straight arc: M + h e_x x F without its x component, here times h/EI.
  const Eigen::Vector2d total(turn[1] - bending_compliance * h * F[2], turn[2] + bending_compliance * h * F[1]);
  const double norm = total.norm();
  const Eigen::Vector2d normal = norm > 0 ? Eigen::Vector2d(total / norm) : Eigen::Vector2d(0, 1);
  const PlaneLoad load{turn[1] * normal[0] + turn[2] * normal[1], bending_compliance * h * F[0],
                       bending_compliance * h * (F[1] * normal[1] - F[2] * normal[0])};
  double angle = 0;
  const bool found = published_angle(load, angle);
  arc.screw = {angle * Vector3d(0, normal[0], normal[1]), constants.rest_translation_mm};
  (order == TwistOrder::twist_bend ? arc.twist_before_rad : arc.twist_after_rad) = turn[0];
  (order == TwistOrder::twist_bend ? arc.twist_after_rad : arc.twist_before_rad) = 0;
  return found;
}

}  // namespace fam
