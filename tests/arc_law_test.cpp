// One arc: its Bezier form, and the published law against its definition.
#include "fam/arc_law.h"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace fam;
using Eigen::Vector2d;

Vector2d bezier_point(const std::array<Vector2d, 4>& p, double t) {
  const double u = 1 - t;
  return u * u * u * p[0] + 3 * u * u * t * p[1] + 3 * u * t * t * p[2] + t * t * t * p[3];
}

TEST(Bezier, EndsOnTheCircleWithItsTangents) {
  for (const double angle : {0.0, 1e-8, 0.1, 1.0, 3.0, -2.0}) {
    const auto p = bezier_control_points(2, angle);
    const Vector2d tip = angle == 0
                             ? Vector2d(2, 0)
                             : Vector2d(2 / angle * std::sin(angle), 4 / angle * std::pow(std::sin(angle / 2), 2));
    EXPECT_LT((p[3] - tip).norm(), 1e-15) << angle;
    EXPECT_EQ(p[0], Vector2d(0, 0));
    EXPECT_EQ(p[1][1], 0);
    const Vector2d handle = p[3] - p[2];
    EXPECT_NEAR(handle[0] * std::sin(angle) - handle[1] * std::cos(angle), 0, 1e-15);
    EXPECT_NEAR(handle.norm(), p[1][0], 1e-15);
  }
}

// The header's bound for a quarter turn, and a twin: handles 1 % longer break it.
TEST(Bezier, DistanceFromTheCircle) {
  const double quarter = std::numbers::pi / 2;  // length of a quarter circle of radius 1, centre (0, 1)
  const auto largest_distance = [](const std::array<Vector2d, 4>& p) {
    double largest = 0;
    for (int i = 0; i <= 1000; ++i) {
      largest = std::max(largest, std::abs((bezier_point(p, i / 1000.) - Vector2d(0, 1)).norm() - 1));
    }
    return largest;
  };
  auto p = bezier_control_points(quarter, quarter);
  EXPECT_LT(largest_distance(p), 2.8e-4);
  p[1] *= 1.01;
  p[2] = p[3] - 1.01 * (p[3] - p[2]);
  EXPECT_GT(largest_distance(p), 2.8e-4);
}

TEST(Bezier, TangentRatioAndItsSlope) {
  EXPECT_EQ(tangent_ratio(0).value, 1);
  EXPECT_EQ(tangent_ratio(0).derivative, 0);
  for (const double x : {1e-8, 1e-3, 0.0499, 0.0501, 0.3, 1.2}) {
    EXPECT_NEAR(tangent_ratio(x).value, std::tan(x) / x, 1e-15 * tangent_ratio(x).value);
    const double h = 1e-5 * (0.1 + x);
    const double slope = (tangent_ratio(x + h).value - tangent_ratio(x - h).value) / (2 * h);
    EXPECT_NEAR(tangent_ratio(x).derivative, slope, 1e-8 + 1e-7 * slope) << x;
  }
}

// Pi(theta) by its definition: Simpson's rule over the sampled Bezier curve, the force turned with the arc; h = EI = 1.
double moment_functional(const PlaneLoad& load, double angle) {
  const auto p = bezier_control_points(1, angle);
  const Vector2d force(load.axial * std::cos(angle) - load.normal * std::sin(angle),
                       load.axial * std::sin(angle) + load.normal * std::cos(angle));
  constexpr int intervals = 200;
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const Vector2d arm = p[3] - bezier_point(p, static_cast<double>(i) / intervals);
    const double residual = angle - (load.moment + arm[0] * force[1] - arm[1] * force[0]);
    sum += residual * residual * (i == 0 || i == intervals ? 1 : i % 2 ? 4 : 2);
  }
  return sum / (3 * intervals);
}

TEST(PublishedLaw, AngleMinimisesTheMomentResidual) {
  for (const PlaneLoad& load : {PlaneLoad{0.1, 0, 0}, PlaneLoad{0, 0, 0.3}, PlaneLoad{0.2, -0.4, 0.5},
                                PlaneLoad{-0.3, 0.8, 0.6}, PlaneLoad{1.5, 0.3, -1.2}, PlaneLoad{1e-6, 2e-6, 3e-6}}) {
    double angle = 0;
    ASSERT_TRUE(published_angle(load, angle));
    const double h = 1e-3 * (std::abs(load.moment) + std::abs(load.normal));
    const double slope = moment_functional(load, angle + h) - moment_functional(load, angle - h);
    const double curvature =
        moment_functional(load, angle + h) - 2 * moment_functional(load, angle) + moment_functional(load, angle - h);
    EXPECT_GT(curvature, 0);
    EXPECT_NEAR(slope / curvature * h / 2, 0, h * h + 1e-6 * h) << load.moment;  // a Newton step from the angle found
    // A twin that must fail: an angle 5 % off does not minimise.
    EXPECT_GT(moment_functional(load, 1.05 * angle), moment_functional(load, angle));
  }
}

TEST(PublishedLaw, PureMomentIsExact) {
  double angle = 0;
  ASSERT_TRUE(published_angle({3 * std::numbers::pi, 0, 0}, angle));
  EXPECT_NEAR(angle, 3 * std::numbers::pi, 1e-14);
  ASSERT_TRUE(published_angle({0, 5, 0}, angle));  // a straight arc under pure tension
  EXPECT_EQ(angle, 0);
}

TEST(PublishedLaw, SaysWhenItFindsNoAngle) {
  double angle = 0;
  EXPECT_FALSE(published_angle({std::nan(""), 1, 1}, angle));
}

TEST(LawList, NamesLeadBackToTheirLaws) {
  for (const fam::Law law : fam::all_laws()) {
    EXPECT_EQ(fam::law_named(fam::name(law)), law);
    EXPECT_EQ(fam::chosen(law), law);
    EXPECT_EQ(fam::facts_of(law).law, law);
  }
  EXPECT_EQ(fam::law_named(fam::name(fam::Law::automatic)), fam::Law::automatic);
  EXPECT_NE(fam::chosen(fam::Law::automatic), fam::Law::automatic);
  EXPECT_EQ(fam::law_named("seventh_order"), std::nullopt);
}

}  // namespace
