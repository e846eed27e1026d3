// The automatic choice: the smallest model that does, and its promise.
#include "fam/model_choice.h"
#include "exact_reference/solve.h"
#include "fam/load_length.h"
#include "fam/solve.h"
#include "fam/solver.h"
#include "studies/random/promise.h"
#include "studies/scenes/random_scene.h"
#include "support.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace {

using Eigen::Vector3d;
using scene::Frame;
using support::slender;
using support::uniform_rod;

template <class T>
T fact(const scene::Equilibrium& result, const std::string& key) {
  for (const auto& [name, value] : result.model) {
    if (name == key) return std::get<T>(value);
  }
  ADD_FAILURE() << key;
  return {};
}

scene::Equilibrium solved(const scene::Scene& scene, double tolerance_mm = 1e-4) {
  fam::Options options;
  options.tolerance_mm = tolerance_mm;
  scene::Equilibrium result = fam::solve(scene, options);
  EXPECT_TRUE(result.converged()) << result.message;
  return result;
}

scene::Scene tip_loaded(const Vector3d& force_N, const Vector3d& moment_Nmm, Frame frame,
                        const scene::Stiffness& stiffness = slender(750, 500)) {
  return uniform_rod(40, stiffness, {scene::Force{40, frame, force_N}, scene::Moment{40, frame, moment_Nmm}});
}

double swing_rad(const scene::Stiffness& stiffness, const Vector3d& moment_Nmm, double force_N, bool planar = false) {
  scene::Span span;
  span.end_mm = 2;
  span.stiffness = stiffness;
  span.fixed_load_B.force_N[0] = force_N;
  span.follower_load_S.moment_Nmm = moment_Nmm;
  const Vector3d compliance(1 / stiffness.torsion_Nmm2, 1 / stiffness.bending_Nmm2[0], 1 / stiffness.bending_Nmm2[1]);
  const Vector3d turn_rad = 2 * compliance.cwiseProduct(moment_Nmm);
  if (planar) {
    fam::BasicArc<2> arc;
    arc.screw.rotation[0] = turn_rad.norm();
    return fam::largest_swing_rad<2>(std::vector{span}, std::vector{1}, std::vector{arc});
  }
  fam::Arc arc;
  arc.screw.rotation = turn_rad;
  return fam::largest_swing_rad<3>(std::vector{span}, std::vector{1}, std::vector{arc});
}

// m' = m x k linearised by hand about a moment along one axis: Euler's equations of a spinning body.
TEST(ModelChoice, AnArcSwingsAsFarAsItsMoment) {
  scene::Stiffness ribbon = slender(50, 20);
  ribbon.bending_Nmm2[0] = 1000;
  const double c_x = 1 / 20.0, c_y = 1 / 1000.0, c_z = 1 / 50.0;
  EXPECT_NEAR(swing_rad(ribbon, {0, 300, 0}, 1), 2 * 300 * std::sqrt((c_x - c_y) * (c_z - c_y)), 1e-9);
  EXPECT_NEAR(swing_rad(ribbon, {0, 0, 300}, 1), 2 * 300 * std::sqrt((c_x - c_z) * (c_z - c_y)), 1e-9);
  const scene::Stiffness stiff_in_torsion = slender(100, 1000);
  EXPECT_NEAR(swing_rad(stiff_in_torsion, {300, 0, 0}, 1), 2 * 300 * (1 / 100.0 - 1 / 1000.0), 1e-9);
  EXPECT_NEAR(swing_rad(stiff_in_torsion, {0, 0, 300}, 1), 2 * 300 / 100.0, 1e-9);  // a circle
  // In the plane nothing swings; without force a steady arc is exact, one that bends and twists is not.
  EXPECT_NEAR(swing_rad(ribbon, {0, 300, 0}, 1, true), 2 * 300 * c_y, 1e-9);
  EXPECT_EQ(swing_rad(ribbon, {0, 300, 0}, 0), 0);
  EXPECT_GT(swing_rad(ribbon, {0, 300, 1}, 0), 10);
}

TEST(ModelChoice, APureEndMomentTakesOneArc) {
  for (const Vector3d& moment : {Vector3d(0, 0, 100), Vector3d(0, 40, 30), Vector3d(50, 0, 0)}) {
    EXPECT_EQ(fact<int>(solved(tip_loaded({0, 0, 0}, moment, Frame::follower), 1e-9), "arcs"), 1) << moment;
  }
  // Twins: a moment that bends and twists turns in the section where GJ is not EI; a force beside it.
  EXPECT_GT(fact<int>(solved(tip_loaded({0, 0, 0}, {20, 30, -100}, Frame::follower), 1e-9), "arcs"), 1);
  EXPECT_GT(fact<int>(solved(tip_loaded({0, 0.1, 0}, {0, 0, 100}, Frame::follower), 1e-9), "arcs"), 1);
}

// Where tendons pull alone, what they leave to the rod cancels their pulls, and each span has one strain: an arc of
// each is exact, whatever its stiffnesses and rest curvature.
TEST(ModelChoice, TendonsAloneTakeOneArcOfEachSpan) {
  scene::Scene rod = uniform_rod(20, {900, {500, 500}, 400, {}, 0}, {});
  rod.sections.push_back({25, scene::Stiffness{300, {400, 200}, 500, {}, 0}, {0.02, -0.01, 0.03}});
  rod.loads = {scene::Tendon{{2, 0.5}, 6, 45}, scene::Tendon{{-1, 1.5}, 4, 32}, scene::Tendon{{0.3, -1.7}, 5, 45}};
  const auto off_mm = [](const scene::Scene& one, const scene::Scene& other) {
    return (solved(one).tip().position_B_mm - exact_reference::solve(other).tip().position_B_mm).norm();
  };
  EXPECT_EQ(fact<int>(solved(rod), "arcs"), 3);
  EXPECT_LT(off_mm(rod, rod), 1e-11 * 45);  // SUNDIALS; measured 1.7e-14 L
  EXPECT_GT(off_mm(rod, support::stiffer(rod)), 1e-3);
  fam::Solver kept = std::get<fam::Solver>(fam::Solver::make(rod, {}));
  ASSERT_TRUE(kept.solve().converged());
  EXPECT_EQ(kept.poses().size(), 4u);
  EXPECT_LT((kept.tip().position_B_mm - exact_reference::solve(rod).tip().position_B_mm).norm(), 1e-11 * 45);
  // Twins: a moment or a force beside them turns in the section, one of each span does not do.
  for (const scene::Load& beside : {scene::Load(scene::Moment{45, Frame::follower, {10, 8, 0}}),
                                    scene::Load(scene::Force{45, Frame::follower, {0, 0.2, 0.1}})}) {
    scene::Scene loaded = rod;
    loaded.loads.push_back(beside);
    EXPECT_GT(fact<int>(solved(loaded), "arcs"), 3) << off_mm(loaded, loaded);
    EXPECT_LT(off_mm(loaded, loaded), 1e-4);
  }
}

// In the plane a moment turns with nothing, fixed in space or not.
TEST(ModelChoice, MomentsInThePlaneTakeOneArcOfEachSpan) {
  scene::Scene rod = uniform_rod(20, slender(500, 400), {scene::Moment{45, Frame::fixed, {0, 0, 60}}});
  rod.sections.push_back({25, slender(300, 200), {0, 0, -0.02}});
  rod.loads.push_back(scene::Moment{12, Frame::follower, {0, 0, -95}});
  const auto off_mm = [](const scene::Scene& one, const scene::Scene& other) {
    return (solved(one).tip().position_B_mm - exact_reference::solve(other).tip().position_B_mm).norm();
  };
  EXPECT_EQ(fact<int>(solved(rod), "arcs"), 3);
  EXPECT_LT(off_mm(rod, rod), 1e-11 * 45);  // SUNDIALS; measured 2e-16 L
  EXPECT_GT(off_mm(rod, support::stiffer(rod)), 1e-2);
  // Twins: out of the plane the fixed moment turns in the section, a force bends each section otherwise.
  for (const scene::Load& beside : {scene::Load(scene::Moment{45, Frame::fixed, {0, 8, 0}}),
                                    scene::Load(scene::Force{45, Frame::fixed, {0, 0.2, 0}})}) {
    scene::Scene loaded = rod;
    loaded.loads.push_back(beside);
    EXPECT_GT(fact<int>(solved(loaded), "arcs"), 3);
    EXPECT_LT(off_mm(loaded, loaded), 1e-3 * 45);
  }
}

// One arc does where its series are known to leave out less than the tolerance. It did on these, too, where the bound
// did not know how far the strain turns by a soft torsion, how a distributed force grows along it, or the law.
TEST(ModelChoice, WhatTheSeriesLeaveOutIsBounded) {
  const auto arcs_within = [](const scene::Scene& rod, double tolerance, fam::Law law = fam::Law::automatic) {
    fam::Options options;
    options.tolerance_mm = 100 * tolerance;
    options.law = law;
    const scene::Equilibrium answer = fam::solve(rod, options);
    const auto off_mm = [&answer](const scene::Scene& other) {
      return (answer.tip().position_B_mm - exact_reference::solve(other).tip().position_B_mm).norm();
    };
    EXPECT_LE(off_mm(rod), answer.error_estimate_mm);
    EXPECT_LE(answer.error_estimate_mm, 100 * tolerance);
    EXPECT_GT(off_mm(support::stiffer(rod)), 5 * answer.error_estimate_mm);
    return fact<int>(answer, "arcs");
  };
  scene::Scene soft =
      uniform_rod(100, {1, {300, 300}, {}, {}, 0}, {scene::Moment{100, Frame::follower, {0.0055, 0.1226, 0.0522}}});
  soft.sections[0].rest_curvature_per_mm = {0, -3e-4, 1.1e-3};
  EXPECT_GT(arcs_within(soft, 1e-4), 1);  // one arc: 4.9e-4 L off (SUNDIALS)
  const scene::Scene heavy = uniform_rod(
      100, slender(100, 80),
      {scene::Moment{100, Frame::fixed, {0, 0, 0.045}}, scene::DistributedForce{0, 100, Frame::fixed, {0, 2e-7, 0}}});
  EXPECT_GT(arcs_within(heavy, 1e-10), 1);  // one arc: 6.2e-10 L off (SUNDIALS)
  EXPECT_EQ(arcs_within(heavy, 1e-7), 1);
  arcs_within(heavy, 1e-7, fam::Law::midpoint);
}

// Opposite forces off the centreline are a couple that the shape decides, which may be one of several. Solved on one
// arc of each span alone these rods, found among 4000 such, ended on another branch, 0.5 L away.
TEST(ModelChoice, CouplesOfForcesLeaveTheStrainUnknown) {
  const auto press = [](scene::Scene& scene, double at_mm, const Vector3d& force_N, double off_mm) {
    scene.loads.push_back(scene::Force{at_mm, Frame::fixed, force_N, {off_mm, 0}});
    scene.loads.push_back(scene::Force{at_mm, Frame::fixed, -force_N, {-off_mm, 0}});
  };
  scene::Scene one = uniform_rod(50, {410, {620, 239}, {}, {}, 0}, {scene::Tendon{{-0.65, 0}, 7.5, 50}});
  press(one, 50, {13.16, 7.27, 0}, 4.9);
  press(one, 31.35, {23.2, 14.2, 0}, 2.6);
  scene::Scene two = uniform_rod(33, {604, {688, 340}, {}, {}, 0}, {scene::Tendon{{2.9, 0}, 3.7, 33}});
  press(two, 33, {20.3, 0.74, 0}, 9.4);
  press(two, 20.06, {13.5, 17.3, 0}, 6.37);
  for (const scene::Scene& scene : {one, two}) {
    const Vector3d exact_mm = exact_reference::solve(scene).tip().position_B_mm;  // SUNDIALS
    const double length_mm = scene.sections[0].length_mm;
    EXPECT_LT((solved(scene, 1e-4).tip().position_B_mm - exact_mm).norm(), 1e-4);
    EXPECT_GT((solved(support::stiffer(scene), 1e-4).tip().position_B_mm - exact_mm).norm(), 1e-3);
    fam::Solver kept = std::get<fam::Solver>(fam::Solver::make(scene, {}));
    ASSERT_TRUE(kept.solve().converged());
    EXPECT_LT((kept.tip().position_B_mm - exact_mm).norm(), 1e-3 * length_mm);
  }
}

// In the x-y plane, the x-z plane and, for round sections, any plane; the answer turns with the plane.
TEST(ModelChoice, APlanarSceneRunsThePlanarKernel) {
  for (const Frame frame : {Frame::follower, Frame::fixed}) {
    const Vector3d force(-0.3, 0.8, 0), moment(0, 0, 12);
    const scene::Equilibrium flat = solved(tip_loaded(force, moment, frame), 1e-8);
    EXPECT_EQ(fact<std::string>(flat, "kernel"), "planar");
    for (const double angle : {0.3, 1.5, 3.0, -2.0}) {
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix();
      const scene::Equilibrium turned = solved(tip_loaded(turn * force, turn * moment, frame), 1e-8);
      EXPECT_EQ(fact<std::string>(turned, "kernel"), "planar") << angle;
      EXPECT_LT((turned.tip().position_B_mm - turn * flat.tip().position_B_mm).norm(), 1e-11);
      EXPECT_LT((turned.tip().rotation_BS - turn * flat.tip().rotation_BS * turn.transpose()).norm(), 1e-12);
      EXPECT_LT((turned.base().moment_B_Nmm - turn * flat.base().moment_B_Nmm).norm(), 1e-10);
    }
    const scene::Equilibrium spatial = solved(tip_loaded(force, moment + Vector3d(0, 1e-6, 0), frame));
    EXPECT_EQ(fact<std::string>(spatial, "kernel"), "spatial");
  }
}

// A flat section bends in its own planes only: about z under a force along y, about y under a force along z.
TEST(ModelChoice, FlatSectionsHaveTwoPlanes) {
  scene::Stiffness flat = slender(750, 500);
  flat.bending_Nmm2 = {2000, 750};
  for (const auto& [force, kernel] :
       {std::pair<Vector3d, std::string>{{0, 1, 0}, "planar"}, {{0, 0, -1}, "planar"}, {{0, 0.6, 0.8}, "spatial"}}) {
    const scene::Scene scene = tip_loaded(force, {0, 0, 0}, Frame::fixed, flat);
    const scene::Equilibrium result = solved(scene, 1e-7);
    EXPECT_EQ(fact<std::string>(result, "kernel"), kernel);
    EXPECT_LT((result.tip().position_B_mm - exact_reference::solve(scene).tip().position_B_mm).norm(), 1e-7);
    EXPECT_GT((solved(support::stiffer(scene), 1e-7).tip().position_B_mm - result.tip().position_B_mm).norm(), 1e-2);
  }
}

TEST(ModelChoice, FollowerLoadsNeverRunTheBoundaryValueSolver) {
  for (const std::string& name : support::study1_cases()) {
    EXPECT_EQ(fact<std::string>(solved(support::study1_scene(name, "follower")), "solver"), "march");
    EXPECT_EQ(fact<std::string>(solved(support::study1_scene(name, "fixed")), "solver"), "boundary value");
  }
}

TEST(ModelChoice, SlenderRodsRunWithoutShear) {
  const auto shear = [](double slenderness) {  // EI / (kGA L^2)
    scene::Stiffness stiffness = slender(750, 500);
    stiffness.axial_N = 750 / (slenderness * 1600);
    stiffness.shear_N = Eigen::Vector2d::Constant(750 / (slenderness * 1600));
    return fact<bool>(solved(tip_loaded({0, 1, 0}, {0, 0, 0}, Frame::fixed, stiffness), 0.04), "shear");
  };
  EXPECT_FALSE(shear(1e-6));
  EXPECT_TRUE(shear(1e-3));
}

// The first of the random scenes of results/random/promise, old and new families: whole shape and base wrench
// within the tolerance in all but one in a thousand of those solved, never beyond three times it, no estimate below
// half the error, and few arcs too many.
TEST(ModelChoice, KeepsItsPromise) {
  std::vector<studies::Promise> promises;
  for (std::uint64_t index = 0; index < 400; ++index) {
    promises.push_back(studies::promise_of(studies::mixed_seed(index), index % 4 == 0));
  }
  for (const studies::Promise& p : promises) {
    if (!p.solved() || p.error > p.tolerance || p.wrench_error > p.tolerance) {
      std::printf("seed %d tolerance %.0e %s estimate %.1e error %.1e wrench error %.1e arcs %d\n",
                  static_cast<int>(p.seed), p.tolerance, p.status.c_str(), p.estimate, p.error, p.wrench_error, p.arcs);
    }
  }
  const studies::PromiseCounts counts = studies::count(promises);
  EXPECT_GE(counts.scenes, 380);
  EXPECT_GE(counts.solved, counts.scenes - 1);
  EXPECT_GE(counts.kept, counts.solved - 1);
  EXPECT_GE(counts.wrenches_kept, counts.solved - 1);
  EXPECT_EQ(counts.other_branch, 0);
  EXPECT_EQ(counts.low_estimates, 0);
  EXPECT_LE(std::max(counts.worst, counts.worst_wrench), 3);
  EXPECT_LE(counts.median_waste, 1.5);
}

}  // namespace
