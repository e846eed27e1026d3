// What must hold of the number of arcs: P4 against the elastica in closed form, S1 against CVODE; and that the
// ablation's law without weakness is the library's.
#include "exact_reference/elastica.h"
#include "exact_reference/solve.h"

#include "studies/segmentation/ablation.h"
#include "support.h"
#include "support_fam.h"
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace {

using Eigen::Vector3d;
using fam::Law;

constexpr double length_mm = 40;

fam::Options with(Law law, int arcs) {
  fam::Options options;
  options.law = law;
  options.arcs = arcs;
  options.model = fam::RodModel::kirchhoff;
  options.estimate_error = false;
  return options;
}

Vector3d tip_mm(const scene::Scene& scene, const fam::Options& options) {
  fam::Solver solver = support::kept(scene, options);
  solver.solve();
  return solver.tip().position_B_mm;
}

// P4's tip error over L; the closed form is good to 1e-13 L.
double p4_error(Law law, int arcs, double stiffness_factor = 1) {
  const exact_reference::Elastica exact =
      exact_reference::Elastica::with_follower_load({length_mm, 750, {0, -1.5}, 60});
  const Eigen::Vector2d reference = exact.tip().position_B_mm;
  const scene::Scene scene = support::stiffer(support::study1_scene("P4", "follower"), stiffness_factor);
  return (tip_mm(scene, with(law, arcs)) - Vector3d(reference[0], reference[1], 0)).norm() / length_mm;
}

// True where the published law's error falls from each N to the next by (N1/N2)^2 within 5 %, from N = 2 to 5000,
// once it is in its asymptotic range (N >= 4), and falls at all before.
bool falls_in_second_order(double stiffness_factor) {
  int last_arcs = 0;
  double last = 0;
  for (const int arcs : {2, 3, 4, 6, 8, 12, 20, 50, 100, 200, 500, 1000, 2000, 5000}) {
    const double error = p4_error(Law::published, arcs, stiffness_factor);
    const double square = std::pow(static_cast<double>(last_arcs) / arcs, 2);
    if (last_arcs > 0 && error >= last) return false;
    if (last_arcs >= 4 && std::abs(error / (last * square) - 1) > 0.05) return false;
    last_arcs = arcs;
    last = error;
  }
  return true;
}

TEST(Segmentation, PublishedLawFallsInSecondOrder) {
  EXPECT_TRUE(falls_in_second_order(1));
  EXPECT_FALSE(falls_in_second_order(1.05));
}

// Where discretisation has fallen away, what is left grows no faster than 1e-15 N.
TEST(Segmentation, PublishedLawEndsInRoundOff) {
  const double discretisation = p4_error(Law::published, 5000) * 5000. * 5000.;
  for (const int arcs : {10'000, 100'000, 1'000'000}) {
    const double allowed = discretisation / arcs / arcs * 1.01 + 1e-15 * arcs;
    EXPECT_LT(p4_error(Law::published, arcs), allowed) << arcs;
    EXPECT_GT(p4_error(Law::published, arcs, 1.05), allowed) << arcs;
  }
}

TEST(Segmentation, FourthOrderReachesRoundOffAndStays) {
  EXPECT_GT(p4_error(Law::fourth_order, 100), 1e-11);
  EXPECT_LT(p4_error(Law::fourth_order, 500), 1e-11);
  for (const int arcs : {1000, 10'000, 100'000, 1'000'000}) {
    EXPECT_LT(p4_error(Law::fourth_order, arcs), 1e-10) << arcs;
    EXPECT_GT(p4_error(Law::fourth_order, arcs, 1.05), 1e-10) << arcs;
  }
}

double s1_order(Law law, int arcs = 48) {
  scene::Scene scene = support::study1_scene("S1", "follower");
  scene.loads.push_back(scene::Moment{length_mm, scene::Frame::follower, {50, 0, 0}});
  exact_reference::Options options;
  options.model = exact_reference::RodModel::kirchhoff;
  const Vector3d exact = exact_reference::solve(scene, options).tip().position_B_mm;
  const auto error = [&](int n) { return (tip_mm(scene, with(law, n)) - exact).norm(); };
  return std::log2(error(arcs) / error(2 * arcs));
}

// The twin of the first order in space is the second order of the same law in the plane.
TEST(Segmentation, DecoupledArcsAreFirstOrderInSpace) {
  EXPECT_NEAR(s1_order(Law::published), 1, 0.05);
  EXPECT_NEAR(std::log2(p4_error(Law::published, 48) / p4_error(Law::published, 96)), 2, 0.05);
  EXPECT_NEAR(s1_order(Law::midpoint), 2, 0.05);
  EXPECT_NEAR(s1_order(Law::fourth_order), 4, 0.05);
  EXPECT_NEAR(s1_order(Law::sixth_order, 6), 6, 0.1);  // more arcs end in round-off
}

const exact_reference::PlanarCantilever p4_rod{length_mm, 750, {0, -1.5}, 60};

TEST(Ablation, WithoutWeaknessIsTheLibrarysLaw) {
  const scene::Scene p4 = support::study1_scene("P4", "follower");
  for (const int arcs : {1, 12, 500}) {
    const Vector3d library = tip_mm(p4, with(Law::published, arcs));
    const auto distance = [&](const studies::Weakness& weakness) {
      return (studies::weakened_tip_mm(p4_rod, weakness, arcs) - library.head<2>()).norm();
    };
    const double limit_mm = 1e-9;  // the section's EI is 750 to 13 digits
    EXPECT_LT(distance({}), limit_mm) << arcs;
    EXPECT_GT(distance({.single_precision = true}), limit_mm) << arcs;
    EXPECT_GT(distance({.search = studies::Search::golden, .tolerance = 1e-3}), limit_mm) << arcs;
    EXPECT_GT(distance({.straight_in_arc = true}), limit_mm) << arcs;
  }
}

// The finding that the page tells: a bracket stopped at an absolute tolerance rises, a secant root does not.
TEST(Ablation, OnlyABracketWithAnAbsoluteToleranceRises) {
  const auto change_mm = [](const studies::Weakness& weakness, int arcs) {
    return (studies::weakened_tip_mm(p4_rod, weakness, arcs) - studies::weakened_tip_mm(p4_rod, {}, arcs)).norm();
  };
  const studies::Weakness bracket{.search = studies::Search::golden, .tolerance = 1e-3}, secant{.tolerance = 1e-3};
  EXPECT_GT(change_mm(bracket, 5000), 1);
  EXPECT_LT(change_mm(bracket, 12), 0.1);
  EXPECT_LT(change_mm(secant, 5000), 1e-6);
}

// What the page of the ablation says of the variants in words.
TEST(Ablation, TrendsAreAsThePageSays) {
  const studies::AblationData data = studies::run_ablation(p4_rod, {16.0746, 28.5220});
  for (const studies::AblationRow& row : data.rows) {
    const studies::Trend t = studies::trend(row, &studies::AblationPoint::error_mm);
    const studies::Weakness& w = row.weakness;
    const bool fast = w.search == studies::Search::root || w.search == studies::Search::brent;
    const bool tight = w.tolerance == 0 || fast || w.radius_unknown;
    if (!w.single_precision && tight) {
      EXPECT_FALSE(t.rises()) << row.name;
    }
    if (!tight && w.tolerance >= 1e-5 && !w.straight_to_next) {
      EXPECT_TRUE(t.rises()) << row.name;
    }
    if (w.single_precision && w.tolerance == 0) {
      EXPECT_LT(t.at_5000_mm, 0.1) << row.name;
    }
  }
  EXPECT_TRUE(studies::trend(data.row("single precision"), &studies::AblationPoint::error_mm).rises());
}

}  // namespace
