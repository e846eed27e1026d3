// Paths of the exact reference on scenes of the project's own: held against solves at one load, symmetries, themselves.
#include "exact_paths.h"
#include "exact_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

using namespace exact_test;
using Kind = scene::PathPoint::Kind;
using scene::PathParameter;
using scene::PathStatus;

namespace {

// A finger bent by its tendon, and a load that bends it back at its tip, thrust besides.
scene::PathRequest finger() {
  scene::PathRequest request;
  request.scene = uniform_rod(100, 2000, 1500);
  request.scene.loads = {scene::Tendon{{3, 0}, 4, 100}, scene::Force{100, Frame::fixed, {-1.5, 0, 0}},
                         scene::Force{100, Frame::fixed, {0, 1, 0}}};
  request.parameter = PathParameter::value;
  request.loads = {2};
  request.component = 1;
  request.to = -4;
  return request;
}

// A curved strip under two forces that turn it over: its load meets a fold.
scene::Scene snapping_strip(double curvature_per_mm = 0.02, const Vector3d& tip_force_N = {1, -2, -3},
                            const Vector3d& force_N = {-2, -1, -1}) {
  scene::Scene rod = uniform_rod(100, 1000, 700);
  stiffness(rod).bending_Nmm2[0] = 3000;
  rod.sections[0].rest_curvature_per_mm = {0, 0, curvature_per_mm};
  rod.loads = {scene::Force{100, Frame::fixed, tip_force_N}, scene::Force{60, Frame::fixed, force_N}};
  return rod;
}

// The largest distance of the first branch's points, one of `every`, from solves whose loads go to where the path
// starts and from there to the points'; up to its first critical point. Grown at once the rod may end on the other
// side.
double largest_distance_from_solves_mm(const scene::PathRequest& request, const scene::Path& path, std::size_t every) {
  double distance = 0;
  for (std::size_t i = 0; i < path.points.size() && path.points[i].multiplicity == 0; i += every) {
    const std::array scenes{scene::scene_at(request, request.from), scene::scene_at(request, path.points[i].parameter)};
    const scene::Equilibrium here = exact_reference::solve_along(scenes);
    distance = std::max(distance, (tip_mm(here) - path.points[i].tip_position_B_mm).norm());
  }
  return distance;
}

}  // namespace

// Falls sideways, and comes back into its plane bent the other way: the branch closes in itself.
TEST(ExactPathScenes, FingerSnapsPastATipLoad) {
  scene::PathRequest request = finger();
  request.branches = 2;
  const scene::Path path = complete_path(request);
  EXPECT_EQ(path.status, PathStatus::reached);
  EXPECT_LT(largest_distance_from_solves_mm(request, path, 2), 1e-9);  // measured 1e-11
  scene::PathRequest stiff = request;
  stiff.scene = stiffer(stiff.scene);
  EXPECT_GT(largest_distance_from_solves_mm(stiff, path, 2), 0.1);
  EXPECT_EQ(indices(path, 0), (std::vector<int>{0, 1}));
  EXPECT_EQ(indices(path, 1), (std::vector<int>{0}));
  std::vector<scene::PathPoint> critical;
  for (const scene::PathPoint& point : path.points) {
    if (point.branch == 1 && point.multiplicity > 0) critical.push_back(point);
  }
  ASSERT_EQ(critical.size(), 3u);  // out of the plane, into it, and back where it began
  EXPECT_EQ(critical[1].kind, Kind::branch);
  EXPECT_EQ(critical[2].kind, Kind::end);
  for (const scene::PathPoint& point : critical) EXPECT_NEAR(point.tip_position_B_mm[2], 0, 1e-7);
  EXPECT_NEAR(critical[0].parameter, critical[2].parameter, 1e-10);
  EXPECT_LT((critical[0].tip_position_B_mm - critical[2].tip_position_B_mm).norm(), 1e-7);
}

// The fold by shooting in scipy (DOP853, rotation matrices) and Newton's iteration on the extended system:
// 0.340912858066. A load beyond it ends there, a smaller one does not.
TEST(ExactPathScenes, AGrowingLoadEndsInAFold) {
  constexpr double expected = 0.340912858066;
  const scene::Scene rod = snapping_strip();
  const scene::Equilibrium limited = solve(rod);
  EXPECT_EQ(limited.status, scene::Status::limit_point);
  EXPECT_EQ(limited.message, "snaps at 34.1 % of the load");
  ASSERT_TRUE(limited.limit);
  EXPECT_EQ(limited.limit->kind, "fold");
  EXPECT_NEAR(limited.limit->load_factor, expected, 1e-9);  // measured 4e-11; six digits are promised
  EXPECT_TRUE(limited.stations.empty());
  const scene::Path path = complete_path(load_growth(rod, 1));
  ASSERT_FALSE(points_of_kind(path, Kind::fold).empty());
  EXPECT_NEAR(points_of_kind(path, Kind::fold)[0].parameter, expected, 1e-10);
  const scene::PathRequest request = load_growth(rod, 1);
  EXPECT_TRUE(solve(scene::scene_at(request, 0.9999 * expected)).converged());
  EXPECT_EQ(solve(scene::scene_at(request, 1.0001 * expected)).status, scene::Status::limit_point);
  const scene::Equilibrium twin = solve(stiffer(rod));
  ASSERT_TRUE(twin.limit);
  EXPECT_GT(std::abs(twin.limit->load_factor - expected), 1e-2);
}

// The load grows on a coarser mesh, whose fold may lie a little before or beyond: three of which the fold is found only
// along the path.
TEST(ExactPathScenes, FoldsWhereTheLoadCannotBeHeld) {
  const std::array rods{snapping_strip(-0.02, {-3, 2, -1}, {-1, 3, 3}), snapping_strip(0.03, {-1, -3, -3}, {-1, -1, 0}),
                        snapping_strip(0.02, {-3, -2, -1}, {1, -2, 2})};
  for (const scene::Scene& rod : rods) {
    const scene::Equilibrium limited = solve(rod);
    ASSERT_TRUE(limited.limit) << limited.message;
    const std::vector<scene::PathPoint> folds = points_of_kind(complete_path(load_growth(rod, 1)), Kind::fold);
    ASSERT_FALSE(folds.empty());
    EXPECT_NEAR(limited.limit->load_factor, folds[0].parameter, 1e-8);
  }
}

// Beyond its fold the strip's path turns back, and the index rises by one.
TEST(ExactPathScenes, TheIndexRisesAtAFold) {
  const scene::Path path = complete_path(load_growth(snapping_strip(), 1));
  const std::vector<int> along = indices(path, 0);
  ASSERT_GE(along.size(), 2u);
  EXPECT_EQ(along[0], 0);
  EXPECT_EQ(along[1], 1);
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const scene::PathPoint &a = path.points[i - 1], &b = path.points[i];
    EXPECT_TRUE(a.multiplicity > 0 || b.multiplicity > 0 || a.index == b.index) << i;
    EXPECT_EQ(b.stable, b.index == 0);
  }
}

// Loads along y and their mirrors; negative factors, and curvatures.
TEST(ExactPathScenes, MirroredGrowth) {
  const scene::Scene rod = tip_force(uniform_rod(100, 1000, 700), Frame::fixed, {0, 2, 0});
  const Vector3d up = complete_path(load_growth(rod, 1)).points.back().tip_position_B_mm;
  const Vector3d down = complete_path(load_growth(rod, -1)).points.back().tip_position_B_mm;
  EXPECT_LT((up - Vector3d(down[0], -down[1], 0)).norm(), 1e-9);
  EXPECT_GT(up[1], 50);
  scene::PathRequest request;
  request.scene = tip_force(uniform_rod(100, 1000, 700), Frame::fixed, {0.5, 0, 0});
  request.scene.sections[0].rest_curvature_per_mm[2] = 0.02;
  request.parameter = PathParameter::rest_curvature_factor;
  request.from = 1;
  request.to = -1;
  const scene::Path path = complete_path(request);
  EXPECT_EQ(path.status, PathStatus::reached);
  const Vector3d first = path.points[0].tip_position_B_mm, last = path.points.back().tip_position_B_mm;
  EXPECT_LT((first - Vector3d(last[0], -last[1], 0)).norm(), 1e-9);
  EXPECT_LT((first - tip_mm(solve(request.scene))).norm(), 1e-9);
}

// A load of two alone grows, and the other stays.
TEST(ExactPathScenes, OneLoadGrows) {
  scene::PathRequest request = finger();
  request.parameter = PathParameter::load_factor;
  request.loads = {0};
  request.to = 2;
  EXPECT_LT(largest_distance_from_solves_mm(request, complete_path(request), 7), 1e-9);
}

TEST(ExactPathScenes, StopsAndSteps) {
  scene::PathRequest request = load_growth(tip_force(uniform_rod(100, 1000, 700), Frame::fixed, {0, 2, 1}), 1.5);
  request.stop_at = {1.25, 0.3};
  request.largest_step = 0.04;
  const scene::Path path = complete_path(request);
  int stops = 0;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const double parameter = path.points[i].parameter, before = i > 0 ? path.points[i - 1].parameter : 0;
    stops += parameter == 0.3 || parameter == 1.25;
    EXPECT_LE(parameter - before, 0.04 * (1 + 1e-9));
  }
  EXPECT_EQ(stops, 2);
  EXPECT_EQ(path.points[0].kind, Kind::start);
  EXPECT_EQ(path.points.back().kind, Kind::end);
  EXPECT_EQ(path.points.back().parameter, 1.5);
}

// All but symmetric: no branch point, and none is made up; the path stays with the side that the small force chooses.
TEST(ExactPathScenes, BranchesThatAllButMeet) {
  scene::Scene rod = uniform_rod(1, 1, 1);
  stiffness(rod).bending_Nmm2[0] = 3;
  for (const double side : {1e-2, 1e-4, -1e-5}) {
    const scene::Path path = complete_path(load_growth(tip_force(rod, Frame::fixed, {-1, side, 0}), 4));
    EXPECT_TRUE(points_of_kind(path, Kind::branch).empty()) << side;
    EXPECT_TRUE(points_of_kind(path, Kind::fold).empty()) << side;
    EXPECT_EQ(indices(path, 0), (std::vector<int>{0})) << side;
    EXPECT_GT(path.points.back().tip_position_B_mm[1] * side, 0) << side;
  }
}

// A strip a million times stiffer edgewise than flat, which a tip force bends sideways: stable all along this branch,
// as finite elements and FAM count, too. An interval's stiffness, the inverse of its compliance, would leave round-off.
TEST(ExactPathScenes, IndexOfAStripOnEdge) {
  scene::Scene rod = uniform_rod(100, 1000, 1000);
  stiffness(rod).bending_Nmm2[1] = 1e9;
  scene::PathRequest request = load_growth(tip_force(rod, Frame::fixed, {0, 0.1, 0}), 12);
  request.branches = 1;
  const scene::Path path = complete_path(request);
  EXPECT_EQ(indices(path, 0), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(indices(path, 1), std::vector<int>{0});
}

// A thrust that is turned through the axis of a round rod: there all turned shapes are equilibria at one parameter.
TEST(ExactPathScenes, ACircleAtOneParameter) {
  scene::PathRequest request;
  request.scene = tip_force(uniform_rod(1, 1, 1), Frame::fixed, {-4, 0.4, 0});
  request.parameter = PathParameter::turn_rad;
  request.axis_B = Vector3d::UnitZ();
  request.to = 2 * std::numbers::pi;
  request.branches = 1;
  const scene::Path path = complete_path(request);
  EXPECT_EQ(path.status, PathStatus::returned);  // the rod snaps back through
  const std::vector<scene::PathPoint> branch = points_of_kind(path, Kind::branch);
  ASSERT_EQ(branch.size(), 1u);
  EXPECT_NEAR(branch[0].parameter, std::atan(0.1), 1e-10);
  EXPECT_EQ(path.points.back().branch, 1);
  EXPECT_NEAR(path.points.back().parameter, std::atan(0.1), 1e-10);
}

TEST(ExactPathScenes, WhatCannotStart) {
  scene::PathRequest request = load_growth(snapping_strip(), 2);
  request.from = 1;
  const scene::Path path = exact_reference::follow(request);
  EXPECT_EQ(path.status, PathStatus::not_started);
  EXPECT_EQ(path.message, "at the start: snaps at 34.1 % of the load");
  EXPECT_TRUE(path.points.empty());
  scene::PathRequest slack = finger();
  slack.loads = {0};
  slack.component = 0;
  EXPECT_THROW(exact_reference::follow(slack), scene::SceneError);  // a negative tension
}
