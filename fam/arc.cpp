#include "fam/arc.h"

namespace fam {

SectionPose pose_on(const Arc& arc, const SectionPose& proximal, double fraction) {
  SectionPose pose = proximal;
  if (fraction > 0) pose = pose.then(twist(arc.twist_before_rad));
  pose = pose.then(exponential(fraction * arc.screw));
  if (fraction == 1) pose = pose.then(twist(arc.twist_after_rad));
  return pose;
}

std::array<Eigen::Vector2d, 4> bezier_control_points(double length_mm, double angle_rad) {
  const ScrewCoefficients k = screw_coefficients(angle_rad * angle_rad);
  const double a = length_mm / 3 * tangent_ratio(angle_rad / 4).value;
  const Eigen::Vector2d tip = length_mm * Eigen::Vector2d(k.A, k.B * angle_rad);
  return {Eigen::Vector2d(0, 0), Eigen::Vector2d(a, 0),
          tip - a * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)), tip};
}

TangentRatio tangent_ratio(double x) {
  const double x2 = x * x;
  if (x2 < 0.0025) {  // Taylor; the first dropped term is below 2e-18 (value) and 2e-16 (derivative)
    const double value =
        1 + x2 * (1 / 3. + x2 * (2 / 15. + x2 * (17 / 315. + x2 * (62 / 2835. + x2 * (1382 / 155925.)))));
    const double slope = 2 / 3. + x2 * (8 / 15. + x2 * (34 / 105. + x2 * (496 / 2835. + x2 * (2764 / 31185.))));
    return {value, x * slope};
  }
  const double tangent = std::tan(x);
  const double value = tangent / x;
  return {value, (1 + tangent * tangent - value) / x};
}

}  // namespace fam
