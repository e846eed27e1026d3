// Columns: whether a rod that its loads keep straight buckles, against formulas of others and the conjugate points of
// the boundary value problem.
#include "fam/column.h"
#include "fam/boundary_value.h"
#include "fam/solve.h"
#include "support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using fam::RodModel;
using scene::Frame;
using scene::Scene;
using support::slender;
using support::stiffer;
using support::uniform_rod;

constexpr double pi = std::numbers::pi;

std::optional<bool> is_stable(const Scene& scene, RodModel model = RodModel::kirchhoff) {
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  EXPECT_TRUE(fam::is_column(spans));
  return fam::is_stable_column(spans, model);
}

// The load that is critical, up to a share of it, at which there is no telling, and not that of a rod 5 % stiffer.
template <class ColumnUnder>
void expect_critical(ColumnUnder&& column_under, double critical, double share, RodModel model = RodModel::kirchhoff) {
  EXPECT_EQ(is_stable(column_under((1 - share) * critical), model), true);
  EXPECT_EQ(is_stable(column_under((1 + share) * critical), model), false);
  EXPECT_EQ(is_stable(column_under(critical), model), std::nullopt);
  EXPECT_EQ(is_stable(stiffer(column_under((1 + share) * critical)), model), true);
}

scene::Force pressing(double force_N, double at_mm) {
  return {at_mm, Frame::fixed, {-force_N, 0, 0}};
}

// Limit 1e-9; the formula is Euler's, pi^2 EI / 4 L^2 in the weaker plane.
TEST(Column, EulersLoad) {
  for (const int weaker : {0, 1}) {
    scene::Stiffness strip = slender(700, 50);
    strip.bending_Nmm2[1 - weaker] *= 9;
    expect_critical([&](double load_N) { return uniform_rod(50, strip, {pressing(load_N, 50)}); },
                    pi * pi * 700 / (4 * 50 * 50), 1e-9);
  }
}

// Limit 2e-3, the steps of the weight along the rod; q L^3 / EI = 7.8373 (Greenhill 1881; Timoshenko and Gere, Theory
// of Elastic Stability, section 2.12: 7.837).
TEST(Column, GreenhillsWeight) {
  const auto column = [](double load_N_per_mm) {
    return uniform_rod(80, slender(900, 600), {scene::DistributedForce{0, 80, Frame::fixed, {-load_N_per_mm, 0, 0}}});
  };
  expect_critical(column, 7.8373 * 900 / (80. * 80 * 80), 2e-3);
  EXPECT_EQ(is_stable(column(-1e3)), true);  // hanging, load length 700
}

// Limit 1e-9; tan(k1 l1) tan(k2 l2) = sqrt(EI1 / EI2), k = sqrt(P / EI) (Timoshenko and Gere, section 2.14).
TEST(Column, OfTwoSections) {
  const double l1 = 30, l2 = 45, EI1 = 2000, EI2 = 500;
  double low = 0, high = pi * pi * EI2 / (4 * l2 * l2);  // where k2 l2 = pi / 2
  for (int i = 0; i < 100; ++i) {
    const double load_N = (low + high) / 2;
    const double product = std::tan(std::sqrt(load_N / EI1) * l1) * std::tan(std::sqrt(load_N / EI2) * l2);
    (product < std::sqrt(EI1 / EI2) ? low : high) = load_N;
  }
  expect_critical(
      [&](double load_N) {
        Scene scene = uniform_rod(l1, slender(EI1, 900), {pressing(load_N, l1 + l2)});
        scene.sections.push_back({l2, slender(EI2, 900)});
        return scene;
      },
      low, 1e-9);
}

// Limit 1e-9; P (1 + P / kGA - P / EA) = pi^2 EI / 4 L^2 (Haringx 1942; with the stretch Reissner 1972).
TEST(Column, ThatShearsAndStretches) {
  for (const int weaker : {0, 1}) {
    const double shear_N = 60, axial_N = 90, euler_N = pi * pi * 4000 / (4 * 50 * 50);
    scene::Stiffness soft = slender(4000, 3000);
    soft.bending_Nmm2[1 - weaker] *= 20;
    soft.axial_N = axial_N;
    soft.shear_N = Eigen::Vector2d::Constant(9 * shear_N);
    (*soft.shear_N)[1 - weaker] = shear_N;  // bending about y moves along z
    const double c = 1 / shear_N - 1 / axial_N;
    const double critical_N = (std::sqrt(1 + 4 * c * euler_N) - 1) / (2 * c);
    ASSERT_LT(critical_N, 0.1 * shear_N);
    expect_critical([&](double load_N) { return uniform_rod(50, soft, {pressing(load_N, 50)}); }, critical_N, 1e-9,
                    RodModel::reissner);
  }
}

// Sections, forces and weights along the axis, tendons in it.
Scene random_column(std::mt19937_64& random, bool soft) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  Scene scene;
  double length_mm = 0;
  for (int sections = 1 + static_cast<int>(between(0, 4)); sections > 0; --sections) {
    scene::Stiffness stiffness = slender(std::exp(between(4, 9)), std::exp(between(4, 9)));
    stiffness.bending_Nmm2[1] *= std::exp(between(-2, 2));
    if (soft) {
      stiffness.axial_N = std::exp(between(3, 9));
      stiffness.shear_N = Eigen::Vector2d(std::exp(between(3, 8)), std::exp(between(3, 8)));
    }
    scene.sections.push_back({between(5, 60), stiffness});
    length_mm += scene.sections.back().length_mm;
  }
  const double unit_N = 600 / (length_mm * length_mm) * std::exp(between(-1.5, 2));
  for (int forces = static_cast<int>(between(0, 3)); forces > 0; --forces)
    scene.loads.push_back(pressing(unit_N * between(-1.5, 3), length_mm * between(0.2, 1)));
  scene.loads.push_back(scene::DistributedForce{
      0, length_mm * between(0.5, 1), Frame::fixed, {4 * unit_N / length_mm * between(-3, 1.5), 0, 0}});
  if (between(0, 1) < 0.3) scene.loads.push_back(scene::Tendon{{0, 0}, unit_N, length_mm});
  return scene;
}

// None of some 600 differs; fewer than a fifth of those that shear are beyond small strains.
TEST(Column, IsStableWhereTheBoundaryValueProblemHasNoConjugatePoint) {
  std::mt19937_64 random(7);
  for (const RodModel model : {RodModel::kirchhoff, RodModel::reissner}) {
    int stable = 0, unstable = 0, undecided = 0;
    for (int i = 0; i < 300; ++i) {
      SCOPED_TRACE(i);
      const Scene scene = random_column(random, model == RodModel::reissner);
      const std::optional<bool> said = is_stable(scene, model);
      const std::vector<scene::Span> spans = scene::spans_of(scene);
      const fam::GrowingLoads loads(spans);
      fam::BoundaryValue solver;
      solver.set(loads.way(), scene::cells_per_span(spans, 128), fam::Law::sixth_order, model);
      if (!said || solver.run() != scene::Status::converged) {
        ++undecided;
        continue;
      }
      EXPECT_EQ(*said, solver.stability().conjugate_points == 0);
      ++(*said ? stable : unstable);
    }
    EXPECT_GT(stable, 60);
    EXPECT_GT(unstable, 60);
    EXPECT_LT(undecided, model == RodModel::kirchhoff ? 1 : 60);
  }
}

int arcs_of(const scene::Equilibrium& result) {
  for (const auto& [name, value] : result.model) {
    if (name == "arcs") return std::get<int>(value);
  }
  return 0;
}

// One arc a section, and the verdict and tip of many. Limit: round-off.
TEST(Column, IsSolvedWithOneArcASection) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Scene scene = random_column(random, i % 2 == 1);
    const scene::Equilibrium result = fam::solve(scene);
    ASSERT_TRUE(result.converged()) << result.message;
    if (i % 2 == 0) {
      EXPECT_EQ(arcs_of(result), static_cast<int>(scene::spans_of(scene).size()));
    }
    fam::Options options;
    options.arcs = 64;
    const scene::Equilibrium many = fam::solve(scene, options);
    ASSERT_TRUE(many.converged()) << many.message;
    EXPECT_EQ(result.stable, many.stable);
    const double length_mm = scene::length_mm(scene);
    const double apart_mm = (result.tip().position_B_mm - many.tip().position_B_mm).norm();
    EXPECT_LE(apart_mm, result.error_estimate_mm + 1e-13 * length_mm);
    EXPECT_LT(result.error_estimate_mm, 1e-3 * length_mm);
  }
}

// A tolerance below round-off is not met, and said not to be. Twin: one above it is.
TEST(Column, KeepsToItsTolerance) {
  const Scene column = uniform_rod(50, slender(700, 500), {pressing(0.1, 50)});
  fam::Options options;
  options.tolerance_mm = 1e-15;
  EXPECT_EQ(fam::solve(column, options).status, scene::Status::tolerance_not_met);
  options.tolerance_mm = 1e-12;
  EXPECT_EQ(fam::solve(column, options).status, scene::Status::converged);
}

// What bends at rest, leaves the axis, twists or has no energy is no column.
TEST(Column, IsStraightWhateverItsLoads) {
  const auto is_column = [](const scene::Load& load) {
    return fam::is_column(scene::spans_of(uniform_rod(50, slender(700, 500), {pressing(0.1, 50), load})));
  };
  EXPECT_TRUE(is_column(scene::Tendon{{0, 0}, 1, 50}));
  EXPECT_FALSE(is_column(scene::Tendon{{1, 0}, 1, 50}));
  EXPECT_FALSE(is_column(scene::Force{50, Frame::fixed, {0, 1e-9, 0}}));
  EXPECT_FALSE(is_column(scene::Force{50, Frame::follower, {-0.1, 0, 0}}));
  EXPECT_FALSE(is_column(scene::Moment{50, Frame::fixed, {1, 0, 0}}));
  Scene curved = uniform_rod(50, slender(700, 500), {pressing(0.1, 50)});
  curved.sections[0].rest_curvature_per_mm = {0.01, 0, 0};
  EXPECT_FALSE(fam::is_column(scene::spans_of(curved)));
}

}  // namespace
