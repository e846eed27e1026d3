// Fixed, mixed, distributed loads and gravity: the boundary value problem over the arcs against the exact reference.
#include "allocation_counter.h"
#include "exact_reference/solve.h"
#include "fam/boundary_value.h"
#include "fam/load_length.h"
#include "fam/tolerance.h"
#include "scene/scene_file.h"
#include "scene/span_facts.h"
#include "support.h"
#include "support_fam.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <numbers>
#include <random>

namespace {

using Eigen::Vector3d;
using fam::Law;
using scene::Frame;
using support::fact;
using support::slender;
using support::uniform_rod;

constexpr double pi = std::numbers::pi;

scene::Equilibrium solved(const scene::Scene& scene, double tolerance_mm) {
  fam::Options options;
  options.tolerance_mm = tolerance_mm;
  scene::Equilibrium result = fam::solve(scene, options);
  EXPECT_TRUE(result.converged()) << scene.title << " " << result.message;
  return result;
}

double distance_mm(const scene::Equilibrium& a, const scene::Equilibrium& b) {
  if (!a.converged() || !b.converged()) return INFINITY;
  return (a.tip().position_B_mm - b.tip().position_B_mm).norm();
}

scene::Scene tip_force(const scene::Stiffness& stiffness, const Vector3d& force_N, double length_mm = 40) {
  return uniform_rod(length_mm, stiffness, {scene::Force{length_mm, Frame::fixed, force_N}});
}

// Tips by collocation with continuation, independent of this project.
TEST(BoundaryValue, CheckValues) {
  struct Check {
    scene::Scene scene;
    Vector3d tip_mm;
    double limit_mm;
  };
  const Vector3d direction(-0.3, 0.8, 0.6);
  const std::vector<Check> checks = {
      {tip_force(slender(750, 500), {0, 1, 0}), {33.03110716, 20.47065732, 0}, 1e-7},
      {tip_force(slender(1500, 1000), 100 * direction), {-4.7903, 29.7072, 22.2804}, 1e-4},
      {tip_force(slender(1500, 1000), 1000 * direction), {-9.37405, 30.35216, 22.76412}, 1e-5}};
  for (const Check& check : checks) {
    const scene::Equilibrium result = solved(check.scene, 1e-7);
    EXPECT_LT((result.tip().position_B_mm - check.tip_mm).norm(), check.limit_mm);
    EXPECT_EQ(result.stable, true);
    const scene::Equilibrium stiff = solved(support::stiffer(check.scene), 1e-7);
    EXPECT_GT((stiff.tip().position_B_mm - check.tip_mm).norm(), check.limit_mm);
  }
}

// Study I, fixed loads, against the independent tips of tests/data.
TEST(BoundaryValue, GatesOfStudy1) {
  const double limit_mm = 1e-7;
  for (const std::string& name : support::study1_cases()) {
    const Vector3d exact_mm = support::study1_tip_mm(name, "fixed", "reissner");
    const scene::Scene scene = support::study1_scene(name, "fixed");
    EXPECT_LT((solved(scene, limit_mm).tip().position_B_mm - exact_mm).norm(), limit_mm) << name;
    EXPECT_GT((solved(support::stiffer(scene), limit_mm).tip().position_B_mm - exact_mm).norm(), limit_mm) << name;
  }
}

// Any direction but near pure compression, |F| L^2 / EI up to 1000: the stable branch, within 1e-7 L of exact.
TEST(BoundaryValue, LargeFixedTipForces) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  for (const double load : {5.0, 30.0, 200.0, 1000.0}) {
    for (int i = 0; i < 6; ++i) {
      const Vector3d direction = Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
      const scene::Scene scene = tip_force(slender(1500, 1000), load * 1500 / 1600 * direction);
      const scene::Equilibrium result = solved(scene, 0.9e-7 * 40);
      EXPECT_LT(distance_mm(result, exact_reference::solve(scene)), 1e-7 * 40) << load << " " << direction.transpose();
      EXPECT_EQ(result.stable, true);
    }
  }
}

TEST(BoundaryValue, ObservedOrders) {
  const scene::Scene scene =
      uniform_rod(40, slender(1500, 1000),
                  {scene::Force{40, Frame::fixed, {-0.5, 0.8, 0.6}}, scene::Moment{40, Frame::fixed, {10, 20, -15}},
                   scene::DistributedForce{0, 40, Frame::fixed, {0, 0.02, -0.03}},
                   scene::DistributedForce{0, 40, Frame::follower, {0.01, 0.01, 0.02}}});
  const scene::Equilibrium exact = exact_reference::solve(scene);
  for (const auto& [law, order] :
       {std::pair{Law::midpoint, 2}, std::pair{Law::fourth_order, 4}, std::pair{Law::sixth_order, 6}}) {
    fam::Options options;
    options.law = law;
    options.estimate_error = false;
    options.arcs = order == 6 ? 8 : 32;
    const double coarse = distance_mm(fam::solve(scene, options), exact);
    options.arcs *= 2;
    EXPECT_NEAR(std::log2(coarse / distance_mm(fam::solve(scene, options), exact)), order, order == 6 ? 0.4 : 0.1);
  }
}

// A straight rod on its axis is an equilibrium under any load, and solved for at once; whether it stays there its second
// variation tells. Euler: pi^2/4 EI/L^2.
TEST(BoundaryValue, OnItsAxisARodIsSolvedAtOnce) {
  for (const double times : {-1.01, -0.99, -360., 360.}) {
    const double force_N = times * pi * pi / 4 * 750 / 1600;
    const scene::Equilibrium column = solved(tip_force(slender(750, 500), {force_N, 0, 0}), 0.04);
    EXPECT_EQ(fact(column, "load_steps"), 1);
    EXPECT_LT((column.tip().position_B_mm - Vector3d(40, 0, 0)).norm(), 1e-12 * 40);
    EXPECT_EQ(column.stable, times > -1);
  }
}

// Small forces leave a coil with a tendon but a minimum of its energy: no load has to grow, nothing else has to tell
// its stability, and the derivatives of a rigid rod lead there.
TEST(BoundaryValue, SmallForcesOnACoilAreSolvedAtOnce) {
  for (const double turn_rad : {1., 6.}) {
    scene::Scene coil = tip_force({80, {100, 150}, {}, {}, 0}, {7.2e-4, 1.92e-3, -1.2e-3}, 100);
    coil.loads.push_back(scene::Tendon{{1, 1}, 0.2 * turn_rad, 100});
    coil.sections[0].rest_curvature_per_mm = turn_rad * Vector3d(2e-3, 6e-3, 7e-3);
    const scene::Equilibrium answer = solved(coil, 0.1), exact = exact_reference::solve(coil);
    EXPECT_EQ(fact(answer, "load_steps"), 1);
    EXPECT_LE(fact(answer, "newton_iterations"), turn_rad > 1 ? 7 : 2);
    EXPECT_EQ(answer.stable, true);
    EXPECT_EQ(exact.stable, true);
    EXPECT_LT(distance_mm(answer, exact), 0.1);
    EXPECT_GT(distance_mm(answer, exact_reference::solve(support::stiffer(coil))), 0.2);
  }
}

// Euler: an axial force just beyond pi^2 EI / (4 L^2). Exactly on the axis the straight rod, unstable; with a small
// lateral force the buckled shape, stable; just below it the straight rod, stable.
TEST(BoundaryValue, EulerColumn) {
  const double critical_N = pi * pi * 750 / (4 * 1600);
  const scene::Equilibrium below = solved(tip_force(slender(750, 500), {-0.999 * critical_N, 0, 0}), 1e-3);
  EXPECT_EQ(below.stable, true);
  const scene::Equilibrium beyond = solved(tip_force(slender(750, 500), {-1.001 * critical_N, 0, 0}), 1e-3);
  EXPECT_EQ(beyond.stable, false);
  EXPECT_NEAR(beyond.tip().position_B_mm[0], 40, 1e-9);
  const scene::Scene pushed = tip_force(slender(750, 500), {-1.05 * critical_N, 1e-3, 0});
  const scene::Equilibrium buckled = solved(pushed, 1e-6);
  EXPECT_EQ(buckled.stable, true);
  EXPECT_GT(buckled.tip().position_B_mm[1], 10);
  EXPECT_LT(distance_mm(buckled, exact_reference::solve(pushed)), 1e-6);
}

// Greatest height of a column under its own weight: 7.8373 EI / L^3 (06_critical_load_constants.csv).
TEST(BoundaryValue, HeavyColumn) {
  for (const auto& [factor, expected] : {std::pair{0.999, true}, std::pair{1.001, false}}) {
    const double weight = factor * 7.837347 * 750 / (40 * 40 * 40);
    const scene::Scene scene =
        uniform_rod(40, slender(750, 500), {scene::DistributedForce{0, 40, Frame::fixed, {-weight, 0, 0}}});
    EXPECT_EQ(solved(scene, 1e-3).stable, expected) << factor;
  }
}

TEST(BoundaryValue, StabilityIsLeftOpenWithoutAnEnergy) {
  scene::Scene scene = tip_force(slender(750, 500), {0, 1, 0});
  EXPECT_TRUE(solved(scene, 1e-3).stable.has_value());
  scene.loads.push_back(scene::Moment{40, Frame::fixed, {0, 0, 1}});
  EXPECT_FALSE(solved(scene, 1e-3).stable.has_value());
}

// A pair of tendons at +-y with tensions T1, T2: constant curvature (T1 - T2) d / EI, also beside gravity = 0.
TEST(BoundaryValue, TendonPair) {
  const double d = 1.5, curvature = (5.0 - 2.0) * d / 750;
  const scene::Scene scene = uniform_rod(
      40, slender(750, 500),
      {scene::Tendon{{d, 0}, 5, 40}, scene::Tendon{{-d, 0}, 2, 40}, scene::Force{20, Frame::fixed, {0, 0, 0}}});
  const Vector3d arc(std::sin(40 * curvature) / curvature, (1 - std::cos(40 * curvature)) / curvature, 0);
  EXPECT_LT((solved(scene, 1e-6).tip().position_B_mm - arc).norm(), 1e-9);
}

// Random scenes of every combination of load kinds (fixed seed): within the tolerance of the exact reference.
scene::Scene random_scene(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) -> Vector3d {
    return size * Vector3d(normal(generator), normal(generator), normal(generator));
  };
  scene::Scene scene;
  const int sections = 1 + static_cast<int>(3 * uniform(generator));
  for (int i = 0; i < sections; ++i) {
    scene::Section section;
    section.length_mm = 10 + 30 * uniform(generator);
    scene::Stiffness stiffness = support::random_stiffness(generator);
    if (uniform(generator) < 0.5) stiffness.axial_N = 200 + 300 * uniform(generator);
    if (uniform(generator) < 0.5) stiffness.shear_N = Eigen::Vector2d(80, 120);
    stiffness.mass_per_length_kg_per_m = uniform(generator);
    section.cross_section = stiffness;
    if (uniform(generator) < 0.3) section.rest_curvature_per_mm = vector(0.01);
    scene.sections.push_back(section);
  }
  const double length = scene::length_mm(scene);
  const double force = 750 / (length * length) * (0.3 + 2 * uniform(generator));
  const auto frame = [&] { return uniform(generator) < 0.5 ? Frame::fixed : Frame::follower; };
  const auto place = [&] { return uniform(generator) < 0.5 ? length : length * (0.05 + 0.9 * uniform(generator)); };
  scene.loads.push_back(scene::Force{place(), Frame::fixed, vector(force)});
  if (uniform(generator) < 0.5) scene.loads.push_back(scene::Force{place(), frame(), vector(force)});
  if (uniform(generator) < 0.5) scene.loads.push_back(scene::Moment{place(), frame(), vector(0.3 * force * length)});
  if (uniform(generator) < 0.5) {
    const double from = length * 0.5 * uniform(generator);
    scene.loads.push_back(scene::DistributedForce{from, from + 0.4 * length, frame(), vector(force / length)});
  }
  if (uniform(generator) < 0.3) scene.loads.push_back(scene::Gravity{{0.3, 0.2, -9.81}});
  if (uniform(generator) < 0.3) scene.loads.push_back(scene::Tendon{{1, 0.5}, 2, place()});
  return scene;
}

TEST(BoundaryValue, RandomScenes) {
  std::mt19937 generator(5);
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    scene::Scene scene = random_scene(generator);
    scene.title = "random scene " + std::to_string(i);
    const scene::Equilibrium exact = exact_reference::solve(scene);
    if (!exact.converged()) continue;
    const double tolerance_mm = 1e-6;
    EXPECT_LT(distance_mm(solved(scene, tolerance_mm), exact), tolerance_mm) << scene.title;
    EXPECT_EQ(solved(scene, tolerance_mm).stable, exact.stable) << scene.title;
    ++compared;
  }
  EXPECT_GE(compared, 98);
}

// The twin of all gates against the exact reference: a stiffer rod is far off.
TEST(BoundaryValue, AStifferRodIsSeen) {
  std::mt19937 generator(5);
  for (int i = 0; i < 10; ++i) {
    const scene::Scene scene = random_scene(generator);
    EXPECT_GT(distance_mm(solved(support::stiffer(scene), 1e-6), exact_reference::solve(scene)), 1e-3);
  }
}

TEST(BoundaryValue, OneSegmentSolvesWithoutAllocating) {
  fam::Options options;
  options.arcs = 12;
  fam::Solver solver = support::kept(tip_force(slender(750, 500), {0, 1, 0}), options);
  const std::size_t before = allocation_count();
  EXPECT_TRUE(solver.solve().converged());
  EXPECT_EQ(allocation_count(), before);
  EXPECT_LT((solver.tip().position_B_mm - Vector3d(33.03110716, 20.47065732, 0)).norm(), 2e-4);
}

// Load growth with several segments: in the plane and in space, with a branch to watch, tendons and no energy.
std::vector<scene::Scene> scenes_with_load_growth() {
  std::vector<scene::Scene> scenes = {tip_force(slender(750, 500), {-0.5, 8, 0}),
                                      tip_force(slender(750, 500), {-4, 8, 3})};
  for (std::size_t i = 0; i < 2; ++i) {
    for (const scene::Load& load : {scene::Load(scene::Tendon{{1, 0}, 2, 30}),
                                    scene::Load(scene::DistributedForce{0, 40, Frame::follower, {0, 0.01, 0}})}) {
      scenes.push_back(scenes[i]);
      scenes.back().loads.push_back(load);
    }
  }
  return scenes;
}

TEST(BoundaryValue, LoadGrowthDoesNotAllocate) {
  for (const scene::Scene& scene : scenes_with_load_growth()) {
    const std::vector<scene::Span> spans = scene::spans_of(scene);
    const fam::GrowingLoads loads(spans);
    const auto expect_none = [&](auto solver) {
      solver.set(loads.way(), scene::cells_per_span(spans, 12), Law::sixth_order, fam::RodModel::kirchhoff);
      const std::size_t before = allocation_count();
      EXPECT_EQ(solver.run(), scene::Status::converged);
      EXPECT_EQ(allocation_count(), before);
      EXPECT_GT(solver.load_steps(), 1);
      EXPECT_GT(solver.segment_count(), 1);
    };
    expect_none(fam::BoundaryValue());
    const std::optional<Eigen::Vector2d> plane = scene::plane_direction(spans);
    if (plane && (*plane)[1] == 0) expect_none(fam::BasicBoundaryValue<2>());  // which solves nothing out of x-y
  }
}

TEST(BoundaryValue, NewtonStepsAreThoseOfOneRun) {
  std::vector<scene::Scene> scenes = scenes_with_load_growth();
  scenes.push_back(tip_force(slender(750, 500), {0, 0.5, 0}));  // at once, by few arcs first
  for (const scene::Scene& scene : scenes) {
    const std::vector<scene::Span> spans = scene::spans_of(scene);
    const fam::GrowingLoads loads(spans);
    fam::BoundaryValue solver;
    solver.set(loads.way(), scene::cells_per_span(spans, 64), Law::sixth_order, fam::RodModel::kirchhoff);
    EXPECT_EQ(solver.run(), scene::Status::converged);
    const int once = solver.newton_steps();
    EXPECT_EQ(solver.run(), scene::Status::converged);
    EXPECT_EQ(solver.newton_steps(), once);
  }
}

constexpr double swing_rad = fam::leading_swing_rad;

using Planar = fam::BasicBoundaryValue<2>;

void set(Planar& solver, const fam::LoadWay& way, int arcs, const Planar* fewer = nullptr) {
  solver.set(way, std::vector{arcs}, Law::sixth_order, fam::RodModel::kirchhoff, 1e-13, fewer);
}

// From no load with two arcs, and twice as many where it pauses.
Planar halved_on_the_way(const fam::LoadWay& way, double swing_limit_rad) {
  Planar run, finer;
  set(run, way, 2);
  scene::Status status = run.run(swing_limit_rad);
  for (; run.is_paused(); std::swap(run, finer)) {
    EXPECT_EQ(status, scene::Status::not_converged);
    EXPECT_GT(run.load_factor(), 0.5);
    EXPECT_LT(run.load_factor(), 1);
    set(finer, way, 2 * run.arc_count(), &run);
    status = finer.go_on_from(run);
  }
  EXPECT_EQ(status, scene::Status::converged);
  return run;
}

double tips_apart_mm(const Planar& a, const Planar& b) {
  return (a.poses().back().position_B_mm - b.poses().back().position_B_mm).norm();
}

// Case P4 with fixed loads, which passes near a fold: 63 Newton steps, 58 with four arcs from the start.
TEST(BoundaryValue, ArcsAreHalvedOnTheWayPastACriticalPoint) {
  const scene::Scene scene =
      uniform_rod(40, slender(750, 500),
                  {scene::Force{40, Frame::fixed, {0, -1.5, 0}}, scene::Moment{40, Frame::fixed, {0, 0, 60}}});
  const std::vector<scene::Span> spans = scene::spans_of(scene),
                                 stiffer_spans = scene::spans_of(support::stiffer(scene));
  const fam::GrowingLoads loads(spans), stiffer_loads(stiffer_spans);
  const Planar halved = halved_on_the_way(loads.way(), swing_rad);
  EXPECT_EQ(halved.arc_count(), 4);
  EXPECT_FALSE(halved.way_was_smooth());
  Planar whole, stiffer;
  set(whole, loads.way(), 4);
  set(stiffer, stiffer_loads.way(), 4);
  EXPECT_EQ(whole.run(), scene::Status::converged);
  EXPECT_EQ(stiffer.run(), scene::Status::converged);
  EXPECT_LT(tips_apart_mm(halved, whole), 1e-9);
  EXPECT_GT(tips_apart_mm(halved, stiffer), 1e-2);
  EXPECT_GT(halved.newton_steps(), whole.newton_steps()) << "that to four arcs counts";
  EXPECT_LT(halved.newton_steps(), 1.3 * whole.newton_steps());
  EXPECT_EQ(halved_on_the_way(loads.way(), INFINITY).arc_count(), 2);
}

// A column pressed beyond its critical load under a torque fixed in space, which a following moment bends: 60 Newton
// steps; 85 where a step may be twice as long as the last whatever its surprise, and is refused every second time.
TEST(BoundaryValue, FewStepsAreRefusedBeyondACriticalLoad) {
  const scene::Scene column = uniform_rod(
      1, slender(1, 0.936),
      {scene::Force{1, Frame::fixed, {-7.0845, 0, -7.25e-7}}, scene::Moment{1, Frame::fixed, {-0.0747, 0, 0}},
       scene::Moment{1, Frame::follower, {0, -8.866e-4, 0}}});
  const std::vector<scene::Span> spans = scene::spans_of(column);
  const fam::GrowingLoads loads(spans);
  fam::BoundaryValue solver;
  solver.set(loads.way(), std::vector{2}, Law::sixth_order, fam::RodModel::kirchhoff, 1e-5);
  EXPECT_EQ(solver.run(), scene::Status::converged);
  EXPECT_LE(solver.newton_steps(), 70);
}

TEST(BoundaryValue, ArcsAreKeptOnASmoothWay) {
  const std::vector<scene::Span> spans = scene::spans_of(tip_force(slender(750, 500), {-0.5, 8, 0}));
  const fam::GrowingLoads loads(spans);
  const Planar run = halved_on_the_way(loads.way(), swing_rad);
  EXPECT_TRUE(run.way_was_smooth());
  EXPECT_EQ(run.arc_count(), 2);
  EXPECT_GT(fam::largest_swing_rad<2>(spans, std::vector{2}, run.arcs()), swing_rad);
}

// The largest distance between the arcs' ends of a scene, solved with this tolerance from half the arcs, and of a judge
// with Newton's method to round-off; over the length.
double left_by_newton(const scene::Scene& scene, double tolerance, const scene::Scene& judge) {
  const std::vector<scene::Span> spans = scene::spans_of(scene), judging_spans = scene::spans_of(judge);
  const fam::GrowingLoads loads(spans), judging_loads(judging_spans);
  fam::BoundaryValue few, many, exact;
  const std::vector<int> arcs = scene::cells_per_span(spans, 4), more = scene::cells_per_span(spans, 8);
  few.set(loads.way(), arcs, Law::sixth_order, fam::RodModel::kirchhoff, tolerance);
  many.set(loads.way(), more, Law::sixth_order, fam::RodModel::kirchhoff, tolerance, &few);
  exact.set(judging_loads.way(), more, Law::sixth_order, fam::RodModel::kirchhoff);
  EXPECT_EQ(few.run(), scene::Status::converged);
  EXPECT_EQ(many.run_from(few), scene::Status::converged);
  EXPECT_LE(many.expected_turn_rad(), tolerance);
  EXPECT_EQ(exact.run(), scene::Status::converged);
  double largest_mm = 0;
  for (std::size_t k = 0; k < exact.poses().size(); ++k) {
    const Vector3d apart_mm = many.poses()[k].position_B_mm - exact.poses()[k].position_B_mm;
    largest_mm = std::max(largest_mm, apart_mm.norm());
  }
  return largest_mm / scene::length_mm(scene);
}

// The poses are those of the nodes that Newton's method ends with; measured: at most 0.22 of the tolerance.
TEST(BoundaryValue, NewtonEndsWithinItsTolerance) {
  std::vector<scene::Scene> scenes = scenes_with_load_growth();
  scenes.push_back(tip_force(slender(750, 500), {0, 0.5, 0}));
  for (const scene::Scene& scene : scenes) {
    for (const double tolerance : {1e-4, 1e-5, 1e-7}) {
      EXPECT_LE(left_by_newton(scene, tolerance, scene), tolerance);
      EXPECT_GT(left_by_newton(scene, tolerance, support::stiffer(scene)), tolerance);
    }
  }
}

// Newton's steps near a solution shrink by more than half (Deuflhard 2004, section 5.1: contraction at most 1/2).
TEST(BoundaryValue, NewtonOnTheWayContracts) {
  const fam::OnTheWay smooth{{}, 0.4, false}, near_critical{{}, 0.4, true};
  const auto is_lost = [](const fam::OnTheWay& way, std::pair<double, bool> first, std::pair<double, bool> second) {
    fam::Contraction contraction;
    EXPECT_FALSE(contraction.is_lost(way, first.first, first.second));
    return contraction.is_lost(way, second.first, second.second);
  };
  EXPECT_FALSE(is_lost(smooth, {0.12, true}, {0.059, true}));
  EXPECT_TRUE(is_lost(smooth, {0.12, true}, {0.061, true}));
  EXPECT_FALSE(is_lost(smooth, {0.12, true}, {0.061, false})) << "with the derivatives of the first";
  EXPECT_FALSE(is_lost(smooth, {0.12, false}, {0.061, true}));
  EXPECT_FALSE(is_lost(near_critical, {0.12, true}, {0.061, true}));
  EXPECT_FALSE(is_lost(smooth, {0.01, true}, {0.019, true})) << "too near for another branch";
  EXPECT_TRUE(is_lost(near_critical, {0.12, true}, {0.41, false})) << "farther than a Newton step may lead";
}

// Differences of a kept solver's tips over changes far below its tolerance, as a general optimiser takes them, against
// its own derivatives; measured: 2e-5 of them.
TEST(BoundaryValue, SmallChangesMoveTheTip) {
  const Vector3d force_N(0, 0.6, 0);
  fam::Options options;
  options.tolerance_mm = 0.04;
  fam::Solver solver = support::kept(tip_force(slender(750, 500), force_N), options);
  ASSERT_TRUE(solver.solve().converged());
  constexpr double share = 1e-7;
  const auto tip_mm = [&](double times) {
    solver.set_force_N(0, times * force_N);
    EXPECT_TRUE(solver.solve().converged());
    return Vector3d(solver.tip().position_B_mm);
  };
  const Vector3d difference_mm = (tip_mm(1 + share) - tip_mm(1 - share)) / (2 * share);
  const Vector3d expected_mm = solver.by_load(0, 40).topRows<3>() * force_N;
  EXPECT_LT((difference_mm - expected_mm).norm(), 1e-3 * expected_mm.norm());
}

// A kept solver ends as solve() does with as many arcs: arcs too long for their series, a tendon without length.
// An unloaded rod held at the clamp by half a turn: the residual, a sine, vanishes, and yet it is no solution.
template <int D>
void expect_half_turn_refused(double force_N, bool one_segment) {
  const std::vector<scene::Span> spans = scene::spans_of(tip_force(slender(750, 577), {0, force_N, 0}));
  const fam::GrowingLoads loads(spans);
  const std::vector<int> arcs{12};
  fam::Shooting<D> shooting;
  shooting.set(loads.way(), arcs, Law::sixth_order, fam::RodModel::kirchhoff, 1e-10);
  ASSERT_EQ(shooting.segments().size() == 1, one_segment);
  shooting.start_unloaded();
  EXPECT_TRUE(shooting.newton(1e-10));
  auto nodes = shooting.nodes();
  for (auto& node : nodes) node.rotation_SB.template leftCols<2>() *= -1;  // by half a turn about z
  shooting.set_nodes(nodes);
  EXPECT_FALSE(shooting.newton(1e-10));
}
TEST(BoundaryValue, HalfATurnOfTheClampIsNoSolution) {
  expect_half_turn_refused<2>(0.5, true);
  expect_half_turn_refused<3>(0.5, true);
  expect_half_turn_refused<2>(20, false);
  expect_half_turn_refused<3>(20, false);
}

TEST(BoundaryValue, KeptSolversRefuseWhatSolveRefuses) {
  const auto statuses = [](const scene::Scene& scene, int arcs) {
    fam::Options options;
    options.arcs = arcs;
    return std::pair{support::kept(scene, options).solve().status, fam::solve(scene, options).status};
  };
  using enum scene::Status;
  for (const Frame frame : {Frame::follower, Frame::fixed}) {
    const scene::Scene pushed = uniform_rod(10, slender(1, 1), {scene::Force{10, frame, {0, 1, 0}}});
    EXPECT_EQ(statuses(pushed, 1), (std::pair{arc_not_converged, arc_not_converged}));
    EXPECT_EQ(statuses(pushed, 20), (std::pair{converged, converged}));
  }
  // Rolled up around the tendon: u y = T y^2 / EI = 1 and more.
  const scene::Scene rolled = uniform_rod(10, slender(10, 10), {scene::Tendon{{2, 0}, 3, 10}});
  EXPECT_EQ(statuses(rolled, 40), (std::pair{tendon_collapsed, tendon_collapsed}));
}

// Study II: the catheter under three contact forces, without and with gravity.
TEST(BoundaryValue, GatesOfStudy2) {
  const double limit_mm = 2e-6;
  for (const char* name : {"study2", "study2_gravity_y", "study2_gravity_z"}) {
    const scene::Scene scene = scene::read_scene_file(std::string(STUDY_CASES_DIR) + "/study2/" + name + ".json");
    const scene::Equilibrium exact = exact_reference::solve(scene);
    EXPECT_LT(distance_mm(solved(scene, 1e-6), exact), limit_mm) << name;
    EXPECT_GT(distance_mm(solved(support::stiffer(scene), 1e-6), exact), limit_mm) << name;
  }
}

// A thousand fixed forces on one rod.
TEST(BoundaryValue, ManyLoads) {
  std::vector<scene::Load> loads;
  for (int i = 1; i <= 1000; ++i) loads.push_back(scene::Force{0.04 * i, Frame::fixed, {0, 1e-3, 0}});
  const scene::Scene many = uniform_rod(40, slender(750, 500), loads);
  const scene::Scene even =
      uniform_rod(40, slender(750, 500), {scene::DistributedForce{0, 40, Frame::fixed, {0, 0.025, 0}}});
  // The sum of forces at s_i = 0.04 i stands for the even load with its centre 0.02 mm farther out.
  const scene::Equilibrium result = solved(many, 1e-6);
  EXPECT_LT(distance_mm(result, exact_reference::solve(many)), 1e-6);
  EXPECT_LT(distance_mm(result, solved(even, 1e-6)), 0.05);
}

}  // namespace
