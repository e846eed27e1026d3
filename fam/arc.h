// One arc: a screw motion, with the paper's cubic Bezier curve as its planar form.
#pragma once

#include "fam/screw.h"

#include <array>

namespace fam {

// Twist about the tangent (only the published law splits it off; the coupled laws carry it in the screw), then the
// screw, then twist again.
template <int D>
struct BasicArc {
  BasicScrew<double, D> screw;
  double twist_before_rad = 0;
  double twist_after_rad = 0;
};
using Arc = BasicArc<3>;

// Pose on the arc at a fraction in [0, 1] of its length, from the pose at its proximal end.
SectionPose pose_on(const Arc& arc, const SectionPose& proximal, double fraction);

// Control points P0..P3 of the cubic Bezier curve of an arc of length h (mm) that bends by the angle (rad) from the
// x axis towards the y axis: P1 = (a, 0), P2 = P3 - a (cos, sin), P3 = h ((sin t)/t, (1 - cos t)/t) with
// a = (4/3) (h/t) tan(t/4). Its distance from the circle is below 2.8e-4 of the radius up to a quarter turn; it has
// a meaning up to |angle| < 2 pi.
std::array<Eigen::Vector2d, 4> bezier_control_points(double length_mm, double angle_rad);

// tan(x)/x and its derivative, without cancellation near zero.
struct TangentRatio {
  double value, derivative;
};
TangentRatio tangent_ratio(double x);

}  // namespace fam
