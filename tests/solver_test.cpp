// The kept solver: set in place, solved again from the last solution, without allocating.
#include "allocation_counter.h"
#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "scene/span_facts.h"
#include "support.h"
#include "support_fam.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <functional>
#include <random>

namespace {

using Eigen::Vector3d;
using fam::Solver;
using scene::Frame;
using scene::Status;
using support::kept;
using support::slender;
using support::uniform_rod;

// Allocations of one solve for the tip alone; its answer.
std::size_t allocations_of(const scene::Scene& scene, scene::Equilibrium& result) {
  fam::Options options;
  options.whole_rod = false;
  const std::size_t before = allocation_count();
  result = fam::solve(scene, options);
  return allocation_count() - before;
}

// Every kind of load, two sections, stiff and soft.
scene::Scene robot() {
  scene::Scene scene = uniform_rod(60, slender(1500, 1000), {});
  scene.sections[0].cross_section = [] {
    scene::Stiffness stiffness = slender(1500, 1000);
    stiffness.mass_per_length_kg_per_m = 0.02;
    return stiffness;
  }();
  scene.sections.push_back(scene.sections[0]);
  scene.sections[1].length_mm = 40;
  scene.loads = {scene::Gravity{{0, -9.81, 0}},
                 scene::Tendon{{1.5, 0}, 1, 100},
                 scene::Tendon{{0, 1.5}, 0, 60},
                 scene::Force{100, Frame::fixed, {0, 0.1, 0}},
                 scene::Force{45, Frame::follower, {0, 0, 0}, {2, 0}},
                 scene::Moment{80, Frame::fixed, {0, 0, 2}},
                 scene::DistributedForce{20, 70, Frame::follower, {0, 0.001, 0}}};
  return scene;
}

// Random values of all that can be set; `size` 0 to 1.
class Joystick {
 public:
  explicit Joystick(std::uint64_t seed) : generator_(seed) {}
  Vector3d vector(double size) {
    return size * Vector3d(uniform_(generator_), uniform_(generator_), uniform_(generator_));
  }
  double number(double from, double to) { return from + (to - from) * (uniform_(generator_) + 1) / 2; }
  void set(Solver& solver) {
    solver.set_acceleration_m_per_s2(0, vector(9.81));
    solver.set_tension_N(1, number(-1, 4) > 0 ? number(0, 4) : 0);
    solver.set_tension_N(2, number(0, 3));
    solver.set_force_N(3, vector(0.3));
    solver.set_force_N(4, number(0, 1) > 0.5 ? vector(0.2) : Vector3d::Zero());
    solver.set_moment_Nmm(5, vector(8));
    solver.set_distributed_N_per_mm(6, vector(0.003));
    solver.set_rest_curvature_per_mm(1, vector(0.005));
    solver.set_stiffness_Nmm2(1, {number(500, 1500), number(1000, 2000), number(1000, 2000)});
    if (number(0, 1) > 0.7) solver.set_at_mm(4, number(1, 100));
    if (number(0, 1) > 0.7) solver.set_at_mm(5, number(1, 100));
  }

 private:
  std::mt19937_64 generator_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

double pose_distance_mm(const scene::Pose& a, const scene::Pose& b, double length_mm) {
  return std::max((a.position_B_mm - b.position_B_mm).norm(), length_mm * (a.rotation_BS - b.rotation_BS).norm());
}

scene::Pose kept_tip(const scene::Scene& scene, const fam::Options& options) {
  Solver solver = kept(scene, options);
  EXPECT_TRUE(solver.solve().converged());
  return solver.tip();
}

TEST(Solver, NoAllocationAfterMake) {
  Joystick joystick(1);
  fam::Options options;
  options.tolerance_mm = 1e-3;
  Solver solver = kept(robot(), options);
  const std::size_t before = allocation_count();
  int converged = 0;
  double sum = 0;
  for (int round = 0; round < 2000; ++round) {
    joystick.set(solver);
    converged += solver.solve(round % 7 == 0 ? Solver::Start::unloaded : Solver::Start::last_solution).converged();
    sum += solver.pose_at(joystick.number(0, 100)).position_B_mm[0] + solver.wrench_at(30).force_N[0] +
           solver.base_wrench_B().force_N[0] + solver.poses().back().position_B_mm[0] +
           solver.wrenches_B().front().force_N[0] + solver.s_mm()[0];
    sum += solver.by_load(1, 60)(0, 0) + solver.compliance(100)(0, 0) + solver.by_stiffness(1, 100)(0, 0);
    if (round % 10 == 0) sum += solver.error_estimate_mm() + solver.stable().value_or(false);
  }
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(converged, 2000);
  EXPECT_TRUE(std::isfinite(sum));
}

// Planar scenes leave the plane and lose their fixed loads: other kernels, no allocation.
TEST(Solver, LeavesThePlaneWithoutAllocating) {
  scene::Scene scene = uniform_rod(100, slender(1000, 700),
                                   {scene::Force{100, Frame::fixed, {0, 0.1, 0}}, scene::Tendon{{1, 0}, 0, 100}});
  fam::Options options;
  options.tolerance_mm = 1e-6;
  Solver solver = kept(scene, options);
  const std::size_t before = allocation_count();
  const auto expect = [&](const Vector3d& force_N, double tension_N) {
    solver.set_force_N(0, force_N);
    solver.set_tension_N(1, tension_N);
    EXPECT_TRUE(solver.solve().converged());
    const Vector3d tip_mm = solver.tip().position_B_mm;
    EXPECT_TRUE(solver.solve(Solver::Start::unloaded).converged());
    EXPECT_LT((solver.tip().position_B_mm - tip_mm).norm(), 1e-6) << force_N.transpose();
  };
  expect({0, 0.1, 0}, 0);
  expect({0, 0.1, 0.05}, 0);
  expect({0, 0.1, 0.05}, 2);
  expect({0, 0, 0}, 2);
  expect({0, 0, 0}, 0);
  expect({0, 0, 0.1}, 1);
  EXPECT_EQ(allocation_count(), before);
}

// A warm solve starts with the last one's derivatives, and where those of its answer are at hand with the turn that
// they expect of the tip.
TEST(Solver, DerivativesAtHandSaveNewtonSteps) {
  const scene::Scene scene = uniform_rod(100, slender(1000, 700), {scene::Force{100, Frame::fixed, {0, 0.1, 0}}});
  fam::Options options;
  options.tolerance_mm = 1e-3;
  const auto newton_steps = [&](bool asks) {
    Joystick joystick(3);
    Solver solver = kept(scene, options);
    Vector3d force_N(0, 0.1, 0.05);
    int steps = 0;
    for (int round = 0; round < 50; ++round) {
      solver.set_force_N(0, force_N += joystick.vector(0.003));
      const auto outcome = solver.solve();
      EXPECT_TRUE(outcome.converged());
      steps += outcome.newton_steps;
      if (asks) {
        EXPECT_TRUE(solver.by_load(0, 100).allFinite());
      }
    }
    return steps;
  };
  EXPECT_LT(newton_steps(true), newton_steps(false) - 25);
}

// A catheter tube with weight, a tendon and a force at its side: more than one equilibrium for all that its loads tell.
scene::Scene catheter_tube() {
  scene::Stiffness stiffness = slender(191.4, 132);
  stiffness.mass_per_length_kg_per_m = 0.00471;
  return uniform_rod(300, stiffness,
                     {scene::Gravity{{0, -9.81, 0}}, scene::Tendon{{1.2, 0}, 0.5, 300},
                      scene::Force{150, Frame::fixed, {0, 0, 0.02}}});
}

// Where loads that may leave several equilibria change by little, the last solution's derivatives serve: no more Newton
// steps than marches that correct a prediction. They are taken anew as changes add up.
TEST(Solver, SmallChangesNeedFewNewDerivatives) {
  fam::Options options;
  options.tolerance_mm = 0.3;
  Solver solver = kept(catheter_tube(), options);
  ASSERT_TRUE(solver.solve().converged());
  constexpr int solves = 200;
  int newton_steps = 0;
  for (int k = 1; k <= solves; ++k) {
    solver.set_tension_N(1, 0.5 + 0.002 * k);
    const Solver::Outcome outcome = solver.solve();
    ASSERT_TRUE(outcome.converged()) << k;
    EXPECT_EQ(outcome.load_steps, 1);
    newton_steps += outcome.newton_steps;
  }
  EXPECT_LT(newton_steps, 1.5 * solves);  // 2 each with derivatives at the start of every way
  Solver cold = kept(solver.scene(), options);
  ASSERT_TRUE(cold.solve().converged());
  EXPECT_LT(pose_distance_mm(solver.tip(), cold.tip(), 300), 0.02);
  EXPECT_GT(pose_distance_mm(solver.tip(), kept_tip(support::stiffer(solver.scene()), options), 300), 2);
}

// A column pushed past its critical load in steps so small that none needs derivatives of its own. With next to nothing
// across it buckles to that side, in steps as when the load grows at once; on its axis it stays straight, unstable.
TEST(Solver, SmallChangesAddUp) {
  const double EI = 1000, L = 100, euler_N = EI * std::pow(M_PI / (2 * L), 2);
  for (const double across_N : {1e-5, 0.0}) {
    scene::Scene column =
        uniform_rod(L, slender(EI, 700), {scene::Force{L, Frame::fixed, {-0.8 * euler_N, across_N, across_N / 2}}});
    fam::Options options;
    options.tolerance_mm = 1e-4;
    Solver solver = kept(column, options);
    ASSERT_TRUE(solver.solve().converged());
    EXPECT_EQ(solver.stable(), true);
    for (int k = 1; k <= 400; ++k) {
      solver.set_force_N(0, {-(0.8 + 1e-3 * k) * euler_N, across_N, across_N / 2});
      ASSERT_TRUE(solver.solve().converged()) << across_N << ' ' << k;
    }
    EXPECT_EQ(solver.stable(), across_N > 0);
    const Vector3d tip_mm = solver.tip().position_B_mm;
    ASSERT_TRUE(solver.solve(Solver::Start::unloaded).converged());
    EXPECT_LT((solver.tip().position_B_mm - tip_mm).norm(), 2e-4) << across_N;
    EXPECT_EQ(tip_mm[1] > 50, across_N > 0) << tip_mm.transpose();
  }
}

// Small steps pass a critical load of two planes at once, where the determinant keeps its sign, with a force across
// that round-off hides: whatever the rod does there, a straight one is not called stable.
TEST(Solver, SmallChangesHideNoCriticalLoad) {
  const double EI = 1000, L = 100, euler_N = EI * std::pow(M_PI / (2 * L), 2);
  for (const double across_N : {1e-13, 1e-16, 1e-20}) {
    fam::Options options;
    options.tolerance_mm = 1e-4;
    Solver solver =
        kept(uniform_rod(L, slender(EI, 700), {scene::Force{L, Frame::fixed, {-0.9 * euler_N, across_N, 0}}}), options);
    ASSERT_TRUE(solver.solve().converged());
    EXPECT_EQ(solver.stable(), true);
    for (int k = 1; k <= 100; ++k) {
      solver.set_force_N(0, {-(0.9 + 0.0021 * k) * euler_N, across_N, 0});
      solver.solve();
    }
    const double force_N = std::get<scene::Force>(solver.scene().loads[0]).value_N[0];
    const bool straight = std::abs(solver.tip().position_B_mm[0] - L) < 1e-3;
    EXPECT_FALSE(straight && solver.stable() == true) << across_N << ' ' << force_N;
  }
}

// A softer rod starts from the shape of the stiffer one, not from its derivatives: with next to nothing across it they
// would tell of no critical load.
TEST(Solver, ASofterRodBucklesAsFromNoLoad) {
  const double EI = 1000, L = 100, euler_N = EI * std::pow(M_PI / (2 * L), 2);
  fam::Options options;
  options.tolerance_mm = 1e-4;
  for (const double across_N : {1e-3, 1e-8}) {
    const scene::Scene column =
        uniform_rod(L, slender(EI, 700), {scene::Force{L, Frame::fixed, {-0.8 * euler_N, across_N, across_N / 2}}});
    for (const double share : {0.9, 0.7, 0.5}) {
      Solver solver = kept(column, options);
      ASSERT_TRUE(solver.solve().converged());
      solver.set_stiffness_Nmm2(0, share * Vector3d(700, EI, EI));
      ASSERT_TRUE(solver.solve().converged());
      EXPECT_EQ(solver.stable(), true);
      const Vector3d tip_mm = solver.tip().position_B_mm;
      ASSERT_TRUE(solver.solve(Solver::Start::unloaded).converged());
      EXPECT_LT((solver.tip().position_B_mm - tip_mm).norm(), 2e-3) << across_N << ' ' << share;
    }
  }
}

// A column beyond its critical load that is straight for want of anything across it: pushed aside it answers as the
// unstable rod that it is, and so it does after that.
TEST(Solver, SmallChangesOfAnUnstableRodLeaveItSo) {
  const double EI = 1000, L = 100, euler_N = EI * std::pow(M_PI / (2 * L), 2);
  fam::Options options;
  options.tolerance_mm = 1e-6;
  Solver solver =
      kept(uniform_rod(L, slender(EI, 700), {scene::Force{L, Frame::fixed, {-1.5 * euler_N, 0, 0}}}), options);
  ASSERT_TRUE(solver.solve().converged());
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(solver.stable(), false) << k;
    solver.set_force_N(0, {-1.5 * euler_N, 1e-4 * (k + 1), 5e-5 * (k + 1)});
    ASSERT_TRUE(solver.solve().converged()) << k;
    EXPECT_LT(solver.tip().position_B_mm[1], 0) << k;  // against the force
  }
  solver.set_force_N(0, {-1.15 * euler_N, 5e-4, 2.5e-4});
  EXPECT_TRUE(solver.solve().converged());
  EXPECT_EQ(solver.stable(), false);
}

// Warm and cold lead to one answer where the rod has but one; the twin, a stiffer rod, is seen.
TEST(Solver, WarmIsCold) {
  Joystick joystick(2);
  fam::Options options;
  options.tolerance_mm = 1e-7;
  Solver warm = kept(robot(), options), cold = kept(robot(), options);
  double worst_mm = 0, stiffer_mm = 0;
  for (int round = 0; round < 200; ++round) {
    joystick.set(warm);
    ASSERT_TRUE(warm.solve().converged()) << round;
    cold = kept(warm.scene(), options);
    ASSERT_TRUE(cold.solve().converged()) << round;
    worst_mm = std::max(worst_mm, pose_distance_mm(warm.tip(), cold.tip(), 100));
    if (round < 10) {
      Solver stiffer = kept(support::stiffer(warm.scene()), options);
      stiffer.solve();
      stiffer_mm = std::max(stiffer_mm, pose_distance_mm(warm.tip(), stiffer.tip(), 100));
    }
  }
  EXPECT_LT(worst_mm, 1e-6);
  EXPECT_GT(stiffer_mm, 0.1);
}

TEST(Solver, GoesBackToTheSolutionBefore) {
  Solver solver = kept(uniform_rod(100, slender(1000, 700), {scene::Force{100, Frame::fixed, {0, 0.1, 0}}}), {});
  EXPECT_FALSE(solver.go_back());
  ASSERT_TRUE(solver.solve().converged());
  EXPECT_FALSE(solver.go_back());
  const Vector3d first_mm = solver.tip().position_B_mm;
  const Solver::Matrix63 first_slope = solver.by_load(0, 100);
  solver.set_force_N(0, {0, 0.2, 0.1});
  ASSERT_TRUE(solver.solve().converged());
  const Vector3d second_mm = solver.tip().position_B_mm;
  ASSERT_GT((second_mm - first_mm).norm(), 1);
  EXPECT_TRUE(solver.go_back());
  EXPECT_EQ(solver.tip().position_B_mm, first_mm);
  EXPECT_EQ(solver.by_load(0, 100), first_slope);
  EXPECT_TRUE(solver.go_back());
  EXPECT_EQ(solver.tip().position_B_mm, second_mm);
  EXPECT_TRUE(solver.go_back());
  EXPECT_TRUE(solver.solve().converged());  // the values set stay: from the first solution to the second's loads
  EXPECT_LT((solver.tip().position_B_mm - second_mm).norm(), 1e-3);
}

// Against the exact reference, along the whole rod.
TEST(Solver, PosesAndWrenchesAreExact) {
  Joystick joystick(3);
  fam::Options options;
  options.tolerance_mm = 1e-8;
  Solver solver = kept(robot(), options);
  for (int round = 0; round < 12; ++round) {
    joystick.set(solver);
    ASSERT_TRUE(solver.solve().converged());
    const scene::Equilibrium exact = exact_reference::solve(solver.scene());
    ASSERT_TRUE(exact.converged());
    double pose_mm = 0, wrench = 0;
    for (const scene::Station& station : exact.stations) {
      pose_mm = std::max(pose_mm, pose_distance_mm(solver.pose_at(station.s_mm), station.X_BS, 100));
      const scene::Wrench own = solver.wrench_at(station.s_mm);
      wrench = std::max(
          {wrench, 100 * (own.force_N - station.force_B_N).norm(), (own.moment_Nmm - station.moment_B_Nmm).norm()});
    }
    EXPECT_LT(pose_mm, 1e-6) << round;
    EXPECT_LT(wrench, 1e-6) << round;  // N mm
    EXPECT_LT(solver.error_estimate_mm(), 1e-8);
    EXPECT_EQ(solver.stable(), fam::solve(solver.scene()).stable);
  }
}

// A buckled strip under 1.1 of Euler's load, pushed sideways.
scene::Scene pushed_strip(double side_N) {
  const double EI = 1000, L = 100, euler_N = EI * std::pow(M_PI / (2 * L), 2);
  scene::Stiffness strip = slender(EI, EI);
  strip.bending_Nmm2[0] = 3 * EI;  // does not give way sideways
  return uniform_rod(L, strip, {scene::Force{L, Frame::fixed, {-1.1 * euler_N, side_N, 0}}});
}

// A column beyond its Euler load, bent to one side by a small force, is pushed over to the other: it snaps at a fold.
TEST(Solver, StopsAtAFoldAndKeepsItsSolution) {
  const scene::Scene scene = pushed_strip(1e-2);
  const double push_N = std::get<scene::Force>(scene.loads[0]).value_N[0];
  fam::Options options;
  options.tolerance_mm = 1e-6;
  Solver solver = kept(scene, options);
  ASSERT_TRUE(solver.solve().converged());
  const double bent_mm = solver.tip().position_B_mm[1];
  ASSERT_GT(bent_mm, 30);
  solver.set_force_N(0, {push_N, -6e-3, 0});  // past zero, not yet at the fold
  EXPECT_TRUE(solver.solve().converged());
  EXPECT_GT(solver.tip().position_B_mm[1], 30);
  EXPECT_EQ(solver.stable(), true);
  const Vector3d held_mm = solver.tip().position_B_mm;
  solver.set_force_N(0, {push_N, -1e-2, 0});
  const Solver::Outcome outcome = solver.solve();
  EXPECT_EQ(outcome.status, Status::limit_point) << outcome.message;
  EXPECT_LT(outcome.newton_steps, 150);  // 126: its load is foretold from six places; closed in on, 246
  EXPECT_EQ(solver.tip().position_B_mm, held_mm);
  EXPECT_TRUE(solver.solve(Solver::Start::unloaded).converged());
  EXPECT_NEAR(solver.tip().position_B_mm[1], -bent_mm, 1e-6);
}

// A fold is met twice, on twice the arcs the second time, with 126 steps each: all of them count.
TEST(Solver, EndsAfterAsManyNewtonStepsInAllAsItMayTake) {
  const scene::Scene scene = pushed_strip(1e-2);
  Solver solver = kept(scene, {.tolerance_mm = 1e-6});
  ASSERT_TRUE(solver.solve().converged());
  const double push_N = std::get<scene::Force>(scene.loads[0]).value_N[0];
  solver.set_force_N(0, {push_N, -6e-3, 0});
  ASSERT_TRUE(solver.solve().converged());
  solver.set_force_N(0, {push_N, -1e-2, 0});
  EXPECT_EQ(solver.solve(Solver::Start::last_solution, 200).status, Status::work_limit);
  EXPECT_EQ(solver.solve(Solver::Start::last_solution, 400).status, Status::limit_point);
}

// A bent column whose side force comes to all but the opposite side turns about its axis, past where that force nearly
// vanishes: a long way.
TEST(Solver, EndsAfterAsManyNewtonStepsAsItMayTake) {
  const scene::Scene scene =
      uniform_rod(40, slender(1500, 1000), {scene::Force{40, Frame::fixed, {-2.3, 0.017, 0.041}}});
  fam::Options options;
  options.reserved_arcs = 6;  // not for twice the arcs, which a solve tries whose load is not reached
  Solver solver = kept(scene, options);
  ASSERT_TRUE(solver.solve(Solver::Start::last_solution, 100).converged());
  const Vector3d held_mm = solver.tip().position_B_mm;
  solver.set_force_N(0, {-2.9, -0.094, -0.229});
  const Solver::Outcome outcome = solver.solve(Solver::Start::last_solution, 40);
  EXPECT_EQ(outcome.status, Status::work_limit) << outcome.message;
  EXPECT_GT(outcome.newton_steps, 40);
  EXPECT_LE(outcome.newton_steps, 60);  // a load step takes up to max_newton_steps = 20
  EXPECT_EQ(solver.tip().position_B_mm, held_mm);
  EXPECT_GT(solver.solve().newton_steps, 100);
  EXPECT_LT((solver.tip().position_B_mm - kept_tip(solver.scene(), options).position_B_mm).norm(), 1e-3 * 40);
}

// A refused value leaves all as it was, and is told as the scene format tells it.
// Timoshenko's beam: L^3/3EI + L/kGA across, L/EA along. Under no load neither moves the tip.
TEST(Solver, ShearAndStretchShowInDerivatives) {
  const double L = 20, EI = 1500, EA = 300, kGA = 100;
  scene::Stiffness stub = slender(EI, 1000);
  stub.axial_N = EA;
  stub.shear_N = Eigen::Vector2d(kGA, kGA);
  const auto compliance = [&](const scene::Stiffness& stiffness, double tolerance_mm) {
    Solver solver = kept(uniform_rod(L, stiffness, {scene::Force{L, Frame::fixed, Vector3d::Zero()}}),
                         {.tolerance_mm = tolerance_mm});
    EXPECT_TRUE(solver.solve().converged());
    return Solver::Matrix6(solver.compliance(L));
  };
  const auto is_timoshenkos = [&](const Solver::Matrix6& C) {
    return std::abs(C(0, 0) - L / EA) < 1e-7 && std::abs(C(1, 1) - L * L * L / (3 * EI) - L / kGA) < 1e-7;
  };
  EXPECT_TRUE(is_timoshenkos(compliance(stub, 2e-8)));
  EXPECT_TRUE(is_timoshenkos(compliance(stub, 0)));
  scene::Stiffness stiffer = stub;
  *stiffer.shear_N *= 1.05;
  EXPECT_FALSE(is_timoshenkos(compliance(stiffer, 2e-8)));

  // So they do where a section becomes stiffer against bending alone.
  stub.bending_Nmm2 = {0.5, 0.5};
  Solver solver = kept(uniform_rod(L, stub, {scene::Force{L, Frame::fixed, Vector3d::Zero()}}), {});
  solver.set_stiffness_Nmm2(0, {1000, EI, EI});
  ASSERT_TRUE(solver.solve().converged());
  EXPECT_TRUE(is_timoshenkos(solver.compliance(L)));
}

// Bounds know no stretch, and arcs grow with it. Limit: the tolerance; the exact reference.
TEST(Solver, StretchedRodsTakeMoreArcs) {
  scene::Stiffness soft = slender(750, 1000);
  soft.bending_Nmm2 = {750, 900};
  soft.shear_N = Eigen::Vector2d(99.3, 99.3);
  const double L = 0.24;
  const scene::Scene scene = uniform_rod(L, soft,
                                         {scene::Moment{L, Frame::fixed, {-2300, -2850, 3500}},
                                          scene::DistributedForce{0, L, Frame::fixed, {0, -1.1e5, -3.2e4}}});
  for (const double share : {1e-3, 1e-5}) {
    Solver solver = kept(scene, {.tolerance_mm = share * L});
    ASSERT_TRUE(solver.solve().converged());
    const auto error_mm = [&](const scene::Scene& of) {
      return (solver.tip().position_B_mm - exact_reference::solve(of).tip().position_B_mm).norm();
    };
    EXPECT_LT(error_mm(scene), share * L);
    EXPECT_GT(error_mm(support::stiffer(scene)), share * L);
  }
}

TEST(Solver, RefusesWrongOptions) {
  const auto refusal = [](const fam::Options& options) -> std::string {
    std::string first;
    for (const auto& call : {std::function([&] { Solver::make(robot(), options); }),
                             {[&] { fam::solve(robot(), options); }},
                             {[&] { fam::solve_batch(robot(), {}, fam::RowMajorMatrix(1, 0), options); }}}) {
      try {
        call();
        return "accepted";
      } catch (const scene::SceneError& error) {
        EXPECT_TRUE(first.empty() || first == error.what()) << first;
        first = error.what();
      }
    }
    return first;
  };
  EXPECT_EQ(refusal({.tolerance_mm = std::nan("")}), "options.tolerance_mm = nan: must be finite and >= 0");
  EXPECT_EQ(refusal({.tolerance_mm = -1}), "options.tolerance_mm = -1: must be finite and >= 0");
  EXPECT_EQ(refusal({.arcs = -3}), "options.arcs = -3: must be >= 0");
  EXPECT_EQ(refusal({.arcs = 2'000'000}), "options.arcs = 2e+06: must be <= 1000000");
  EXPECT_EQ(refusal({.reserved_arcs = -1}), "options.reserved_arcs = -1: must be >= 0");
  EXPECT_EQ(refusal({}), "accepted");
}

TEST(Solver, RefusesWrongValues) {
  Solver solver = kept(robot(), {});
  solver.solve();
  const auto message = [&](auto&& change) -> std::string {
    try {
      change();
    } catch (const scene::SceneError& error) {
      return error.what();
    }
    return "accepted";
  };
  const double nan = std::nan("");
  EXPECT_EQ(message([&] {
              solver.set_force_N(3, {0, nan, 0});
            }),
            "scene: loads[3].value_N = [0, nan, 0]: must be finite");
  EXPECT_EQ(message([&] { solver.set_tension_N(1, -1); }), "scene: loads[1].tension_N = -1: must be >= 0");
  EXPECT_EQ(message([&] { solver.set_at_mm(3, 101); }),
            "scene: loads[3].at = 101: must lie on the rod, 0 < s <= 100 mm");
  EXPECT_EQ(message([&] { solver.set_force_N(1, {0, 0, 0}); }), "scene: loads[1].kind = tendon: must be force");
  EXPECT_EQ(message([&] { solver.set_moment_Nmm(7, {0, 0, 0}); }), "scene: loads[7]: there are 7 loads");
  EXPECT_EQ(message([&] {
              solver.set_rest_curvature_per_mm(2, {0, 0, 0});
            }),
            "scene: rod.sections[2]: there are 2 sections");
  EXPECT_EQ(message([&] {
              solver.set_rest_curvature_per_mm(0, {0, 0, nan});
            }),
            "scene: rod.sections[0].rest_curvature_per_mm = [0, 0, nan]: must be finite");
  EXPECT_EQ(message([&] {
              solver.set_stiffness_Nmm2(1, {1, -2, 1});
            }),
            "scene: rod.sections[1].stiffness.bending_Nmm2 = [-2, 1]: must be > 0");
  const Vector3d before_mm = solver.tip().position_B_mm;
  EXPECT_TRUE(solver.solve(Solver::Start::unloaded).converged());
  EXPECT_EQ(solver.tip().position_B_mm, before_mm);
}

TEST(Solver, IsNaNWithoutAnAnswer) {
  Solver solver = kept(robot(), {});
  EXPECT_TRUE(solver.tip().position_B_mm.array().isNaN().all());
  EXPECT_TRUE(solver.poses().empty());
  EXPECT_TRUE(std::isnan(solver.error_estimate_mm()));
  EXPECT_TRUE(solver.compliance(50).array().isNaN().all());
  solver.solve();
  for (const double s_mm : {-1e-9, 100.1, std::nan("")}) {
    EXPECT_TRUE(solver.pose_at(s_mm).position_B_mm.array().isNaN().all());
    EXPECT_TRUE(solver.wrench_at(s_mm).force_N.array().isNaN().all());
  }
  EXPECT_TRUE(solver.pose_at(0).position_B_mm.isZero(0));
  EXPECT_FALSE(solver.tip().position_B_mm.array().isNaN().any());
}

// More arcs than memory was taken for.
TEST(Solver, EndsWhereItsMemoryEnds) {
  fam::Options options;
  options.tolerance_mm = 1e-5;
  options.reserved_arcs = 20;
  scene::Scene scene = uniform_rod(100, slender(1000, 700), {scene::Force{100, Frame::fixed, {0, 0.1, 0}}});
  Solver solver = kept(scene, options);
  ASSERT_TRUE(solver.solve().converged());
  const Vector3d held_mm = solver.tip().position_B_mm;
  solver.set_force_N(0, {0, 50, 0});
  const std::size_t before = allocation_count();
  EXPECT_EQ(solver.solve().status, Status::tolerance_not_met);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(solver.tip().position_B_mm, held_mm);
}

// The same rod where no memory is reserved.
TEST(Solver, TakesMemoryAsItNeedsIt) {
  fam::Options options;
  options.tolerance_mm = 1e-5;
  options.reserved_arcs = 0;
  const auto under = [](double force_N) {
    return uniform_rod(100, slender(1000, 700), {scene::Force{100, Frame::fixed, {0, force_N, 0}}});
  };
  Solver solver = kept(under(0.1), options);
  ASSERT_TRUE(solver.solve().converged());
  solver.set_force_N(0, {0, 50, 0});
  const std::size_t before = allocation_count();
  ASSERT_TRUE(solver.solve().converged());
  EXPECT_GT(allocation_count(), before);
  const scene::Equilibrium exact = exact_reference::solve(under(50), {exact_reference::RodModel::kirchhoff});
  EXPECT_LT((solver.tip().position_B_mm - exact.tip().position_B_mm).norm(), 1e-5);
  const scene::Equilibrium stiffer =
      exact_reference::solve(support::stiffer(under(50)), {exact_reference::RodModel::kirchhoff});
  EXPECT_GT((solver.tip().position_B_mm - stiffer.tip().position_B_mm).norm(), 1e-2);
  options.arcs = 70'000;  // more than are taken unasked
  EXPECT_TRUE(kept(under(0.1), options).solve().converged());
}

// Loads whose squares overflow are no loads that can be solved, nor none.
TEST(Solver, LoadsThatOverflow) {
  for (const double force_N : {1e155, 1e160, 1e300}) {
    const scene::Scene scene = uniform_rod(100, slender(1000, 700), {scene::Force{100, Frame::fixed, {0, 0, force_N}}});
    EXPECT_EQ(fam::solve(scene).status, Status::not_finite) << force_N;
    EXPECT_EQ(kept(scene, {}).solve().status, Status::tolerance_not_met) << force_N;  // too many arcs for its memory
  }
}

// The derivatives of the solution found last against differences of the solver; test_derivatives has check values.
TEST(Solver, DerivativesOfWarmSolutions) {
  fam::Options options;
  options.tolerance_mm = 1e-9;
  Joystick joystick(4);
  Solver solver = kept(robot(), options);
  for (int round = 0; round < 5; ++round) {
    joystick.set(solver);
    ASSERT_TRUE(solver.solve().converged());
    const Eigen::Matrix<double, 6, 3> by_force = solver.by_load(3, 100);
    const Eigen::Matrix<double, 6, 1> by_tension = solver.by_load(1, 70).col(0);
    const double scale = by_force.cwiseAbs().maxCoeff();
    EXPECT_LT((by_force - solver.compliance(100).leftCols<3>()).cwiseAbs().maxCoeff(), 1e-12 * scale);
    const Vector3d force_N = std::get<scene::Force>(solver.scene().loads[3]).value_N;
    const double tension_N = std::get<scene::Tendon>(solver.scene().loads[1]).tension_N, step = 1e-4;
    const auto position_mm = [&](double s_mm) {
      EXPECT_TRUE(solver.solve().converged());
      return Vector3d(solver.pose_at(s_mm).position_B_mm);
    };
    solver.set_force_N(3, force_N + Vector3d(0, step, 0));
    const Vector3d up_mm = position_mm(100);
    solver.set_force_N(3, force_N - Vector3d(0, step, 0));
    const Vector3d down_mm = position_mm(100);
    EXPECT_LT(((up_mm - down_mm) / (2 * step) - by_force.block<3, 1>(0, 1)).norm(), 1e-5 * scale) << round;
    solver.set_force_N(3, force_N);
    solver.set_tension_N(1, tension_N + 2 * step);
    const Vector3d more_mm = position_mm(70);
    solver.set_tension_N(1, tension_N + step);
    const Vector3d some_mm = position_mm(70);
    solver.set_tension_N(1, tension_N);
    const Vector3d none_mm = position_mm(70);
    EXPECT_LT(((4 * some_mm - 3 * none_mm - more_mm) / (2 * step) - by_tension.head<3>()).norm(),
              1e-5 * by_tension.norm())
        << round;
  }
}

// fam::solve() itself: a thread keeps what a small rod took and gives back what a large one did.
TEST(Solve, TakesMemoryOnce) {
  const scene::Scene easy = uniform_rod(100, slender(750, 500), {scene::Force{100, Frame::fixed, {0, 0.05, 0.02}}});
  fam::Options many;
  many.arcs = 200;
  scene::Equilibrium first, again, after_many;
  ASSERT_EQ(fam::solve(easy, many).status, Status::converged);
  const std::size_t anew = allocations_of(easy, first);
  EXPECT_LT(4 * allocations_of(easy, again), anew);  // those of the answer's lists
  ASSERT_EQ(fam::solve(easy, many).status, Status::converged);
  EXPECT_EQ(allocations_of(easy, after_many), anew);
  scene::Scene loaded = easy;
  loaded.loads.resize(100, scene::Force{100, Frame::fixed, {0, 1e-4, 0}});
  ASSERT_EQ(fam::solve(loaded).status, Status::converged);
  EXPECT_EQ(allocations_of(easy, after_many), anew);
  for (const scene::Equilibrium* result : {&again, &after_many}) {
    ASSERT_EQ(result->status, Status::converged);
    EXPECT_EQ(result->stations.back().X_BS.position_B_mm, first.stations.back().X_BS.position_B_mm);
  }
}

}  // namespace
