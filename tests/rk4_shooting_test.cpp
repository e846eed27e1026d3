// The competitor "plain shooting" against the exact rod: right, of fourth order, without allocation, honest.
#include "studies/methods/rk4_shooting.h"
#include "allocation_counter.h"
#include "exact_reference/solve.h"
#include "studies/methods/rk4_method.h"
#include "support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using Eigen::Vector3d;
using scene::Frame;

Vector3d tip_mm(const scene::Scene& scene, int steps, bool with_shear) {
  const scene::Equilibrium result = studies::rk4_method({steps, with_shear})->solve(scene);
  EXPECT_TRUE(result.converged()) << scene.title << " " << result.message;
  return result.converged() ? result.tip().position_B_mm : Vector3d(NAN, NAN, NAN);
}

Vector3d exact_tip_mm(const scene::Scene& scene, bool with_shear) {
  exact_reference::Options options;
  if (!with_shear) options.model = exact_reference::RodModel::kirchhoff;
  return exact_reference::solve(scene, options).tip().position_B_mm;
}

double error_mm(const scene::Scene& scene, int steps, bool with_shear) {
  return (tip_mm(scene, steps, with_shear) - exact_tip_mm(scene, with_shear)).norm();
}

// Gate: 64 steps within 1e-4 mm of the exact rod; a rod stiffer by 5 % is not.
TEST(Rk4Shooting, AgreesWithTheExactRod) {
  for (const auto& [load_case, frame] : {std::pair{"S4", "follower"}, {"P2", "fixed"}}) {
    const scene::Scene scene = support::study1_scene(load_case, frame);
    for (const bool with_shear : {true, false}) {
      const Vector3d exact_mm = exact_tip_mm(scene, with_shear);
      EXPECT_LT((tip_mm(scene, 64, with_shear) - exact_mm).norm(), 1e-4) << load_case;
      EXPECT_GT((tip_mm(support::stiffer(scene), 64, with_shear) - exact_mm).norm(), 1e-4) << load_case;
    }
  }
}

TEST(Rk4Shooting, IsOfFourthOrder) {
  for (const auto& [load_case, frame] : {std::pair{"S4", "follower"}, {"P2", "fixed"}}) {
    const scene::Scene scene = support::study1_scene(load_case, frame);
    for (const bool with_shear : {true, false}) {
      const double order = std::log2(error_mm(scene, 16, with_shear) / error_mm(scene, 32, with_shear));
      EXPECT_NEAR(order, 4, 0.35) << load_case << " " << with_shear;
    }
  }
}

// Two sections, a point load inside, distributed forces in both frames, gravity, rest curvature.
TEST(Rk4Shooting, TakesSectionsAndDistributedLoads) {
  scene::Scene scene = support::uniform_rod(40, support::slender(1500, 1000), {});
  scene.sections.push_back(scene.sections[0]);
  scene::Stiffness soft{600, {800, 900}, 5e3, Eigen::Vector2d{1e3, 2e3}, 0.05};
  scene.sections[1].cross_section = soft;
  scene.sections[1].rest_curvature_per_mm = {0.002, -0.003, 0.004};
  scene.loads = {scene::Force{25, Frame::follower, {0.1, 0.2, -0.1}}, scene::Moment{80, Frame::fixed, {3, -5, 4}},
                 scene::DistributedForce{10, 60, Frame::follower, {0, 0.002, 0.001}},
                 scene::DistributedForce{30, 80, Frame::fixed, {0.001, 0, 0.003}}, scene::Gravity{{0, -9.81, 0}}};
  const scene::Equilibrium ours = studies::rk4_method({200, true})->solve(scene);
  const scene::Equilibrium exact = exact_reference::solve(scene);
  ASSERT_TRUE(ours.converged() && exact.converged());
  EXPECT_LT((ours.tip().position_B_mm - exact.tip().position_B_mm).norm(), 1e-6);
  EXPECT_LT((ours.base().force_B_N - exact.base().force_B_N).norm(), 1e-7);
  EXPECT_LT((ours.base().moment_B_Nmm - exact.base().moment_B_Nmm).norm(), 1e-6);
}

TEST(Rk4Shooting, DoesNotAllocateWhileSolving) {
  const std::vector<scene::Span> spans = scene::spans_of(support::study1_scene("S4", "fixed"));
  for (const bool with_shear : {true, false}) {
    studies::Rk4Shooting solver(spans, scene::cells_per_span(spans, 50), with_shear);
    const std::size_t before = allocation_count();
    EXPECT_EQ(solver.run(), scene::Status::converged);
    EXPECT_EQ(allocation_count(), before);
  }
}

TEST(Rk4Shooting, SaysWhatItDoesNotSolve) {
  scene::Scene scene = support::uniform_rod(40, support::slender(750, 500), {scene::Tendon{{1, 0}, 1, 40}});
  const auto method = studies::rk4_method({50, true});
  EXPECT_EQ(method->solve(scene).status, scene::Status::unsupported);
  scene.loads = {scene::Force{40, Frame::fixed, {0, 1000 * 750 / 1600.0, 0}}};  // |F| L^2/EI = 1000
  const scene::Equilibrium lost = method->solve(scene);
  EXPECT_FALSE(lost.converged());
  EXPECT_TRUE(lost.stations.empty());
  EXPECT_FALSE(lost.message.empty());
}

// A warm start ends where the cold one does, in fewer iterations.
TEST(Rk4Shooting, StartsFromASolution) {
  const std::vector<scene::Span> spans = scene::spans_of(support::study1_scene("S4", "fixed"));
  studies::Rk4Shooting solver(spans, scene::cells_per_span(spans, 50), true);
  ASSERT_EQ(solver.run(), scene::Status::converged);
  const int cold = solver.iterations();
  const studies::Rk4Shooting::Vector6d solution = solver.base_wrench();
  ASSERT_EQ(solver.run(1.01 * solution), scene::Status::converged);
  EXPECT_LT(solver.iterations(), cold);
  EXPECT_LT((solver.base_wrench() - solution).norm(), 1e-8);
}

}  // namespace
