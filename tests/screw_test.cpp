// Screws at the identity, at 1e-8 and at ordinary values.
#include "fam/screw.h"

#include "scene/equilibrium.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace {

using namespace fam;

// Closed forms in long double, with half angles against cancellation, where the angle is not small; Taylor at zero.
TEST(Screw, CoefficientsAgainstLongDouble) {
  EXPECT_EQ(screw_coefficients(0.0).A, 1);
  EXPECT_EQ(screw_coefficients(0.0).B, 0.5);
  EXPECT_EQ(screw_coefficients(0.0).C, 1 / 6.);
  for (double angle : {1e-8, 1e-4, 0.01, 0.1, 0.3, 0.7, 0.999, 1.001, 1.5, 3.0, 6.0, 12.0}) {
    const long double t = std::sqrt(static_cast<long double>(angle) * angle);
    const long double half = std::sin(t / 2);
    const long double A = std::sin(t) / t;
    const long double B = 2 * half * half / (t * t);
    long double C = (t - std::sin(t)) / (t * t * t);
    if (t < 0.3L) {  // six terms of the series: t^12/15! < 1e-18
      C = 1 / 6.0L - t * t / 120 + t * t * t * t / 5040 - std::pow(t, 6.0L) / 362880 + std::pow(t, 8.0L) / 39916800 -
          std::pow(t, 10.0L) / 6227020800.0L;
    }
    const ScrewCoefficients k = screw_coefficients(angle * angle);
    EXPECT_NEAR(k.A, static_cast<double>(A), 5e-16) << angle;
    EXPECT_NEAR(k.B / static_cast<double>(B), 1, 1e-15) << angle;
    EXPECT_NEAR(k.C / static_cast<double>(C), 1, 2e-15) << angle;
  }
}

Screw random_screw(std::mt19937& generator, double angle) {
  std::normal_distribution<double> normal;
  const auto direction = [&] { return Vector3d(normal(generator), normal(generator), normal(generator)).normalized(); };
  return {angle * direction(), 5 * direction()};
}

class ScrewAtAngle : public testing::TestWithParam<double> {};

// exp(a) then exp(-a) is the identity; two halves make a whole; the rotation is a rotation.
TEST_P(ScrewAtAngle, GroupProperties) {
  std::mt19937 generator(1);
  for (int i = 0; i < 20; ++i) {
    const Screw screw = random_screw(generator, GetParam());
    const SectionPose there = SectionPose{}.then(exponential(screw));
    const SectionPose back = there.then(exponential(-1.0 * screw));
    EXPECT_LT((back.rotation_BS - Matrix3d::Identity()).norm(), 4e-15);
    EXPECT_LT(back.position_B_mm.norm(), 2e-14);
    const SectionPose halves = SectionPose{}.then(exponential(0.5 * screw)).then(exponential(0.5 * screw));
    EXPECT_LT((halves.rotation_BS - there.rotation_BS).norm(), 4e-15);
    EXPECT_LT((halves.position_B_mm - there.position_B_mm).norm(), 2e-14);
    EXPECT_LT((there.rotation_BS.transpose() * there.rotation_BS - Matrix3d::Identity()).norm(), 4e-15);
    EXPECT_NEAR(there.rotation_BS.determinant(), 1, 4e-15);
  }
}

// |n| and m.n are carried exactly by any strain.
TEST_P(ScrewAtAngle, TransportKeepsInvariants) {
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const SectionWrench distal{{normal(generator), normal(generator), normal(generator)},
                               {normal(generator), normal(generator), normal(generator)}};
    const SectionWrench proximal = transport(exponential(random_screw(generator, GetParam())), distal);
    EXPECT_NEAR(proximal.force_N.norm(), distal.force_N.norm(), 4e-15);
    EXPECT_NEAR(proximal.force_N.dot(proximal.moment_Nmm), distal.force_N.dot(distal.moment_Nmm), 5e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, ScrewAtAngle, testing::Values(0.0, 1e-8, 1e-3, 0.5, 0.999, 1.001, 2.0, 3.1));

// A quarter circle of length pi/2: radius 1, tip at (1, 1).
TEST(Screw, QuarterCircle) {
  const double quarter = std::numbers::pi / 2;
  const SectionPose tip = SectionPose{}.then(exponential(Screw{{0, 0, quarter}, {quarter, 0, 0}}));
  EXPECT_LT((tip.position_B_mm - Vector3d(1, 1, 0)).norm(), 1e-15);
  EXPECT_LT((tip.rotation_BS.col(0) - Vector3d(0, 1, 0)).norm(), 1e-15);
}

// In a plane full turns count, also where a station is back at no rotation; in space the angle is the last station's.
TEST(TipAngle, FollowsTurnsInAPlane) {
  for (const double turns : {0.25, 0.5, 1.0, 2.0, -2.0, 10.0}) {
    std::vector<scene::Station> stations;
    for (int i = 0; i <= 400; ++i) {
      const double angle = 2 * std::numbers::pi * turns * i / 400;
      const SectionPose pose = SectionPose{}.then(exponential(Screw{angle * Vector3d(0, 0.6, 0.8), Vector3d::Zero()}));
      stations.push_back({i / 400., {pose.rotation_BS, pose.position_B_mm}});
    }
    EXPECT_NEAR(scene::tip_angle_rad(stations, Vector3d(0, 0.6, 0.8)), 2 * std::numbers::pi * std::abs(turns), 1e-9);
    const double in_space = 2 * std::numbers::pi * std::abs(turns - std::round(turns));
    EXPECT_NEAR(scene::tip_angle_rad(stations, std::nullopt), in_space, 1e-7);
  }
}

}  // namespace
