// The exact reference on all load kinds: numbers of independent programs, identities, stability.
//
// "Independent numbers": scipy DOP853 shooting at rtol 1e-12 (collocation for the hard case), independent of this
// project.
#include "exact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace exact_test;
using exact_reference::RodModel;
using exact_reference::Way;

namespace {

const scene::Scene spatial_rod = uniform_rod(40, 1500, 1000);

// A gate and its twin: within the limit, and a 5 % stiffer rod is not.
void expect_tip(const scene::Scene& rod, const Vector3d& wanted_mm, double limit_mm, Way way = Way::automatic,
                RodModel model = RodModel::reissner) {
  const scene::Equilibrium result = solve(rod, way, model);
  EXPECT_LT((tip_mm(result) - wanted_mm).norm(), limit_mm) << result.message;
  EXPECT_GT((tip_mm(solve(stiffer(rod), way, model)) - wanted_mm).norm(), limit_mm);
}

}  // namespace

TEST(ExactReference, SpatialFollowerLoad) {  // by an independent shooting, 12 digits after the point
  const scene::Scene rod =
      tip_moment(tip_force(spatial_rod, Frame::follower, {-0.5, 0.8, 0.6}), Frame::follower, {10, 20, -15});
  const Vector3d wanted(39.801266166031, 3.068161908374, 0.175073477554);
  expect_tip(rod, wanted, 5e-12, Way::initial_value);
  expect_tip(rod, wanted, 5e-12, Way::boundary_value);
}

// By an independent collocation, 4 digits after the point. Its EI = 750 is rounded: the numbers are those of the solid
// circle d = 6 mm, E = 11.789 MPa, nu = 0.5, EI = 749.98. At EI = 750 exactly the unshearable tip is
// (29.59999, 24.00873).
TEST(ExactReference, ShearAndStretch) {
  scene::Scene rod{"test", {{40, scene::CircularSection{6, 0, 11.789, 0.5, 0}, Vector3d::Zero()}}, {}};
  rod = tip_force(rod, Frame::follower, {0, 1, 0});
  for (const Way way : {Way::initial_value, Way::boundary_value}) {
    expect_tip(rod, {29.3134, 24.2739, 0}, 1e-4, way);
    expect_tip(rod, {29.5996, 24.0091, 0}, 1e-4, way, RodModel::kirchhoff);
  }
}

TEST(ExactReference, LargeFixedForce) {  // by collocation with continuation; the second to all its digits
  const scene::Scene hard = tip_force(spatial_rod, Frame::fixed, {-300, 800, 600});
  expect_tip(tip_force(spatial_rod, Frame::fixed, {-30, 80, 60}), {-4.7903, 29.7072, 22.2804}, 1e-4);
  expect_tip(hard, {-9.37405, 30.35216, 22.76412}, 1e-5);
  expect_tip(hard, {-9.374051299130803, 30.352155358521742, 22.764116518891306}, 1e-10);
  EXPECT_EQ(solve(hard).stable, true);
}

TEST(ExactReference,
     FixedForceToTenThousand) {  // |F| L^2/EI = 11 100; planar in the plane of force and axis: closed form
  scene::Scene rod = tip_force(spatial_rod, Frame::fixed, {-3000, 8000, 6000});
  const Vector3d tip = tip_mm(solve(rod));
  EXPECT_NEAR(tip[1] / tip[2], 4.0 / 3, 1e-12);
  expect_tip(rod, {-10.823555526613, 30.556114884852, 22.917086163639}, 1e-10);  // elastica.h
}

TEST(ExactReference, GravityOnInclinedClampWithTipForce) {  // independent numbers
  scene::Scene rod = uniform_rod(40, 750, 500);
  stiffness(rod) = {500, {750, 750}, 333.4, Vector2d(99.3, 99.3), 0.5};
  rod = with(tip_force(rod, Frame::fixed, {0, 0.3, 0}), scene::Gravity{{-4.905, 0, -8.495709211125342}});
  expect_tip(rod, {38.867811460874826, 8.467191410793125, -1.8168843026775487}, 1e-10);
}

TEST(ExactReference, LoadsInsideTheRodOfBothFrames) {  // independent numbers
  scene::Scene rod = uniform_rod(40, 750, 500);
  rod = with(rod, scene::Moment{25, Frame::fixed, {5, -20, 30}});
  rod = with(tip_force(rod, Frame::follower, {0.1, -0.4, 0.5}), scene::Force{15, Frame::fixed, {0, 0.8, -0.6}});
  expect_tip(rod, {31.66369736857312, 12.023970319304766, 17.752357909999734}, 1e-10);
  const scene::Equilibrium result = solve(rod);
  EXPECT_LT((result.base().force_B_N - Vector3d(0.23152179429, 0.23302229317, -0.38802373075)).norm(), 1e-10);
  EXPECT_LT((result.base().moment_B_Nmm - Vector3d(13.932159582967, -13.987020740030, 20.750076883264)).norm(), 1e-10);
  EXPECT_FALSE(result.stable.has_value());
}

TEST(ExactReference, ThreeSectionsAndAllLoads) {  // independent numbers
  scene::Scene rod = uniform_rod(15, 1, 700);
  stiffness(rod) = {700, {900, 2400}, 400, Vector2d(120, 90), 0};
  rod.sections.push_back({10, scene::Stiffness{250, {300, 300}, {}, {}, 0}, {0.01, 0.02, -0.03}});
  rod.sections.push_back({20, scene::CircularSection{2.0, 1.2, 900, 0.4, 1200}, Vector3d::Zero()});
  rod = tip_force(rod, Frame::fixed, {-0.4, 0.5, 0.3});
  rod = with(rod, scene::DistributedForce{12, 33, Frame::follower, {0, 0.01, -0.02}});
  rod = with(rod, scene::DistributedForce{20, 45, Frame::fixed, {0, -0.004, 0.003}});
  rod = with(rod, scene::Moment{30, Frame::follower, {8, -3, 5}});
  expect_tip(rod, {37.1849075800986, 18.50518725279806, 10.004018280825719}, 1e-10);
}

TEST(ExactReference, TendonBendsToACircle) {  // constant curvature T d/EI
  const double tension = 3, offset = 1.0, EI = 750, L = 40;
  const double curvature = tension * offset / EI;  // internal moment r x (-T e_x) = +T d about z, carried by the rod
  const scene::Scene rod = with(uniform_rod(L, EI, 500), scene::Tendon{{offset, 0}, tension, L});
  const double turn = curvature * L;
  const Vector3d wanted(std::sin(turn) / curvature, (1 - std::cos(turn)) / curvature, 0);
  for (const Way way : {Way::initial_value, Way::boundary_value}) {
    expect_tip(rod, wanted, 1e-11, way);
    const scene::Equilibrium result = solve(rod, way);
    EXPECT_NEAR(result.tip_angle_rad, turn, 1e-12);
    EXPECT_LT((result.base().force_B_N - Vector3d(-tension, 0, 0)).norm(), 1e-11);
    EXPECT_LT((result.base().moment_B_Nmm - Vector3d(0, 0, tension * offset)).norm(), 1e-10);
    EXPECT_EQ(result.stable, true);
  }
}

TEST(ExactReference, OpposedTendonsOnlyCompress) {
  scene::Scene rod = uniform_rod(40, 750, 500);
  stiffness(rod).axial_N = 300;
  rod = with(with(rod, scene::Tendon{{0, 1}, 3, 25}), scene::Tendon{{0, -1}, 3, 25});
  expect_tip(rod, {40 - 25 * 6 / 300.0, 0, 0}, 1e-11);
}

TEST(ExactReference, TendonUnderForceInItsPlaneEqualsAShiftOfRestCurvature) {
  // In its plane: nothing twists, the tendon does not tilt.
  const scene::Scene rod = tip_force(uniform_rod(40, 750, 500), Frame::fixed, {-0.4, 0.5, 0});
  scene::Scene bent = rod;
  bent.sections[0].rest_curvature_per_mm = {0, 0, 3.0 / 750};
  const scene::Scene pulled = with(rod, scene::Tendon{{1, 0}, 3, 40});
  expect_tip(pulled, tip_mm(solve(bent)), 1e-10);
}

TEST(ExactReference, MarchAndBoundaryValueAgreeOnMixedFollowerLoads) {
  scene::Scene rod = uniform_rod(20, 900, 500);
  stiffness(rod).shear_N = Vector2d(100, 150);
  rod.sections.push_back({25, scene::Stiffness{300, {400, 200}, 500, {}, 0}, {0.02, -0.01, 0.03}});
  rod = tip_force(with(rod, scene::Tendon{{0.5, -0.3}, 2, 30}), Frame::follower, {-0.2, 0.1, 0.4});
  rod = with(with(rod, scene::Moment{12, Frame::follower, {9, 4, -8}}),
             scene::DistributedForce{5, 40, Frame::follower, {0.001, 0.01, -0.01}});
  const scene::Equilibrium march = solve(rod, Way::initial_value), boundary = solve(rod, Way::boundary_value);
  ASSERT_TRUE(march.converged() && boundary.converged());
  ASSERT_EQ(march.stations.size(), boundary.stations.size());
  for (std::size_t k = 0; k < march.stations.size(); ++k) {
    const scene::Pose &a = march.stations[k].X_BS, &b = boundary.stations[k].X_BS;
    EXPECT_LT((a.position_B_mm - b.position_B_mm).norm(), 1e-10 * 45);
    EXPECT_LT((a.rotation_BS - b.rotation_BS).norm(), 1e-10);
  }
  EXPECT_LT((march.base().moment_B_Nmm - boundary.base().moment_B_Nmm).norm(), 1e-9);
  EXPECT_GT((tip_mm(solve(stiffer(rod))) - tip_mm(boundary)).norm(), 1e-10 * 45);
}

// Moments fixed in space alone: the march from the clamp and multiple shooting.
TEST(ExactReference, KnownMomentsMarchFromTheClamp) {
  scene::Scene rod = uniform_rod(20, 900, 500);
  stiffness(rod).shear_N = Vector2d(100, 150);
  rod.sections.push_back({25, scene::Stiffness{300, {400, 200}, 500, {}, 0}, {0.02, -0.01, 0.03}});
  rod = tip_moment(with(rod, scene::Moment{12, Frame::fixed, {30, -20, 10}}), Frame::fixed, {20, 40, -50});
  const scene::Equilibrium march = solve(rod), boundary = solve(rod, Way::boundary_value);
  ASSERT_TRUE(march.converged() && boundary.converged()) << march.message << boundary.message;
  EXPECT_EQ(std::get<std::string>(march.model[0].second), "march by CVODE from the clamp");
  ASSERT_EQ(march.stations.size(), boundary.stations.size());
  for (std::size_t k = 0; k < march.stations.size(); ++k) {
    const scene::Station &a = march.stations[k], &b = boundary.stations[k];
    EXPECT_LT((a.X_BS.position_B_mm - b.X_BS.position_B_mm).norm(), 1e-10 * 45);
    EXPECT_LT((a.X_BS.rotation_BS - b.X_BS.rotation_BS).norm(), 1e-10);
    EXPECT_LT((a.moment_B_Nmm - b.moment_B_Nmm).norm(), 1e-8);
    EXPECT_TRUE(a.force_B_N.isZero(0));
  }
  EXPECT_LT((march.base().moment_B_Nmm - Vector3d(50, 20, -40)).norm(), 1e-10);
  EXPECT_GT((tip_mm(solve(stiffer(rod))) - tip_mm(boundary)).norm(), 1e-10 * 45);
}

TEST(ExactReference, SizeAndStiffnessDoNotMatter) {  // lengths 1e-3 to 1e4 mm, stiffnesses over 12 decades
  const Vector3d wanted = tip_mm(solve(tip_force(uniform_rod(1, 1, 0.7), Frame::fixed, {-3, 8, 6})));
  for (const double L : {1e-3, 1.0, 1e4}) {
    for (const double EI : {1e-6, 1.0, 1e6}) {
      const Vector3d force = EI / L / L * Vector3d(-3, 8, 6);
      const Vector3d tip = tip_mm(solve(tip_force(uniform_rod(L, EI, 0.7 * EI), Frame::fixed, force)));
      EXPECT_LT((tip / L - wanted).norm(), 1e-12) << L << " " << EI;
    }
  }
}

TEST(ExactReference, PureCompressionStaysStraightAndSaysSo) {  // Euler load: 2.4674 EI/L^2 = 2.3132 N
  for (const double force : {2.0, 3.0, 30.0}) {
    const scene::Equilibrium result = solve(tip_force(spatial_rod, Frame::fixed, {-force, 0, 0}));
    EXPECT_LT((tip_mm(result) - Vector3d(40, 0, 0)).norm(), 1e-9) << force;
    EXPECT_EQ(result.stable, force < 2.3132);
  }
}

// A moment that winds a rod up by 100 rad, to a circle, in steps of 2.1 rad at most: 68. A cantilever takes 14, predicted
// to first order 17.
TEST(ExactReference, StepsOfSecondOrder) {
  const auto steps = [](const scene::Equilibrium& result) {
    const auto found = std::ranges::find(result.model, "load_steps", [](const auto& entry) { return entry.first; });
    return std::get<int>(found->second);
  };
  const scene::Scene rod = uniform_rod(1, 1, 1);
  const scene::Equilibrium wound = solve(tip_moment(rod, Frame::follower, {0, 0, 100}), Way::boundary_value);
  EXPECT_LT((tip_mm(wound) - Vector3d(std::sin(100.0), 1 - std::cos(100.0), 0) / 100).norm(), 1e-11) << wound.message;
  EXPECT_LT(steps(wound), 80);
  EXPECT_LT(steps(solve(tip_force(rod, Frame::fixed, {0, 30, 0}))), 16);
}

TEST(ExactReference, RefusesAndReports) {
  const scene::Scene fixed = tip_force(spatial_rod, Frame::fixed, {0, 1, 0});
  EXPECT_EQ(solve(fixed, Way::initial_value).status, scene::Status::unsupported);
  EXPECT_TRUE(solve(fixed, Way::initial_value).stations.empty());
  EXPECT_THROW(exact_reference::solve(fixed, {RodModel::reissner, 0, Way::automatic}), scene::SceneError);
  const scene::Equilibrium result = solve(fixed);
  EXPECT_GE(result.stations.size(), 41u);
  EXPECT_EQ(result.model[0].first, "solver");
}

TEST(ExactReference, FixedMomentsLeaveStabilityOpen) {  // no energy: nothing is claimed, in the plane neither
  const scene::Scene rod = tip_force(uniform_rod(40, 750, 500), Frame::fixed, {0.1, 0.2, 0});
  EXPECT_EQ(solve(rod).stable, true);
  EXPECT_FALSE(solve(tip_moment(rod, Frame::fixed, {0, 0, 10})).stable.has_value());
  EXPECT_FALSE(solve(tip_moment(rod, Frame::fixed, {3, 1, 0})).stable.has_value());
  EXPECT_FALSE(solve(tip_force(rod, Frame::follower, {0, 0.1, 0})).stable.has_value());
  EXPECT_EQ(solve(uniform_rod(40, 750, 500)).stable, true);
}
