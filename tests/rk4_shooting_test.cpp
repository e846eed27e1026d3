// The competitor "plain shooting" against the exact rod and closed forms of rods with tendons: right, of fourth order,
// without allocation, honest.
#include "studies/methods/rk4_shooting.h"
#include "allocation_counter.h"
#include "exact_reference/solve.h"
#include "studies/methods/rk4_method.h"
#include "support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using Eigen::Vector3d;
using scene::Frame;

Vector3d tip_mm(const scene::Scene& scene, int steps, bool with_shear) {
  const scene::Equilibrium result = studies::rk4_method({steps, with_shear})->solve(scene);
  EXPECT_TRUE(result.converged()) << scene.title << " " << result.message;
  return result.converged() ? result.tip().position_B_mm : Vector3d(NAN, NAN, NAN);
}

Vector3d exact_tip_mm(const scene::Scene& scene, bool with_shear) {
  exact_reference::Options options;
  if (!with_shear) options.model = exact_reference::RodModel::kirchhoff;
  return exact_reference::solve(scene, options).tip().position_B_mm;
}

double error_mm(const scene::Scene& scene, int steps, bool with_shear) {
  return (tip_mm(scene, steps, with_shear) - exact_tip_mm(scene, with_shear)).norm();
}

// Gate: 64 steps within 1e-4 mm of the exact rod; a rod stiffer by 5 % is not.
TEST(Rk4Shooting, AgreesWithTheExactRod) {
  for (const auto& [load_case, frame] : {std::pair{"S4", "follower"}, {"P2", "fixed"}}) {
    const scene::Scene scene = support::study1_scene(load_case, frame);
    for (const bool with_shear : {true, false}) {
      const Vector3d exact_mm = exact_tip_mm(scene, with_shear);
      EXPECT_LT((tip_mm(scene, 64, with_shear) - exact_mm).norm(), 1e-4) << load_case;
      EXPECT_GT((tip_mm(support::stiffer(scene), 64, with_shear) - exact_mm).norm(), 1e-4) << load_case;
    }
  }
}

TEST(Rk4Shooting, IsOfFourthOrder) {
  for (const auto& [load_case, frame] : {std::pair{"S4", "follower"}, {"P2", "fixed"}}) {
    const scene::Scene scene = support::study1_scene(load_case, frame);
    for (const bool with_shear : {true, false}) {
      const double order = std::log2(error_mm(scene, 16, with_shear) / error_mm(scene, 32, with_shear));
      EXPECT_NEAR(order, 4, 0.35) << load_case << " " << with_shear;
    }
  }
}

// Two sections, a point load inside, distributed forces in both frames, gravity, rest curvature.
TEST(Rk4Shooting, TakesSectionsAndDistributedLoads) {
  scene::Scene scene = support::uniform_rod(40, support::slender(1500, 1000), {});
  scene.sections.push_back(scene.sections[0]);
  scene::Stiffness soft{600, {800, 900}, 5e3, Eigen::Vector2d{1e3, 2e3}, 0.05};
  scene.sections[1].cross_section = soft;
  scene.sections[1].rest_curvature_per_mm = {0.002, -0.003, 0.004};
  scene.loads = {scene::Force{25, Frame::follower, {0.1, 0.2, -0.1}}, scene::Moment{80, Frame::fixed, {3, -5, 4}},
                 scene::DistributedForce{10, 60, Frame::follower, {0, 0.002, 0.001}},
                 scene::DistributedForce{30, 80, Frame::fixed, {0.001, 0, 0.003}}, scene::Gravity{{0, -9.81, 0}}};
  const scene::Equilibrium ours = studies::rk4_method({200, true})->solve(scene);
  const scene::Equilibrium exact = exact_reference::solve(scene);
  ASSERT_TRUE(ours.converged() && exact.converged());
  EXPECT_LT((ours.tip().position_B_mm - exact.tip().position_B_mm).norm(), 1e-6);
  EXPECT_LT((ours.base().force_B_N - exact.base().force_B_N).norm(), 1e-7);
  EXPECT_LT((ours.base().moment_B_Nmm - exact.base().moment_B_Nmm).norm(), 1e-6);
}

// A tendon alone on a rod that neither stretches nor twists bends it to an arc of curvature T y/EI, under -T and T y.
TEST(Rk4Shooting, BendsToAnArcUnderATendon) {
  const double L = 60, EI = 900, y = 2, T = 8, curvature = T * y / EI;
  const scene::Scene scene = support::uniform_rod(L, support::slender(EI, 600), {scene::Tendon{{y, 0}, T, L}});
  const Vector3d arc_mm(std::sin(curvature * L) / curvature, (1 - std::cos(curvature * L)) / curvature, 0);
  EXPECT_LT((tip_mm(scene, 64, false) - arc_mm).norm(), 1e-6);
  EXPECT_GT((tip_mm(support::stiffer(scene), 64, false) - arc_mm).norm(), 1e-6);
  const scene::Equilibrium result = studies::rk4_method({64, false})->solve(scene);
  for (const scene::Station& station : result.stations) {  // the rod's own, up to the tendon's end
    EXPECT_LT((station.force_B_N + T * station.X_BS.rotation_BS.col(0)).norm(), 1e-12);
    EXPECT_LT((station.moment_B_Nmm - Vector3d(0, 0, T * y)).norm(), 1e-12);
  }
}

// Two tendons on either side tilt as the rod twists: GJ u + 2 T r^2 u/sqrt(1 + r^2 u^2) = M.
TEST(Rk4Shooting, TwistsATiltingPairOfTendons) {
  const double L = 40, GJ = 500, T = 5, r = 3, M = 20;
  const auto twist_rad = [&](double tilted_tension_N) {
    double u = 0;
    for (int i = 0; i < 200; ++i) u = M / (GJ + 2 * tilted_tension_N * r * r / std::sqrt(1 + r * r * u * u));
    return u * L;
  };
  const scene::Scene scene = support::uniform_rod(
      L, support::slender(750, GJ),
      {scene::Tendon{{r, 0}, T, L}, scene::Tendon{{-r, 0}, T, L}, scene::Moment{L, Frame::follower, {M, 0, 0}}});
  const auto angle_rad = [](const scene::Scene& rod) {
    return studies::rk4_method({64, false})->solve(rod).tip_angle_rad;
  };
  EXPECT_NEAR(angle_rad(scene), twist_rad(T), 1e-8);
  EXPECT_GT(std::abs(angle_rad(support::stiffer(scene)) - twist_rad(T)), 1e-8);
  EXPECT_GT(std::abs(twist_rad(0) - twist_rad(T)), 0.1);  // the tilt weighs
}

// Three tendons, two of which end on the way, on two sections that twist, shear and stretch, one of them curved, under
// every other kind of load.
scene::Scene arm_with_tendons() {
  scene::Scene scene = support::uniform_rod(40, support::slender(1500, 1000), {});
  scene.sections.push_back(scene.sections[0]);
  scene.sections[1].cross_section = scene::Stiffness{600, {800, 900}, 5e3, Eigen::Vector2d{1e3, 2e3}, 0.05};
  scene.sections[1].rest_curvature_per_mm = {0.002, -0.003, 0.004};
  scene.loads = {scene::Tendon{{3, 0}, 4, 80},
                 scene::Tendon{{-1.5, 2.6}, 6, 55},
                 scene::Tendon{{-1.5, -2.6}, 2, 30},
                 scene::Force{25, Frame::follower, {0.1, 0.2, -0.1}},
                 scene::Force{80, Frame::fixed, {0, -0.1, 0.1}, {2, 1}},
                 scene::Moment{80, Frame::fixed, {3, -5, 4}},
                 scene::DistributedForce{10, 60, Frame::follower, {0, 0.002, 0.001}},
                 scene::Gravity{{0, -9.81, 0}}};
  return scene;
}

// Own force and moment at the clamp and where the second tendon ends, tip.
double mismatch(const scene::Equilibrium& ours, const scene::Equilibrium& exact) {
  const auto at_end = [](const scene::Equilibrium& result) {
    return *std::find_if(result.stations.begin(), result.stations.end(),
                         [](const scene::Station& station) { return std::abs(station.s_mm - 55) < 1e-9; });
  };
  double largest = (ours.tip().position_B_mm - exact.tip().position_B_mm).norm();
  for (const auto& [a, b] : {std::pair{ours.base(), exact.base()}, {at_end(ours), at_end(exact)}}) {
    largest = std::max({largest, (a.force_B_N - b.force_B_N).norm(), (a.moment_B_Nmm - b.moment_B_Nmm).norm()});
  }
  return largest;
}

TEST(Rk4Shooting, TakesTendonsWithEveryOtherLoad) {
  const scene::Scene scene = arm_with_tendons();
  const scene::Equilibrium exact = exact_reference::solve(scene);
  const auto method = studies::rk4_method({200, true});
  ASSERT_TRUE(method->solve(scene).converged() && exact.converged());
  EXPECT_LT(mismatch(method->solve(scene), exact), 1e-6);
  EXPECT_GT(mismatch(method->solve(support::stiffer(scene)), exact), 1e-6);
  for (const bool with_shear : {true, false}) {
    EXPECT_NEAR(std::log2(error_mm(scene, 40, with_shear) / error_mm(scene, 80, with_shear)), 4, 0.35) << with_shear;
  }
}

TEST(Rk4Shooting, DoesNotAllocateWhileSolving) {
  for (const scene::Scene& scene : {support::study1_scene("S4", "fixed"), arm_with_tendons()}) {
    const std::vector<scene::Span> spans = scene::spans_of(scene);
    for (const bool with_shear : {true, false}) {
      studies::Rk4Shooting solver(spans, scene::cells_per_span(spans, 50), with_shear);
      const std::size_t before = allocation_count();
      EXPECT_EQ(solver.run(), scene::Status::converged);
      EXPECT_EQ(allocation_count(), before);
    }
  }
}

TEST(Rk4Shooting, SaysWhereItIsLost) {
  const double EI = 750;
  for (const scene::Load& load :
       {scene::Load(scene::Force{40, Frame::fixed, {0, 1000 * EI / 1600, 0}}),  // |F| L^2/EI = 1000
        scene::Load(scene::Tendon{{2, 0}, 1.01 * EI / 4, 40})}) {               // its path has no length left
    const scene::Equilibrium lost =
        studies::rk4_method({50, true})->solve(support::uniform_rod(40, support::slender(EI, 500), {load}));
    EXPECT_FALSE(lost.converged());
    EXPECT_TRUE(lost.stations.empty());
    EXPECT_FALSE(lost.message.empty());
  }
}

// A warm start ends where the cold one does, in fewer iterations.
TEST(Rk4Shooting, StartsFromASolution) {
  const std::vector<scene::Span> spans = scene::spans_of(support::study1_scene("S4", "fixed"));
  studies::Rk4Shooting solver(spans, scene::cells_per_span(spans, 50), true);
  ASSERT_EQ(solver.run(), scene::Status::converged);
  const int cold = solver.iterations();
  const studies::Rk4Shooting::Vector6d solution = solver.base_wrench();
  ASSERT_EQ(solver.run(1.01 * solution), scene::Status::converged);
  EXPECT_LT(solver.iterations(), cold);
  EXPECT_LT((solver.base_wrench() - solution).norm(), 1e-8);
}

}  // namespace
