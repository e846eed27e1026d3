// Branches of equilibrium paths that lead from one branch point to another, and the number of unstable directions of
// rods that are bent far round.
#include "support.h"

#include "fam/path.h"
#include "fam/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using scene::PathPoint;
using Kind = PathPoint::Kind;

// Two turns of rest curvature in a plane, pulled straight by the tip.
scene::PathRequest coil() {
  scene::PathRequest request;
  request.scene = support::uniform_rod(100, support::slender(1000, 1000 / 1.3),
                                       {scene::Force{100, scene::Frame::fixed, {1, 0, 0}}});
  request.scene.sections[0].rest_curvature_per_mm = {0, 0, 4 * std::numbers::pi / 100};
  request.to = 40;
  return request;
}

std::vector<PathPoint> critical_points(const scene::Path& path, int branch) {
  std::vector<PathPoint> found;
  for (const PathPoint& point : path.points) {
    if (point.branch == branch && point.multiplicity > 0) found.push_back(point);
  }
  return found;
}

// Without loads every rod is stable: no energy is below that of its rest shape. Its arcs turn by 1.8 rad each.
TEST(PathIndex, AnUnloadedCoilIsStable) {
  const fam::Path path = fam::Path::follow(coil());
  EXPECT_EQ(path.points().points.front().index, 0);
  EXPECT_EQ(path.points().points.front().stable, true);
}

// Where its first branch leaves the plane and comes back into it, beyond which it is its own mirror image; the two
// planar equilibria are others, so both points count once, and the branch ends where it began.
TEST(PathBranches, EndWhereTheyBegan) {
  scene::PathRequest request = coil();
  request.branches = 1;
  const fam::Path path = fam::Path::follow(request);
  EXPECT_EQ(path.points().status, scene::PathStatus::reached);
  const std::vector<PathPoint> met = critical_points(path.points(), 1);
  ASSERT_EQ(met.size(), 3u);
  EXPECT_EQ(met[0].kind, Kind::start);
  EXPECT_EQ(met[1].kind, Kind::branch);
  EXPECT_EQ(met[2].kind, Kind::end);
  EXPECT_NEAR(met[2].parameter, met[0].parameter, 1e-6);  // measured 1e-8
  for (const PathPoint& point : met) EXPECT_NEAR(point.tip_position_B_mm[2], 0, 1e-2);
  EXPECT_LT(path.points().points.size(), 200u);  // measured 127
}

// A bent finger under thrust, pulled over by its tendon. In the mirror the rest curvature k0 and the tension T change
// their signs, and EI k0 and T times its arm act alike: both folds lie as far from T = EI k0 / arm, whatever the arcs.
double middle_of_folds_N(const scene::Scene& rod, int arcs) {
  scene::PathRequest request;
  request.scene = rod;
  request.parameter = scene::PathParameter::value;
  request.loads = {1};
  request.to = 6;
  fam::Options options;
  options.arcs = arcs;
  std::vector<double> folds;
  const fam::Path path = fam::Path::follow(request, options);
  for (const PathPoint& point : critical_points(path.points(), 0)) folds.push_back(point.parameter);
  return folds.size() == 2 ? (folds[0] + folds[1]) / 2 : std::nan("");
}

TEST(PathBranches, FoldsThatMirrorEachOther) {
  scene::Stiffness stiffness = support::slender(2000, 3000);
  stiffness.bending_Nmm2[0] = 4000;
  scene::Scene finger = support::uniform_rod(
      100, stiffness, {scene::Force{100, scene::Frame::fixed, {-0.7, 0, 0}}, scene::Tendon{{4, 0}, 1, 100}});
  finger.sections[0].rest_curvature_per_mm = {0, 0, -0.005};
  for (const int arcs : {4, 16, 32, 64}) {
    EXPECT_NEAR(middle_of_folds_N(finger, arcs), 2.5, 1e-10);  // measured 5e-13
    EXPECT_NEAR(middle_of_folds_N(support::stiffer(finger), arcs), 1.05 * 2.5, 1e-10);
  }
}

// A straight column's shape does not tell how many arcs its buckling takes. Euler: pi^2/4, and 9 times that.
TEST(PathBranches, CriticalLoadsAreWithinTheTolerance) {
  const auto off = [](double tolerance, double stiffer) {
    scene::PathRequest request;
    request.scene = support::stiffer(
        support::uniform_rod(1, support::slender(1, 0.7), {scene::Force{1, scene::Frame::fixed, {-1, 0, 0}}}), stiffer);
    request.to = 25;
    fam::Options options;
    options.tolerance_mm = tolerance;
    const fam::Path path = fam::Path::follow(request, options);
    double largest = 0, euler = std::numbers::pi * std::numbers::pi / 4;
    for (const PathPoint& point : critical_points(path.points(), 0)) {
      largest = std::max(largest, std::abs(point.parameter / euler - 1));
      euler *= 9;
    }
    return largest;
  };
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    EXPECT_LT(off(tolerance, 1), tolerance);
    EXPECT_GT(off(tolerance, 1.05), 0.04);
  }
}

// A heavy column buckles at 7.8373474 EI / L^3 of weight a length (docs/theory.md), wherever the points of its path
// lie: with few arcs a point just beyond counts as before, with more arcs as beyond. The second part: about its other
// axis.
TEST(PathBranches, NoneIsMissedBesideAPoint) {
  scene::Stiffness stiffness = support::slender(1000, 5848);
  stiffness.bending_Nmm2[1] = 2500;
  stiffness.mass_per_length_kg_per_m = 0.04;
  const double critical = 7.8373474389 * 1000 / (0.04e-2 * 1e6);
  for (const double to : {64.25, 76.75, 77.0, 94.75, 95.0, 95.25, 96.0}) {
    scene::PathRequest request;
    request.scene = support::uniform_rod(100, stiffness, {scene::Gravity{{-10, 0, 0}}});
    request.to = to;
    const scene::Path path = fam::Path::follow(request).points();
    const std::vector<PathPoint> met = critical_points(path, 0);
    ASSERT_EQ(met.size(), 2u) << to;
    EXPECT_NEAR(met[0].parameter, critical, 2e-5 * critical);  // measured 3e-6; the arcs that located it: 2e-4
    EXPECT_NEAR(met[1].parameter, 2.5 * critical, 2.5e-3 * critical);
    for (const PathPoint& point : path.points) {
      const int beyond = (point.parameter > critical) + (point.parameter > 2.5 * critical);
      EXPECT_TRUE(point.multiplicity > 0 || point.index == beyond) << point.parameter;
    }
    request.scene = support::stiffer(request.scene);
    EXPECT_GT(critical_points(fam::Path::follow(request).points(), 0).front().parameter, 1.04 * critical);
  }
}

// Where little more load moves a column far that is pushed aside.
TEST(PathBranches, PointsAreAsAccurateAsASolve) {
  constexpr double tolerance_mm = 1e-3;
  scene::PathRequest request;
  request.scene = support::uniform_rod(100, support::slender(1500, 1000),
                                       {scene::Force{100, scene::Frame::fixed, {-1.252, 0.032, -0.04}}});
  const scene::Path path = fam::Path::follow(request, {.tolerance_mm = tolerance_mm}).points();
  double largest_mm = 0, twin_mm = 0;
  for (const PathPoint& point : path.points) {
    const auto error_mm = [&](const scene::Scene& of) {
      return (fam::solve(of, {.tolerance_mm = 1e-7}).tip().position_B_mm - point.tip_position_B_mm).norm();
    };
    const scene::Scene there = scene::scene_at(request, point.parameter);
    largest_mm = std::max(largest_mm, error_mm(there));
    twin_mm = std::max(twin_mm, error_mm(support::stiffer(there)));
  }
  EXPECT_LT(largest_mm, tolerance_mm);  // measured
  EXPECT_GT(twin_mm, 1);
}

}  // namespace
