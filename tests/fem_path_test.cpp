// Equilibrium paths of the finite element beam against closed forms and published folds, each with a rod 5 % stiffer
// that must miss them.
#include "fem_reference/path.h"
#include "support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace fem_path {

using Eigen::Vector3d;
using fem_reference::Options;
using scene::Frame;
using scene::Path;
using scene::PathParameter;
using scene::PathPoint;
using scene::PathRequest;
using scene::PathStatus;
using support::slender;
using support::uniform_rod;
using Kind = PathPoint::Kind;

constexpr double pi = std::numbers::pi;

inline Options elements(int count) {
  Options options;
  options.elements = count;
  options.model = fem_reference::RodModel::kirchhoff;
  return options;
}

inline PathRequest request(scene::Scene scene, double to, int branches = 0) {
  PathRequest result;
  result.scene = std::move(scene);
  result.to = to;
  result.branches = branches;
  return result;
}

inline std::vector<PathPoint> points(const Path& path, Kind kind, int branch = 0) {
  std::vector<PathPoint> result;
  std::copy_if(path.points.begin(), path.points.end(), std::back_inserter(result),
               [&](const PathPoint& point) { return point.kind == kind && point.branch == branch; });
  return result;
}

// The first branch point's parameter, 0 if there is none.
inline double critical(const PathRequest& request, int count = 100) {
  const Path path = fem_reference::follow(request, elements(count));
  EXPECT_EQ(path.status, PathStatus::reached) << path.message;
  const auto branch_points = points(path, Kind::branch);
  return branch_points.empty() ? 0 : branch_points.front().parameter;
}

// The scene's and that of the stiffer twin, which must be off.
inline void expect_critical(const PathRequest& request, double expected, double relative) {
  EXPECT_NEAR(critical(request), expected, relative * expected);
  PathRequest twin = request;
  twin.scene = support::stiffer(request.scene);
  EXPECT_GT(std::abs(critical(twin) - expected), 1e3 * relative * expected);
}

inline scene::Scene rod(double strong, double weak, double torsion, std::vector<scene::Load> loads) {
  scene::Stiffness stiffness = slender(weak, torsion);
  stiffness.bending_Nmm2[1] = strong;
  stiffness.mass_per_length_kg_per_m = 1;
  return uniform_rod(1, stiffness, std::move(loads));
}

inline scene::Scene column(double strong = 1) {
  return rod(strong, 1, 1, {scene::Force{1, Frame::fixed, {-1, 0, 0}}});
}

// Euler: P L^2 / EI = pi^2 / 4, of a rod that buckles to one side. Measured 1.8e-10.
TEST(FemPath, EulersLoad) {
  expect_critical(request(column(2), 4), pi * pi / 4, 1e-9);
}

// The heavy column, Greenhill: q L^3 / EI = (9/4) j^2 with j the first zero of the Bessel function J_-1/3. 1e-3 N/mm
// of weight a unit of acceleration. Measured 1.4e-9.
TEST(FemPath, HeavyColumn) {
  expect_critical(request(rod(1, 1, 1, {scene::Gravity{{-1000, 0, 0}}}), 10), 7.8373474389, 1e-8);
}

// Lateral buckling of a cantilever (Timoshenko and Gere, Theory of Elastic Stability, 6.3), in sqrt(EI_weak GJ) / L^2
// and / L^3, for a strong axis that does not give way; to more digits by the zeros of the Bessel function J_-1/4 and of
// its distributed kin. Measured 2.3e-9 and 7.9e-9.
TEST(FemPath, LateralBuckling) {
  expect_critical(request(rod(1e10, 1, 1, {scene::Force{1, Frame::fixed, {0, 1, 0}}}), 6), 4.01259934357890, 2e-8);
  expect_critical(request(rod(1e10, 1, 1, {scene::DistributedForce{0, 1, Frame::fixed, {0, 1, 0}}}), 15),
                  12.8537633213834, 2e-8);
}

// The elastica: P / P_E = (2 K(sin 30 deg) / pi)^2 where the tip has turned by 60 degrees.
inline double tip_angle_at(double load_factor, const scene::Scene& scene) {
  PathRequest asked = request(scene, 2 * pi * pi / 4, 1);
  asked.stop_at = {load_factor};
  double angle_rad = 0;
  fem_reference::follow(asked, elements(100), [&](const PathPoint& point, const fem_reference::SolvedBeam& beam) {
    if (point.branch != 1 || point.parameter != load_factor) return;
    angle_rad = std::acos(fem_reference::stations(beam).value().back().X_BS.rotation_BS(0, 0));
  });
  return angle_rad;
}
TEST(FemPath, Elastica) {
  const double K = std::comp_ellint_1(0.5), load = K * K;
  EXPECT_NEAR(tip_angle_at(load, column()), pi / 3, 1e-6);  // measured 2e-8
  EXPECT_GT(std::abs(tip_angle_at(load, support::stiffer(column())) - pi / 3), 0.1);
}

// On the axis a round column buckles to any side: one double point, and on its branch a turn that costs nothing.
TEST(FemPath, ARoundColumnHasDoublePoints) {
  const Path path = fem_reference::follow(request(column(), 4, 1), elements(40));
  EXPECT_EQ(path.status, PathStatus::reached) << path.message;
  const auto found = points(path, Kind::branch);
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].multiplicity, 2);
  EXPECT_EQ(found[0].index, 0);
  EXPECT_EQ(points(path, Kind::end)[0].index, 2);
  const PathPoint buckled = points(path, Kind::end, 1).at(0);
  EXPECT_EQ(buckled.index, 0);
  EXPECT_TRUE(buckled.stable.value());
  EXPECT_TRUE(buckled.neutral);
  EXPECT_GT(buckled.tip_position_B_mm.y(), 0.5);
  EXPECT_NEAR(buckled.tip_position_B_mm.z(), 0, 1e-9);

  // In a follower's frame the load has no energy; Beck's rod has no static critical load.
  const Path beck =
      fem_reference::follow(request(rod(1, 1, 1, {scene::Force{1, Frame::follower, {-1, 0, 0}}}), 30), elements(40));
  EXPECT_EQ(beck.status, PathStatus::reached);
  EXPECT_TRUE(points(beck, Kind::branch).empty());
  EXPECT_FALSE(points(beck, Kind::end)[0].index.has_value());
}

// Without an energy a double point is seen by motions in the plane: a column that also carries a follower load of none
// of its weight worth mentioning.
TEST(FemPath, DoublePointsWithoutAnEnergy) {
  scene::Scene scene = column();
  scene.loads.push_back(scene::Force{0.5, Frame::follower, {1e-9, 0, 0}});
  const Path path = fem_reference::follow(request(scene, 4, 1), elements(40));
  const auto found = points(path, Kind::branch);
  ASSERT_EQ(found.size(), 1);
  EXPECT_NEAR(found[0].parameter, pi * pi / 4, 1e-7);
  EXPECT_EQ(found[0].multiplicity, 2);
  EXPECT_FALSE(found[0].index.has_value());
  EXPECT_GT(points(path, Kind::end, 1).at(0).tip_position_B_mm.y(), 0.5);
}

// A curved rod whose clamp is turned about its own tangent, published with AUTO-07p; the folds refined by an
// independent solver.
inline PathRequest turned_rod(double arm_mm = 0.02, double force_N = 1.15) {
  PathRequest result;
  result.scene =
      uniform_rod(1.7, slender(1, 1 / 1.3), {scene::Force{1.7, Frame::fixed, {0, 0, -force_N}, {arm_mm, 0}}});
  result.scene.sections[0].rest_curvature_per_mm = {0, 1.5, 0};
  result.parameter = PathParameter::turn_rad;
  result.to = 2 * pi;
  return result;
}
TEST(FemPath, FoldsOfACurvedRodTurnedInItsClamp) {
  const Path path = fem_reference::follow(turned_rod(), elements(100));
  EXPECT_EQ(path.status, PathStatus::reached) << path.message;
  const auto folds = points(path, Kind::fold);
  ASSERT_EQ(folds.size(), 2);
  EXPECT_NEAR(folds[0].parameter, 3.292926116, 1e-8);  // measured 2.4e-9
  EXPECT_NEAR(folds[1].parameter, 3.033816950, 1e-8);  // measured 1.6e-9
  // Between them the rod is unstable in one direction.
  for (const PathPoint& point : path.points) {
    EXPECT_EQ(point.stable, point.index == 0);
  }
  EXPECT_TRUE(
      std::any_of(path.points.begin(), path.points.end(), [](const PathPoint& point) { return point.index == 1; }));

  PathRequest twin = turned_rod();
  twin.scene = support::stiffer(twin.scene);
  const Path stiffer = fem_reference::follow(twin, elements(100));
  const auto others = points(stiffer, Kind::fold);
  ASSERT_EQ(others.size(), 2);
  EXPECT_GT(std::abs(others[0].parameter - 3.292926116), 1e-2);
  EXPECT_GT(std::abs(others[1].parameter - 3.033816950), 1e-2);
}

// Without the lever arm the planar shape at half a turn loses its stability out of the plane at a force between 0.865
// and 0.866 (published with AUTO-07p): below, the path goes through without a fold; above it folds twice.
TEST(FemPath, HalfATurnWithoutTheLeverArm) {
  EXPECT_TRUE(points(fem_reference::follow(turned_rod(0, 0.865), elements(100)), Kind::fold).empty());
  const Path above = fem_reference::follow(turned_rod(0, 0.866), elements(100));
  const auto folds = points(above, Kind::fold);
  ASSERT_EQ(folds.size(), 2);
  EXPECT_NEAR(folds[0].parameter + folds[1].parameter, 2 * pi, 1e-8);
}

// Points are placed where they are asked for; a path that comes back ends.
TEST(FemPath, StopsAndEnds) {
  PathRequest asked = turned_rod();
  asked.stop_at = {0.5, 3.1, 3.2};
  const Path path = fem_reference::follow(asked, elements(30));
  for (const double stop : asked.stop_at) {
    const auto count = std::count_if(path.points.begin(), path.points.end(),
                                     [stop](const PathPoint& point) { return point.parameter == stop; });
    EXPECT_EQ(count, stop < 3 ? 1 : 3) << stop;  // before, between and after the folds
  }
  EXPECT_EQ(path.points.front().kind, Kind::start);
  EXPECT_EQ(path.points.back().kind, Kind::end);
  EXPECT_EQ(path.points.back().parameter, 2 * pi);

  asked = turned_rod();
  asked.largest_step = 0.05;
  const Path fine = fem_reference::follow(asked, elements(30));
  for (std::size_t i = 1; i < fine.points.size(); ++i) {
    EXPECT_LT(std::abs(fine.points[i].parameter - fine.points[i - 1].parameter), 0.0506);
  }

  PathRequest back = request(column(2), -3);  // a load factor below zero: the rod is pulled
  EXPECT_EQ(fem_reference::follow(back, elements(20)).status, PathStatus::reached);
}

// The same equilibria whatever the number is called that changes.
TEST(FemPath, EveryParameterLeadsToTheSameShape) {
  const auto with = [](double force_N, double curvature_per_mm, double turn_rad) {
    scene::Scene scene = uniform_rod(
        1, slender(1, 0.7),
        {scene::Force{1, Frame::fixed, {0, force_N * std::cos(turn_rad), force_N * std::sin(turn_rad)}},
         scene::DistributedForce{0.3, 1, Frame::follower, {0, 0.5, 0.2}}, scene::Tendon{{0.05, 0.02}, 2, 0.8}});
    scene.sections[0].rest_curvature_per_mm = {0.1 * curvature_per_mm, 0, curvature_per_mm};
    return scene;
  };
  const auto tip = [](const PathRequest& asked) {
    const Path path = fem_reference::follow(asked, elements(20));
    EXPECT_EQ(path.status, PathStatus::reached) << path.message;
    return path.points.back().tip_position_B_mm;
  };
  PathRequest load = request(with(1, 1, 0.4), 2), value = request(with(0, 1, 0), 2), turn = request(with(2, 1, 0), 0.4),
              curvature = request(with(2, 0.5, 0.4), 2);
  load.loads = {0};
  turn.parameter = PathParameter::turn_rad;
  curvature.parameter = PathParameter::rest_curvature_factor;
  const Vector3d expected = tip(load);
  EXPECT_LT((tip(turn) - expected).norm(), 1e-9);
  EXPECT_LT((tip(curvature) - expected).norm(), 1e-9);
  value.parameter = PathParameter::value;
  value.loads = {0};
  value.component = 1;
  PathRequest straight = request(with(1, 1, 0), 2);
  straight.loads = {0};
  EXPECT_LT((tip(value) - tip(straight)).norm(), 1e-9);
  PathRequest tension = request(with(2, 1, 0.4), 2);
  tension.parameter = PathParameter::value;
  tension.loads = {2};
  EXPECT_LT((tip(tension) - expected).norm(), 1e-9);
}

}  // namespace fem_path
