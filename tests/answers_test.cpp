// FAM's answers along the whole rod: tendons and forces off the centreline against independent numbers, balance,
// relations between scenes, critical loads.
#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "scene/scene_file.h"
#include "studies/compare/error_measures.h"
#include "studies/scenes/random_scene.h"
#include "support.h"
#include "support_fam.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <numbers>

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using scene::Equilibrium;
using scene::Frame;
using scene::Scene;
using support::slender;
using support::solved;
using support::uniform_rod;

struct Benchmark {
  Scene scene;
  Vector3d tip_mm, base_force_N, base_moment_Nmm;
};

// tests/data/14_tendons.json and 15_offset_forces.json; origin: an independent shooting (README.md there).
std::vector<Benchmark> benchmarks(const std::string& file) {
  std::ifstream stream(std::string(TEST_DATA_DIR) + "/" + file);
  const auto vector = [](const nlohmann::json& list) { return Vector3d(list[0], list[1], list[2]); };
  std::vector<Benchmark> all;
  for (const auto& json : nlohmann::json::parse(stream)) {
    std::istringstream text(json["scene"].dump());
    const std::string own = json.contains("base_own_force_N") ? "base_own_" : "base_";
    all.push_back({scene::read_scene(text, file), vector(json["tip_mm"]), vector(json[own + "force_N"]),
                   vector(json[own + "moment_Nmm"])});
  }
  return all;
}

// Measured: 1.1e-10 mm of 50, 2e-13 N, 5e-11 N mm. Limit: 1e-8 of length and loads.
TEST(Answers, TendonsAndOffsetForcesAgainstAnIndependentShooting) {
  for (const char* file : {"14_tendons.json", "15_offset_forces.json"}) {
    for (const Benchmark& benchmark : benchmarks(file)) {
      SCOPED_TRACE(benchmark.scene.title);
      const Equilibrium result = solved(benchmark.scene, 1e-9);
      ASSERT_TRUE(result.converged());
      EXPECT_LT((result.tip().position_B_mm - benchmark.tip_mm).norm(), 4e-7);
      EXPECT_LT((result.base().force_B_N - benchmark.base_force_N).norm(), 1e-8 * benchmark.base_force_N.norm());
      EXPECT_LT((result.base().moment_B_Nmm - benchmark.base_moment_Nmm).norm(),
                1e-8 * benchmark.base_moment_Nmm.norm());
      const Equilibrium twin = solved(support::stiffer(benchmark.scene), 1e-9);
      EXPECT_GT((twin.tip().position_B_mm - benchmark.tip_mm).norm(), 1e-2);
      EXPECT_GT((twin.base().moment_B_Nmm - benchmark.base_moment_Nmm).norm(), 1e-4);
    }
  }
}

// Two tendons of 5 N at y = +-3 mm under a torque: GJ u + 2 T r^2 u / sqrt(1 + r^2 u^2) = M, where t = (1, u x r), for
// every law, and 0.04 where the tendons would not tilt.
TEST(Answers, TendonsStiffenARodAgainstTorsion) {
  const scene::Tendon left{{3, 0}, 5, 40}, right{{-3, 0}, 5, 40};
  const scene::Moment torque{40, Frame::follower, {20, 0, 0}};
  const auto twist_per_mm = [](const Equilibrium& result) {
    const Matrix3d R = result.stations[10].X_BS.rotation_BS;
    return std::atan2(R(2, 1), R(1, 1)) / result.stations[10].s_mm;
  };
  for (const fam::Law law : fam::all_laws()) {
    fam::Options options;
    options.law = law;
    options.arcs = 4;
    const Scene scene = uniform_rod(40, slender(750, 500), {left, right, torque});
    const Equilibrium result = fam::solve(scene, options);
    ASSERT_TRUE(result.converged()) << result.message;
    const double u = twist_per_mm(result);
    EXPECT_NEAR(u, 0.0339249, 5e-8);
    EXPECT_NEAR(500 * u + 90 * u / std::sqrt(1 + 9 * u * u), 20, 1e-9);
    ASSERT_EQ(result.tendon_shortening_mm.size(), 2u);
    EXPECT_NEAR(result.tendon_shortening_mm[0], 40 * (1 - std::sqrt(1 + 9 * u * u)), 1e-10);
    EXPECT_GT(std::abs(twist_per_mm(fam::solve(support::stiffer(scene), options)) - 0.0339249), 1e-3);
  }
}

// Where the curvature changes along the arcs, against the exact reference.
TEST(Answers, TendonsShortenAsTheExactOnes) {
  const auto loads = [](double out_of_plane_N) -> std::vector<scene::Load> {
    return {scene::Tendon{{1.5, 0.4}, 3, 40}, scene::Tendon{{-0.7, 1.6}, 2, 25},
            scene::Force{40, Frame::fixed, {0, 0.8, out_of_plane_N}},
            scene::DistributedForce{10, 40, Frame::follower, {0, -0.03, 0.1 * out_of_plane_N}}};
  };
  for (const double out_of_plane_N : {0., 0.3}) {
    Scene scene = uniform_rod(40, slender(750, 500), loads(out_of_plane_N));
    scene.sections[0].rest_curvature_per_mm = {0, 0, 0.01};
    const Equilibrium exact = exact_reference::solve(scene, {.tolerance = 1e-12});
    const Equilibrium result = solved(scene, 1e-6), twin = solved(support::stiffer(scene), 1e-6);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(result.tendon_shortening_mm[k], exact.tendon_shortening_mm[k], 1e-6) << k;
      EXPECT_GT(std::abs(twin.tendon_shortening_mm[k] - exact.tendon_shortening_mm[k]), 1e-3) << k;
    }
  }
}

// What the loads beyond a station and the tendons through it leave to the rod, by sums over the returned shape alone.
struct Balance {
  Vector3d force_N = Vector3d::Zero(), moment_Nmm = Vector3d::Zero();  // missing
  double force_size_N = 0;
};

Balance balance_at_base(const Scene& scene, const Equilibrium& result) {
  Balance balance;
  const auto at = [&](double s_mm) {
    const auto nearest = std::min_element(
        result.stations.begin(), result.stations.end(),
        [&](const auto& a, const auto& b) { return std::abs(a.s_mm - s_mm) < std::abs(b.s_mm - s_mm); });
    return *nearest;
  };
  const auto add = [&](const Vector3d& force_B_N, const Vector3d& at_B_mm) {
    balance.force_N += force_B_N;
    balance.moment_Nmm += at_B_mm.cross(force_B_N);
    balance.force_size_N += force_B_N.norm();
  };
  for (const scene::Load& load : scene.loads) {
    if (const auto* force = std::get_if<scene::Force>(&load)) {
      const scene::Station station = at(force->at_mm);
      const Matrix3d& R = station.X_BS.rotation_BS;
      const Vector3d arm(0, force->offset_mm[0], force->offset_mm[1]);
      add(force->frame == Frame::fixed ? force->value_N : Vector3d(R * force->value_N),
          station.X_BS.position_B_mm + R * arm);
    } else if (const auto* moment = std::get_if<scene::Moment>(&load)) {
      const Matrix3d& R = at(moment->at_mm).X_BS.rotation_BS;
      balance.moment_Nmm += moment->frame == Frame::fixed ? moment->value_Nmm : Vector3d(R * moment->value_Nmm);
    }
  }
  balance.force_N -= result.base().force_B_N;
  balance.moment_Nmm -= result.base().moment_B_Nmm;
  return balance;
}

// Force to round-off and moment as told by the shape, on every random scene of point loads without tendons.
TEST(Answers, BaseWrenchBalancesTheLoads) {
  int scenes = 0;
  for (std::uint64_t seed = studies::first_family_seed; seed < studies::first_family_seed + 1500; ++seed) {
    const Scene scene = studies::random_scene(seed);
    const bool point_loads = std::all_of(scene.loads.begin(), scene.loads.end(), [](const scene::Load& load) {
      return std::holds_alternative<scene::Force>(load) || std::holds_alternative<scene::Moment>(load);
    });
    if (!point_loads) continue;
    const Equilibrium result = solved(scene, 1e-4 * scene::length_mm(scene));
    if (!result.converged()) continue;
    ++scenes;
    const Balance balance = balance_at_base(scene, result);
    EXPECT_LT(balance.force_N.norm(), 1e-13 * balance.force_size_N) << seed;
    EXPECT_LT(balance.moment_Nmm.norm(), 1e-11 * (100 * balance.force_size_N + result.base().moment_B_Nmm.norm()))
        << seed;
  }
  EXPECT_GT(scenes, 400);
}

// All loads but the tendons fixed: the rod's own force and the tendons' pulls T R t/|t| at the clamp are the loads'
// sum.
TEST(Answers, OwnForceAndTendonPullsAreTheLoadsSum) {
  const Scene scene = uniform_rod(
      60, slender(900, 300),
      {scene::Tendon{{1.5, 0.4}, 6, 60}, scene::Tendon{{-0.7, 1.6}, 4, 45},
       scene::Force{60, Frame::fixed, {0.1, 0.4, -0.3}, {1, 2}}, scene::Moment{30, Frame::fixed, {25, 3, 0}}});
  for (const double tolerance_mm : {0.5, 1e-3, 1e-8}) {
    const Equilibrium result = solved(scene, tolerance_mm);
    ASSERT_TRUE(result.converged());
    const Vector3d own_S = result.base().moment_B_Nmm;
    const Vector3d u = own_S.cwiseQuotient(Vector3d(300, 900, 900));
    Vector3d pulls = Vector3d::Zero();
    for (const auto& [arm, tension] : {std::pair{Vector3d(0, 1.5, 0.4), 6.}, {Vector3d(0, -0.7, 1.6), 4.}}) {
      pulls += tension * (Vector3d::UnitX() + u.cross(arm)).normalized();
    }
    EXPECT_LT((result.base().force_B_N + pulls - Vector3d(0.1, 0.4, -0.3)).norm(), 1e-13);
  }
}

// Critical loads at every tolerance; origin: Timoshenko and Gere (Euler, Prandtl-Michell 4.0126, distributed 12.8538),
// Greenhill 7.8373; tests/data/06_critical_load_constants.csv.
TEST(Answers, CriticalLoadsAtEveryTolerance) {
  scene::Stiffness strip = slender(1, 1);
  strip.bending_Nmm2[1] = 1e6;
  scene::Stiffness heavy = slender(1500, 1150);
  heavy.mass_per_length_kg_per_m = 1;
  struct Case {
    const char* name;
    std::function<Scene(double)> scene;
    double critical;
  };
  const std::vector<Case> cases = {
      {"Euler",
       [](double f) {
         return uniform_rod(10, slender(1, 0.8), {scene::Force{10, Frame::fixed, {-f / 100, 0, 0}}});
       },
       std::numbers::pi * std::numbers::pi / 4},
      {"Prandtl and Michell",
       [&](double f) {
         return uniform_rod(10, strip, {scene::Force{10, Frame::fixed, {0, f / 100, 0}}});
       },
       4.012600},
      {"distributed",
       [&](double f) {
         return uniform_rod(10, strip, {scene::DistributedForce{0, 10, Frame::fixed, {0, f / 1000, 0}}});
       },
       12.853800},
      {"Greenhill",
       [&](double f) {
         return uniform_rod(10, heavy, {scene::Gravity{{-f * 1500, 0, 0}}});
       },
       7.837347}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    for (const double tolerance : {1e-2, 1e-3, 1e-6}) {
      EXPECT_EQ(solved(c.scene(c.critical * (1 - 1e-4)), 10 * tolerance).stable, std::optional(true)) << tolerance;
      EXPECT_EQ(solved(c.scene(c.critical * (1 + 1e-4)), 10 * tolerance).stable, std::optional(false)) << tolerance;
    }
    // The twin, 5 % stiffer, is still stable there.
    EXPECT_EQ(solved(support::stiffer(c.scene(c.critical * 1.02)), 0.01).stable, std::optional(true));
  }
}

TEST(Answers, StableWithoutLoadsAndUnderTendonsAlone) {
  EXPECT_EQ(solved(uniform_rod(10, slender(1, 1), {}), 0).stable, std::optional(true));
  const Scene robot =
      uniform_rod(40, slender(750, 300), {scene::Tendon{{2, 1}, 20, 40}, scene::Tendon{{-1, 2}, 9, 25}});
  EXPECT_EQ(solved(robot, 1e-3).stable, std::optional(true));
  // Under a follower load there is no energy to judge by.
  EXPECT_EQ(solved(uniform_rod(10, slender(1, 1), {scene::Force{10, Frame::follower, {0, 0.01, 0}}}), 0).stable,
            std::nullopt);
}

// Columns pressed far beyond Euler's load and hardly pushed aside become the elastica that a visible push gives.
TEST(Answers, ColumnsFarBeyondEulersLoad) {
  for (const double times : {1.5, 20., 100., 1000.}) {
    const double press = times * std::numbers::pi * std::numbers::pi / 4;
    const auto tip = [&](double aside) {
      const Equilibrium result =
          solved(uniform_rod(1, slender(1, 0.8), {scene::Force{1, Frame::fixed, {-press, aside, 0}}}), 1e-6);
      EXPECT_TRUE(result.converged()) << times << " " << aside << ": " << result.message;
      return result.converged() ? result.tip().position_B_mm : Vector3d::Zero();
    };
    for (const double aside : {1e-9, 1e-12}) EXPECT_LT((tip(aside) - tip(1e-6)).norm(), 1e-5) << times;
    EXPECT_LT((tip(-1e-12) - Vector3d(tip(1e-6).cwiseProduct(Vector3d(1, -1, 1)))).norm(), 1e-5) << times;
  }
}

// Torsion does not bend a round rod under fixed loads: the same centreline from GJ = 1e-6 to 10 EI, turned sections.
TEST(Answers, SoftTorsionTurnsSectionsAlone) {
  const auto rod = [](double torsion) {
    return uniform_rod(
        100, slender(1500, 1500 * torsion),
        {scene::Moment{100, Frame::fixed, {5, 1, 3}}, scene::Force{100, Frame::fixed, {0.05, 0.1, 0.2}}});
  };
  const Equilibrium stiff = solved(rod(1), 1e-6), truth = exact_reference::solve(rod(0.5));
  for (const double torsion : {1e-6, 1e-3, 0.5, 10.}) {
    const Equilibrium soft = solved(rod(torsion), 1e-6);
    ASSERT_TRUE(soft.converged());
    EXPECT_LT(studies::largest_distance_mm(soft, stiff), 2e-6);
    if (torsion != 0.5) continue;
    EXPECT_LT(studies::largest_distance_mm(soft, truth), 1e-6);
    EXPECT_LT((soft.tip().rotation_BS - truth.tip().rotation_BS).norm(), 1e-6);
    EXPECT_GT((stiff.tip().rotation_BS - truth.tip().rotation_BS).norm(), 1e-2);
  }
}

// Rods coiled by up to twenty turns, by rest curvature or by a tendon, under any load kind.
TEST(Answers, CoiledRods) {
  for (const double turns : {2., 7., 20.}) {
    const double curvature_per_mm = 2 * std::numbers::pi * turns / 100;
    for (const bool by_tendon : {false, true}) {
      for (const scene::Load& load :
           {scene::Load(scene::Force{100, Frame::fixed, {0.10413498, 0.08231014, 0.19127422}}),
            scene::Load(scene::Force{60, Frame::follower, {0.1, -0.2, 0.1}}),
            scene::Load(scene::DistributedForce{0, 100, Frame::fixed, {0, 0.002, 0.001}}),
            scene::Load(scene::Moment{100, Frame::fixed, {1, 10, 5}})}) {
        const double offset_mm = 0.3 / curvature_per_mm;
        Scene scene = uniform_rod(100, slender(1500, 1153.846), {load});
        if (by_tendon) scene.loads.push_back(scene::Tendon{{offset_mm, 0}, curvature_per_mm * 1500 / offset_mm, 100});
        else scene.sections[0].rest_curvature_per_mm = {0, 0, curvature_per_mm};
        const Equilibrium result = solved(scene, 0.01), truth = exact_reference::solve(scene);
        ASSERT_TRUE(result.converged() && truth.converged()) << turns << " " << result.message << truth.message;
        EXPECT_LT(studies::largest_distance_mm(result, truth), 0.01) << turns;
      }
    }
  }
}

// A pressed rod within 1e-6 L, 0.1 um, along its whole length, against the exact reference. By its tip one arc would
// do, which lies 0.38 um off at s = 28 mm.
TEST(Answers, OneArcIsComparedInside) {
  const Scene scene = uniform_rod(100, slender(5, 4), {scene::Force{100, Frame::fixed, {-1.2e-4, 1.45e-4, 0}}});
  const Equilibrium exact = exact_reference::solve(scene, {.tolerance = 1e-12});
  EXPECT_LT(studies::largest_distance_mm(solved(scene, 1e-4), exact), 1e-4);
  EXPECT_GT(studies::largest_distance_mm(solved(support::stiffer(scene), 1e-4), exact), 1e-4);
}

// The moment at the clamp under distributed forces, on six arcs within 1e-7 L, against the exact reference: 4.7e-8 of
// it is missed. Limit: 2e-7. Lobatto's rule of order six, the series' own, missed 2.9e-6.
TEST(Answers, DistributedForcesOnLongArcs) {
  const Scene scene = studies::random_scene(3701);
  const Equilibrium exact = exact_reference::solve(scene, {.tolerance = 1e-12});
  const auto missed = [&](const Scene& other) {
    const Equilibrium found = solved(other, 1e-7 * scene::length_mm(scene));
    return (found.base().moment_B_Nmm - exact.base().moment_B_Nmm).norm() / exact.base().moment_B_Nmm.norm();
  };
  EXPECT_LT(missed(scene), 2e-7);
  EXPECT_GT(missed(support::stiffer(scene)), 2e-7);
}

// Where only clamp and tip are asked for, they are those of the whole answer. Limit: round-off.
TEST(Answers, ClampAndTipAloneAreThoseOfTheWholeRod) {
  studies::RandomSceneLimits limits;
  limits.load_max = 30;
  int converged = 0, turned_fully = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene = studies::random_scene(seed, limits);
    if (seed % 10 == 0)
      scene = uniform_rod(60, slender(750, 500), {scene::Moment{60, Frame::follower, {0, 60.0 + seed, 0}}});
    fam::Options options;
    const Equilibrium whole = fam::solve(scene, options);
    options.whole_rod = false;
    const Equilibrium ends = fam::solve(scene, options);
    ASSERT_EQ(ends.status, whole.status);
    if (!whole.converged()) continue;
    ++converged;
    turned_fully += whole.tip_angle_rad > 2 * std::numbers::pi;
    ASSERT_EQ(ends.stations.size(), 2u);
    EXPECT_TRUE(ends.model.empty());
    EXPECT_EQ(ends.error_estimate_mm, whole.error_estimate_mm);
    EXPECT_EQ(ends.stable, whole.stable);
    EXPECT_NEAR(ends.tip_angle_rad, whole.tip_angle_rad, 1e-9);
    for (const auto& [end, expected] :
         {std::pair(ends.base(), whole.base()), std::pair(ends.stations.back(), whole.stations.back())}) {
      EXPECT_EQ(end.s_mm, expected.s_mm);
      EXPECT_LE((end.X_BS.position_B_mm - expected.X_BS.position_B_mm).norm(), 1e-12 * expected.s_mm);
      EXPECT_LE((end.X_BS.rotation_BS - expected.X_BS.rotation_BS).norm(), 1e-9);
      EXPECT_LE((end.force_B_N - expected.force_B_N).norm(), 1e-9 * whole.base().force_B_N.norm());
      EXPECT_LE((end.moment_B_Nmm - expected.moment_B_Nmm).norm(), 1e-9 * whole.base().moment_B_Nmm.norm());
    }
  }
  EXPECT_GT(converged, 250);
  EXPECT_GT(turned_fully, 5);
}

// A tendon that would pull the rod's inside to a point, and beyond: no shape, and the status says why.
TEST(Answers, CollapsedTendonsHaveNoShape) {
  for (const scene::Load& load : {scene::Load(scene::Force{40, Frame::follower, {0, 0.1, 0.2}}),
                                  scene::Load(scene::Force{40, Frame::fixed, {0, 0.1, 0}}),
                                  scene::Load(scene::Force{40, Frame::fixed, {0, 0.1, 0.2}})}) {
    const Equilibrium result = solved(uniform_rod(40, slender(750, 500), {scene::Tendon{{3, 0}, 200, 40}, load}), 0.01);
    EXPECT_EQ(result.status, scene::Status::tendon_collapsed) << result.message;
    EXPECT_TRUE(result.stations.empty());
  }
}

}  // namespace
