// Tendons in the finite elements: an independent solver, closed forms, one stable equilibrium, a tendon that collapses.
#include "fem_benchmark.h"
#include "fem_reference/load_stepping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using Eigen::Vector3d;
using fem_benchmark::bare;
using fem_benchmark::solved;
using scene::Frame;
using scene::Tendon;
using support::slender;
using support::uniform_rod;

constexpr double round_off = 1e-11;  // measured 7e-13 at most, in mm, N, N mm and rad

TEST(FemTendon, AnIndependentSolver) {
  // Of L, of the tip's rotation, of the base's own force and moment; with 200 elements. Measured 1.5e-11.
  const double limit = 3e-11;
  const auto benchmarks = fem_benchmark::read_benchmarks("14_tendons.json");
  ASSERT_EQ(benchmarks.size(), 2U);
  for (const fem_benchmark::Benchmark& exact : benchmarks) {
    EXPECT_LT(fem_benchmark::error(solved(exact.scene, bare(200)), exact), limit) << exact.scene.title;
    const scene::Equilibrium twin = solved(support::stiffer(exact.scene), bare(200));
    EXPECT_GT((twin.tip().position_B_mm - exact.tip.X_BS.position_B_mm).norm(), 5e-3) << exact.scene.title;
  }
}

// Two tendons above and below the axis and a torque about it: GJ u_x + 2 T r^2 u_x / sqrt(1 + r^2 u_x^2) = M.
TEST(FemTendon, TheTiltUnderTorsionStiffensTheRod) {
  const double T = 5, r = 3, GJ = 500, M = 20, L = 40;
  double twist_per_mm = M / GJ;
  for (int i = 0; i < 100; ++i) twist_per_mm = M / (GJ + 2 * T * r * r / std::hypot(1, r * twist_per_mm));
  ASSERT_NEAR(twist_per_mm, 0.0339249, 5e-8);  // without the tilt 0.04
  const auto twisted = [&](double stiffer) {
    const scene::Scene scene =
        uniform_rod(L, slender(750, GJ),
                    {Tendon{{r, 0}, T, L}, Tendon{{-r, 0}, T, L}, scene::Moment{L, Frame::follower, {M, 0, 0}}});
    return solved(support::stiffer(scene, stiffer));
  };
  const scene::Equilibrium found = twisted(1);
  const auto angle = [](const scene::Equilibrium& rod) {
    return fem_benchmark::turn(Eigen::Matrix3d::Identity(), rod.tip().rotation_BS);
  };
  EXPECT_NEAR(angle(found).x(), twist_per_mm * L, 1e-8);  // measured 5.0e-9
  EXPECT_GT(std::abs(angle(twisted(1.05)).x() - twist_per_mm * L), 1e-2);
  EXPECT_LT((found.tip().position_B_mm - Vector3d(L, 0, 0)).norm(), round_off);
  const double tilt = std::hypot(1, r * twist_per_mm);
  for (const scene::Station& station : found.stations) {
    EXPECT_NEAR(station.force_B_N.x(), -2 * T / tilt, 8.1e-10);        // measured 4.1e-10
    EXPECT_NEAR(station.moment_B_Nmm.x(), GJ * twist_per_mm, 1.3e-7);  // 6.7e-8
  }
  // Both tendons are drawn into the rod.
  ASSERT_EQ(found.tendon_shortening_mm.size(), 2U);
  for (const double shortening_mm : found.tendon_shortening_mm)
    EXPECT_NEAR(shortening_mm, L * (1 - tilt), 3e-9);  // 1.5e-9
}

// In the section frame the tendon's part carries a constant force and moment: an arc. Beyond its end the rod is
// straight.
TEST(FemTendon, BendsItsPartOfTheRodIntoAnArc) {
  const double T = 8, y = 1.5, EI = 1500, EA = 500, bent_mm = 30, rest_mm = 10;
  const auto pulled = [&](double stiffer) {
    const scene::Scene scene = [&] {
      scene::Stiffness stiffness = slender(EI, 1000);
      stiffness.axial_N = EA;
      stiffness.shear_N = Eigen::Vector2d::Constant(150);
      return uniform_rod(40, stiffness, {Tendon{{y, 0}, T, bent_mm}, Tendon{{-2, 0}, 0, 40}});
    }();
    return solved(support::stiffer(scene, stiffer), bare(100));
  };
  const double kappa = y * T / EI, stretch = 1 - T / EA, angle = kappa * bent_mm;
  const Vector3d exact(stretch * std::sin(angle) / kappa + rest_mm * std::cos(angle),
                       stretch * (1 - std::cos(angle)) / kappa + rest_mm * std::sin(angle), 0);
  const scene::Equilibrium found = pulled(1);
  EXPECT_LT((found.tip().position_B_mm - exact).norm(), round_off);
  EXPECT_GT((pulled(1.05).tip().position_B_mm - exact).norm(), 0.1);
  for (const scene::Station& station : found.stations) {
    const Eigen::Matrix3d& R = station.X_BS.rotation_BS;
    // At the tendon's end the side towards the clamp counts.
    const double carried = station.s_mm <= bent_mm ? 1 : 0;
    EXPECT_LT((station.force_B_N - R * Vector3d(-carried * T, 0, 0)).norm(), round_off) << station.s_mm;
    EXPECT_LT((station.moment_B_Nmm - Vector3d(0, 0, carried * y * T)).norm(), round_off) << station.s_mm;
  }
  // The second one is slack and reported all the same.
  ASSERT_EQ(found.tendon_shortening_mm.size(), 2U);
  EXPECT_NEAR(found.tendon_shortening_mm[0], bent_mm * (1 - (stretch - kappa * y)), round_off);
  EXPECT_NEAR(found.tendon_shortening_mm[1], 40 - bent_mm * (stretch + 2 * kappa) - rest_mm, round_off);
}

scene::Scene coiled_with_tendons() {
  scene::Scene scene =
      uniform_rod(40, slender(750, 500), {Tendon{{2, 0}, 6, 40}, Tendon{{-1, 1.5}, 4, 30}, Tendon{{-1, -1.5}, 9, 40}});
  scene.sections[0].rest_curvature_per_mm = {0.04, 0.02, -0.03};
  return scene;
}

// T |t| and the elastic energy are convex in the strains: under tendons alone one equilibrium, and stable.
TEST(FemTendon, AloneTheyLeaveOneStableEquilibrium) {
  const scene::Equilibrium usual = solved(coiled_with_tendons());
  EXPECT_EQ(usual.stable, true);
  for (const double first_step : {0.01, 0.1, 1.0}) {
    fem_reference::Options options = bare();
    options.initial_load_step = first_step;
    options.largest_rotation_rad = first_step < 1 ? 0.3 : 3;
    EXPECT_LT((solved(coiled_with_tendons(), options).tip().position_B_mm - usual.tip().position_B_mm).norm(),
              round_off);
  }
}

// A force bends the rod far away first, and is taken off again while the tendons pull.
TEST(FemTendon, AnotherPathLeadsToTheSameState) {
  const auto model_with = [](const Vector3d& force_N) {
    scene::Scene scene = coiled_with_tendons();
    scene.loads.push_back(scene::Force{40, Frame::fixed, force_N});
    return fem_reference::beam_model(scene::spans_of(scene), {38, 12}, fem_reference::reference_element(2, 2), true);
  };
  const auto straight_to_it = fem_reference::step_to_full_load(model_with(Vector3d::Zero()), {});
  ASSERT_EQ(straight_to_it.status, scene::Status::converged);
  for (const Vector3d& force_N : {Vector3d(3, 0, 0), Vector3d(1, -2, 1), Vector3d(0.5, 0, 3)}) {
    fem_reference::BeamState state = fem_reference::step_to_full_load(model_with(force_N), {}).state;
    EXPECT_GT(fem_reference::largest_rotation(straight_to_it.state, state), 0.3);
    for (int k = 19; k >= 0; --k) {
      const fem_reference::BeamModel model = model_with(k / 20.0 * force_N);
      fem_reference::BeamSystem system(model);
      fem_reference::BeamIncrement increment;
      for (int i = 0; i < 10; ++i) {
        system.assemble(state, 1);
        ASSERT_TRUE(system.newton_increment(increment));
        fem_reference::advance(state, increment);
      }
    }
    EXPECT_LT(fem_reference::largest_rotation(straight_to_it.state, state), round_off);
  }
}

TEST(FemTendon, ACollapsingTendonHasAStatus) {
  // The rod rolls up around the tendon: u y = T y^2 / EI reaches 1 at T = 2.5, where the path has no length.
  const auto rolled = [](double T) {
    return fem_reference::solve(uniform_rod(40, slender(10, 10), {Tendon{{2, 0}, T, 40}}), bare(60));
  };
  EXPECT_TRUE(rolled(2.4).converged());
  const scene::Equilibrium found = rolled(2.6);
  EXPECT_EQ(found.status, scene::Status::tendon_collapsed) << found.message;
  EXPECT_TRUE(found.stations.empty());
  EXPECT_NE(found.message.find("load factor 0.96"), std::string::npos) << found.message;

  // A moment bends the rod beyond it, however small the tension.
  const scene::Equilibrium bent_beyond = fem_reference::solve(
      uniform_rod(40, slender(10, 10), {Tendon{{2, 0}, 1e-3, 40}, scene::Moment{40, Frame::follower, {0, 0, 6}}}),
      bare());
  EXPECT_EQ(bent_beyond.status, scene::Status::tendon_collapsed) << bent_beyond.message;

  // Pressed to nothing along the axis: T = EA.
  scene::Stiffness soft = slender(750, 500);
  soft.axial_N = 100;
  const scene::Equilibrium pressed = fem_reference::solve(uniform_rod(40, soft, {Tendon{{0, 0}, 101, 40}}), bare());
  EXPECT_EQ(pressed.status, scene::Status::tendon_collapsed) << pressed.message;

  // At rest already.
  scene::Scene bent = uniform_rod(40, slender(750, 500), {Tendon{{20, 0}, 1e-3, 40}});
  bent.sections[0].rest_curvature_per_mm = {0, 0, 0.05};
  EXPECT_EQ(fem_reference::solve(bent, bare()).status, scene::Status::tendon_collapsed);
}

}  // namespace
