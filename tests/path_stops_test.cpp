// Where a path must stop: at values asked for, beside critical points too, and at its end.
#include "path_support.h"

#include "fam/path.h"
#include "fam/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace path_support;
using scene::PathParameter;
using scene::PathStatus;

TEST(Path, StopsAreMetExactlyAndStepsAreShort) {
  PathRequest request = load_path(tapered(), 0, 2);
  request.stop_at = {0.3, 1.7};
  request.largest_step = 0.04;
  const scene::Path path = followed(request).points();
  int stops = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    EXPECT_LE(std::abs(path.points[i].parameter - path.points[i - 1].parameter), 0.04);
    stops += path.points[i].parameter == 0.3 || path.points[i].parameter == 1.7;
  }
  EXPECT_EQ(stops, 2);
}

// Where the rod moves far for a little of the parameter, a point near the path is not near what the rod is there: with
// arcs for the one alone it is 4 tolerances off. Limit: the tolerance; a solve to a ten thousandth of it.
TEST(Path, StopsAreAsAccurateAsASolve) {
  const double L = 5.9985, tolerance_mm = 1e-5 * L;
  scene::Scene rod = support::uniform_rod(0.7367, support::slender(78.16, 56.03), {});
  rod.sections.push_back(support::uniform_rod(L - 0.7367, support::slender(750, 1000), {}).sections[0]);
  rod.loads = {scene::DistributedForce{0, L, Frame::follower, {1.22335, -0.03072, 4.04416}},
               scene::Force{L, Frame::follower, {-26.36652, 1.24745, 16.54565}},
               scene::DistributedForce{0, L, Frame::fixed, {-1.76320, 1.09824, -2.32456}}};
  PathRequest request = load_path(rod, 0, 1.3);
  request.stop_at = {0.6147};
  const scene::Path path = fam::Path::follow(request, {.tolerance_mm = tolerance_mm}).points();
  const auto stop =
      std::find_if(path.points.begin(), path.points.end(), [](const auto& p) { return p.parameter == 0.6147; });
  ASSERT_NE(stop, path.points.end());
  const auto error_mm = [&](const scene::Scene& of) {
    const scene::Equilibrium exact = fam::solve(of, {.tolerance_mm = 1e-4 * tolerance_mm});
    return (exact.tip().position_B_mm - stop->tip_position_B_mm).norm();
  };
  const scene::Scene there = scene::scene_at(request, 0.6147);
  EXPECT_LT(error_mm(there), tolerance_mm);
  EXPECT_GT(error_mm(support::stiffer(there)), 100 * tolerance_mm);
}

// A column beyond Euler's load that a small push across holds in its plane, until there is none: the elastica in that
// plane, free to turn. With a tip at 60 degrees to the column F = K^2, x = 2 E/K - 1 and the tip 2 k/K off the axis, k
// = sin 30.
TEST(Path, EndsWhereTheRodIsFreeToTurn) {
  const double k = std::sin(std::numbers::pi / 6), K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
  scene::Scene rod =
      uniform_rod(1, slender(1, 0.7), {Force{1, Frame::fixed, {-K * K, 0, 0}}, Force{1, Frame::fixed, {0, 0.4, 0.3}}});
  const auto error = [&](const scene::Scene& of) {
    PathRequest request = load_path(of, 1, 0);
    request.loads = {1};
    const scene::Path path = fam::Path::follow(request, {.tolerance_mm = 1e-9}).points();
    EXPECT_EQ(path.status, PathStatus::reached);
    const PathPoint& end = path.points.back();
    EXPECT_EQ(of_kind(path, Kind::end).size(), 1u);
    EXPECT_EQ(end.parameter, 0);
    EXPECT_TRUE(end.neutral);
    EXPECT_EQ(end.index, 0);
    return (end.tip_position_B_mm - Eigen::Vector3d(2 * E / K - 1, 2 * k / K * 0.8, 2 * k / K * 0.6)).norm();
  };
  EXPECT_LT(error(rod), 1e-7);
  EXPECT_GT(error(support::stiffer(rod)), 1e-2);
}

// Beyond, the push is against the bend: the rod would turn, and at a fold it snaps to the other side.
TEST(Path, PassesWhereTheRodIsFreeToTurn) {
  for (const double force_N : {2.6, 3.2, 5.0}) {
    PathRequest request =
        load_path(uniform_rod(1, slender(1, 0.7),
                              {Force{1, Frame::fixed, {-force_N, 0, 0}}, Force{1, Frame::fixed, {0, 0.4, 0.3}}}),
                  1, -1);
    request.loads = {1};
    request.branches = 1;
    const scene::Path path = followed(request).points();
    EXPECT_EQ(path.status, PathStatus::reached);
    EXPECT_EQ(path.points.back().branch, 0);
    const auto free = std::find_if(path.points.begin(), path.points.end(), [](const auto& p) { return p.neutral; });
    ASSERT_NE(free, path.points.end()) << force_N;
    EXPECT_EQ(free->parameter, 0);
    EXPECT_EQ(free->kind, Kind::branch);
    EXPECT_EQ((free - 1)->index, 0);
    EXPECT_EQ((free + 1)->index, 1);
  }
}

// Near a branch point, of which few arcs tell the place to 4e-5: at stops that close to it the branch is met where it
// is there, within the tolerance of a path that is a thousand times finer, and followed to its end.
TEST(Path, StopsBesideABranchPoint) {
  const double euler = std::numbers::pi * std::numbers::pi / 4;
  const auto at = [](const scene::Path& path, double parameter) -> std::optional<Eigen::Vector3d> {
    for (const PathPoint& point : path.points) {
      if (point.branch == 1 && point.parameter == parameter) return point.tip_position_B_mm;
    }
    return std::nullopt;
  };
  for (const double off : {-1e-3, -1e-4, -3e-5, -1e-6, 0.0, 1e-7, 1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3}) {
    PathRequest request = load_path(column(), 0, 4);
    request.branches = 1;
    request.stop_at = {euler * (1 + off)};
    const scene::Path path = followed(request).points();
    fam::Options fine;
    fine.tolerance_mm = 1e-6;
    const scene::Path finer = fam::Path::follow(request, fine).points();
    EXPECT_LT(path.points.back().tip_position_B_mm[0], 0.3) << off;  // straight: 1
    EXPECT_EQ(path.points.back().index, 0) << off;
    EXPECT_EQ(of_kind(path, Kind::branch).size(), 1u) << off;
    const auto here = at(path, request.stop_at[0]), there = at(finer, request.stop_at[0]);
    if (off < -1e-4) {
      EXPECT_FALSE(here) << off;
    }
    if (off > 1e-5) {
      ASSERT_TRUE(here && there) << off;
    }
    if (here && there) {
      EXPECT_LT((*here - *there).norm(), 2e-3) << off;
    }
  }
  PathRequest request = load_path(column(), 0, euler);
  request.branches = 1;
  EXPECT_LT(followed(request).points().points.back().tip_position_B_mm.tail<2>().norm(), 2e-3);
}

// Between two folds a stop is met three times, however near a fold it lies.
TEST(Path, StopsBesideAFold) {
  scene::Stiffness strip = slender(1500, 1e6);
  strip.bending_Nmm2[0] = 1e6;
  PathRequest request = load_path(uniform_rod(100, strip, {Force{100, Frame::fixed, {-0.6, 0, 0}}}), 0.6, -0.6);
  request.parameter = PathParameter::value;
  request.loads = {0};
  request.component = 1;
  const auto folds = of_kind(followed(request).points(), Kind::fold);
  ASSERT_EQ(folds.size(), 2u);
  const double low = std::min(folds[0].parameter, folds[1].parameter),
               high = std::max(folds[0].parameter, folds[1].parameter);
  for (const double share : {0.3, 0.03, 0.003, 3e-4}) {
    request.stop_at = {std::lerp(low, high, share), std::lerp(high, low, share)};
    const scene::Path path = followed(request).points();
    for (const double stop : request.stop_at) {
      EXPECT_EQ(std::count_if(path.points.begin(), path.points.end(),
                              [&](const PathPoint& point) { return point.parameter == stop; }),
                3)
          << share;
    }
  }
}

TEST(Path, StopsAreMetOnce) {
  PathRequest request = load_path(tapered(), 2, 0);
  request.stop_at = {2, 0, 1.5, 1.5, 0.3};
  const scene::Path path = followed(request).points();
  for (const double stop : request.stop_at) {
    EXPECT_EQ(std::count_if(path.points.begin(), path.points.end(), [&](const auto& p) { return p.parameter == stop; }),
              1)
        << stop;
  }
}

// No load at the start, and none of the column's own at its critical one.
// Each of these once went round and round: a turned mesh with as many arcs undid the same step again and again; a
// branch that closes was not known as closed, its start being that of six arcs and its end that of 384.
TEST(Path, GoesRoundOnce) {
  PathRequest request =
      load_path(uniform_rod(100, slender(1500, 1000), {Force{100, Frame::fixed, {-1, 0, 0}}}), 0, 3.415254237288136);
  request.branches = 1;
  EXPECT_EQ(followed(request).points().status, PathStatus::reached);

  scene::Stiffness strip = slender(1500, 1000);
  strip.bending_Nmm2[0] = 75028.5628;
  request = load_path(
      uniform_rod(100, strip, {Force{100, Frame::fixed, {-0.8, 0, 0}}, scene::Tendon{{2, 0}, 0.5236490280647077, 100}}),
      0.5, 2);
  request.scene.sections[0].rest_curvature_per_mm = {0, 0, -0.010685371126485918};
  request.parameter = PathParameter::value;
  request.loads = {0};
  request.component = 1;
  request.branches = 2;
  EXPECT_LT(followed(request).points().points.size(), 300u);
}

// A tendon lets go of a buckled round rod, which may turn then at no cost: the path ends there and not a little before
// or beyond.
TEST(Path, EndsAtItsEnd) {
  PathRequest request = load_path(
      uniform_rod(100, slender(1500, 1000), {scene::Tendon{{2, 0}, 0, 100}, Force{100, Frame::fixed, {-0.5, 0, 0}}}), 5,
      0);
  request.parameter = PathParameter::value;
  request.loads = {0};
  const scene::Path path = followed(request).points();
  EXPECT_EQ(path.status, PathStatus::reached) << path.message;
  EXPECT_EQ(path.points.back().parameter, 0);
  const scene::Equilibrium free = fam::solve(scene::scene_at(request, 1e-3));
  EXPECT_NEAR(path.points.back().tip_position_B_mm[0], free.tip().position_B_mm[0], 0.2);
}

}  // namespace
