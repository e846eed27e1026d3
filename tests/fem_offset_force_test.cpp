// Forces off the centreline in the finite elements: an independent solver, forces that cancel, critical loads.
#include "fem_benchmark.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using fem_benchmark::bare;
using fem_benchmark::solved;
using scene::Force;
using scene::Frame;
using support::slender;
using support::uniform_rod;

TEST(FemOffsetForce, AnIndependentSolver) {
  // Of L, of the tip's rotation, of the base's force and moment; with 200 elements. Measured 1.7e-11.
  const double limit = 3.4e-11;
  const auto benchmarks = fem_benchmark::read_benchmarks("15_offset_forces.json");
  ASSERT_EQ(benchmarks.size(), 2U);
  for (const fem_benchmark::Benchmark& exact : benchmarks) {
    EXPECT_LT(fem_benchmark::error(solved(exact.scene, bare(200)), exact), limit) << exact.scene.title;
    const scene::Equilibrium twin = solved(support::stiffer(exact.scene), bare(200));
    EXPECT_GT((twin.tip().position_B_mm - exact.tip.X_BS.position_B_mm).norm(), 5e-3) << exact.scene.title;
  }
}

// A pair of opposite fixed forces at opposite arms along y. No force is left of it.
scene::Scene pair(double at_mm, const Vector3d& force_N, double arm_mm, double torsion_Nmm2 = 500) {
  return uniform_rod(40, slender(750, torsion_Nmm2),
                     {Force{at_mm, Frame::fixed, force_N, Vector2d(arm_mm, 0)},
                      Force{at_mm, Frame::fixed, -force_N, Vector2d(-arm_mm, 0)}});
}

TEST(FemOffsetForce, ACoupleOfFixedForcesLosesItsArmAsTheRodTurns) {
  // GJ phi / l = 2 a P cos(phi) at l = 40 and 25.
  const double a = 3, P = 4, GJ = 500;
  for (const double at_mm : {40.0, 25.0}) {
    double phi = 1;
    for (int i = 0; i < 50; ++i) {
      phi -= (GJ * phi / at_mm - 2 * a * P * std::cos(phi)) / (GJ / at_mm + 2 * a * P * std::sin(phi));
    }
    const auto twist = [&](double stiffer) {
      const scene::Equilibrium found = solved(support::stiffer(pair(at_mm, {0, 0, P}, a), stiffer));
      EXPECT_LT((found.tip().position_B_mm - Vector3d(40, 0, 0)).norm(), 1e-11);
      EXPECT_EQ(found.stable, true);
      return fem_benchmark::turn(Eigen::Matrix3d::Identity(), found.tip().rotation_BS).x();
    };
    EXPECT_NEAR(twist(1), phi, 2.2e-10);  // measured 1.1e-10
    EXPECT_GT(std::abs(twist(1.05) - phi), 1e-3);
  }
}

// Pressed together across the section, the pair has neither force nor moment, and its energy 2 a P cos(phi) turns the
// section over at 2 a P = GJ / l: the least stiffness of its turns, as EI > GJ.
TEST(FemOffsetForce, APairPressedTogetherTurnsTheSectionOver) {
  const double a = 2;
  for (const double at_mm : {40.0, 25.0}) {
    const double critical_N = 500 / at_mm / (2 * a);
    const auto stable = [&](double factor, double torsion_Nmm2) {
      return solved(pair(at_mm, {0, -factor * critical_N, 0}, a, torsion_Nmm2)).stable;
    };
    EXPECT_EQ(stable(0.999, 500), true) << at_mm;
    EXPECT_EQ(stable(1.001, 500), false) << at_mm;
    EXPECT_EQ(stable(1.001, 525), true) << at_mm;
    EXPECT_EQ(stable(-20, 500), true) << at_mm;  // pulled apart
  }
}

TEST(FemOffsetForce, AnEccentricFixedForceIsConservativeAndAFollowerIsNot) {
  const auto loaded = [](Frame frame) {
    return solved(uniform_rod(40, slender(750, 500), {Force{40, frame, {-0.3, 0.2, 0.1}, Vector2d(2, 1)}}));
  };
  EXPECT_EQ(loaded(Frame::fixed).stable, true);
  EXPECT_EQ(loaded(Frame::follower).stable, std::nullopt);
}

}  // namespace
