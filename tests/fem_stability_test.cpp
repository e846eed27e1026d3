// The stability of equilibria by the finite element tangent: classical critical loads, each from both sides.
#include "fem_reference/beam_system.h"
#include "fem_reference/load_stepping.h"
#include "fem_reference/solve.h"
#include "support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace {

using Eigen::Vector3d;
using fem_reference::Options;
using fem_reference::RodModel;
using scene::Frame;

constexpr double pi = std::numbers::pi;

using support::slender;
using support::uniform_rod;

scene::Stiffness with_shear(scene::Stiffness stiffness, double axial_N, double shear_N) {
  stiffness.axial_N = axial_N;
  stiffness.shear_N = Eigen::Vector2d::Constant(shear_N);
  return stiffness;
}

scene::Equilibrium solved_with(const scene::Scene& scene, RodModel model = RodModel::reissner, int order = 2) {
  Options options;
  options.model = model;
  options.order = order;
  options.estimate_error = false;
  scene::Equilibrium found = fem_reference::solve(scene, options);
  EXPECT_TRUE(found.converged()) << scene::name(found.status) << ": " << found.message;
  if (!found.converged()) found.stations.resize(1);  // lets a failed expectation go on to the next
  return found;
}

// A column pressed along its axis, and pushed sideways.
scene::Scene column(double euler_loads, double push_N = 0) {
  const double axial_N = euler_loads * pi * pi * 750 / (4 * 40 * 40);
  return uniform_rod(40, slender(750, 500), {scene::Force{40, Frame::fixed, {-axial_N, push_N, 0}}});
}

TEST(FemStability, EulerColumn) {
  for (const int order : {1, 2, 3}) {
    for (const auto& [load, stable] : {std::pair(0.999, true), std::pair(1.001, false)}) {
      const scene::Equilibrium found = solved_with(column(load), RodModel::kirchhoff, order);
      EXPECT_EQ(found.stable, stable) << order << " " << load;
      EXPECT_LT((found.tip().position_B_mm - Vector3d(40, 0, 0)).norm(), 1e-9) << order << " " << load;
    }
  }
}

TEST(FemStability, ColumnThatStretchesAndShears) {
  // Straight, N = -P: the second variation is EI t'^2 - P (1 + P / kGA - P / EA) t^2 in the rotation t.
  const double L = 10, EI = 750, EA = 333, kGA = 99, a = 1 / kGA - 1 / EA, euler_N = pi * pi * EI / (4 * L * L);
  const double critical_N = (std::sqrt(1 + 4 * a * euler_N) - 1) / (2 * a);
  const auto pressed = [&](double factor) {
    return uniform_rod(L, with_shear(slender(EI, 500), EA, kGA),
                       {scene::Force{L, Frame::fixed, {-factor * critical_N, 0, 0}}});
  };
  EXPECT_EQ(solved_with(pressed(0.9999)).stable, true);
  EXPECT_EQ(solved_with(pressed(1.0001)).stable, false);
  // Without stretch and shear the same rod carries 12 % more.
  EXPECT_EQ(solved_with(pressed(1.0001), RodModel::kirchhoff).stable, true);
  // Full integration eliminates more forces than there are displacements.
  Options full;
  full.full_integration = true;
  full.order = 3;
  EXPECT_EQ(fem_reference::solve(pressed(0.9999), full).stable, true);
  EXPECT_EQ(fem_reference::solve(pressed(1.0001), full).stable, false);
}

TEST(FemStability, PushedColumnBuckles) {
  const scene::Equilibrium found = solved_with(column(1.05, 1e-3));
  EXPECT_GT(found.tip().position_B_mm.y(), 10);
  EXPECT_EQ(found.stable, true);
  // Pushed the other way it is the mirror image.
  const scene::Equilibrium mirrored = solved_with(column(1.05, -1e-3));
  EXPECT_NEAR(mirrored.tip().position_B_mm.y(), -found.tip().position_B_mm.y(), 1e-8);
  // Nothing tells it which way.
  const scene::Equilibrium straight = solved_with(column(1.05));
  EXPECT_LT(std::abs(straight.tip().position_B_mm.y()), 1e-9);
  EXPECT_EQ(straight.stable, false);
}

TEST(FemStability, HeavyColumn) {
  const auto heavy = [](double load) {
    const double weight_N_per_mm = load * 7.8373 * 750 / std::pow(40, 3);
    return uniform_rod(40, slender(750, 500), {scene::DistributedForce{0, 40, Frame::fixed, {-weight_N_per_mm, 0, 0}}});
  };
  EXPECT_EQ(solved_with(heavy(0.995)).stable, true);
  EXPECT_EQ(solved_with(heavy(1.005)).stable, false);
  // It hangs however heavy.
  EXPECT_EQ(solved_with(heavy(-10)).stable, true);
}

TEST(FemStability, StripBucklesSideways) {
  scene::Stiffness strip = slender(1, 1);
  strip.bending_Nmm2[0] = 1e6;
  const auto loaded = [](const scene::Stiffness& stiffness, double load) {
    return uniform_rod(1, stiffness, {scene::Force{1, Frame::fixed, {0, 0, load * 4.0126}}});
  };
  for (const scene::Stiffness& stiffness : {strip, with_shear(strip, 1e6, 1e6)}) {
    EXPECT_EQ(solved_with(loaded(stiffness, 0.99)).stable, true);
    EXPECT_EQ(solved_with(loaded(stiffness, 1.01)).stable, false);
    // Stiffer in torsion it does not buckle.
    scene::Stiffness stiffer = stiffness;
    stiffer.torsion_Nmm2 = 1.1;
    EXPECT_EQ(solved_with(loaded(stiffer, 1.01)).stable, true);
  }
}

TEST(FemStability, LargeFixedForce) {
  const auto pushed = [](const Vector3d& direction) {
    return uniform_rod(40, slender(1500, 1000), {scene::Force{40, Frame::fixed, 100 * direction}});
  };
  for (const RodModel model : {RodModel::kirchhoff, RodModel::reissner}) {
    EXPECT_EQ(solved_with(pushed({-0.3, 0.8, 0.6}), model).stable, true);
    EXPECT_EQ(solved_with(pushed({-0.3, 0, 0}), model).stable, false);  // 13 times the Euler load, straight
  }
}

TEST(FemStability, TendonsDoNotBuckleARod) {
  const scene::Tendon tendon{{1, 0.5}, 30, 40};  // 26 times the Euler load
  const scene::Stiffness stiffness = with_shear(slender(750, 500), 333, 99);
  EXPECT_EQ(solved_with(uniform_rod(40, stiffness, {tendon})).stable, true);
  EXPECT_EQ(solved_with(uniform_rod(40, stiffness, {scene::Force{40, Frame::fixed, {-30, 0, 0}}})).stable, false);
}

TEST(FemStability, OnlyConservativeLoadsAreDecided) {
  const auto loaded = [](const std::vector<scene::Load>& loads) {
    return solved_with(uniform_rod(40, slender(750, 500), loads)).stable;
  };
  const scene::Load dead = scene::Force{40, Frame::fixed, {0, 1, 0}};
  EXPECT_EQ(loaded({scene::Force{40, Frame::follower, {0, 1, 0}}}), std::nullopt);
  EXPECT_EQ(loaded({dead, scene::Force{20, Frame::follower, {0, 1, 0}}}), std::nullopt);
  EXPECT_EQ(loaded({dead, scene::Moment{20, Frame::follower, {0, 1, 0}}}), std::nullopt);
  EXPECT_EQ(loaded({dead, scene::Moment{20, Frame::fixed, {0, 1, 0}}}), std::nullopt);
  EXPECT_EQ(loaded({dead, scene::DistributedForce{0, 20, Frame::follower, {0, 0.01, 0}}}), std::nullopt);
  EXPECT_EQ(loaded({dead}), true);
  EXPECT_EQ(loaded({dead, scene::Moment{20, Frame::fixed, {0, 0, 0}}}), true);  // no load
  EXPECT_EQ(loaded({}), true);
}

// The determinant of a straight column of the stiffnesses EI_y and 4 EI_y, in units of Euler's load about y. It falls
// to zero there, linearly: at a thousandth of the load from it, it is half of what it is at two thousandths, but for
// the other factors, smooth in the load.
TEST(FemStability, TheDeterminantVanishesAtEulersLoad) {
  const auto determinant = [](double euler_loads) {
    scene::Stiffness stiffness = slender(750, 500);
    stiffness.bending_Nmm2[1] = 3000;
    const double pressed_N = euler_loads * pi * pi * 750 / (4 * 40 * 40);
    const auto model = fem_reference::beam_model(
        scene::spans_of(uniform_rod(40, stiffness, {scene::Force{40, Frame::fixed, {-pressed_N, 0, 0}}})), {50},
        fem_reference::reference_element(2, 2), true);
    fem_reference::BeamState straight = fem_reference::rest_state(model);
    for (Vector3d& force_S : straight.force_S) force_S.x() = -pressed_N / model.force_unit_N;
    fem_reference::BeamSystem system(model);
    EXPECT_LT(system.assemble(straight, 1).largest(), 1e-12);
    return system.determinant().value();
  };
  const bool stable_sign = determinant(0.998).negative;
  EXPECT_EQ(determinant(0.999).negative, stable_sign);
  EXPECT_NE(determinant(1.001).negative, stable_sign);
  EXPECT_NEAR(std::exp(determinant(0.998).log_size - determinant(0.999).log_size), 2, 0.02);
}

// No energy decides here: the push follows the tip.
TEST(FemStability, AColumnPushedByAFollowerBuckles) {
  const auto pushed = [](double push_N) {
    scene::Scene scene = column(1.05);
    scene.loads.push_back(scene::Force{40, Frame::follower, {0, push_N, 0}});
    return solved_with(scene);
  };
  const scene::Equilibrium found = pushed(1e-3);
  EXPECT_EQ(found.stable, std::nullopt);
  EXPECT_GT(found.tip().position_B_mm.y(), 10);
  EXPECT_NEAR(pushed(-1e-3).tip().position_B_mm.y(), -found.tip().position_B_mm.y(), 1e-8);
}

}  // namespace
