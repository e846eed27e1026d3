// Small fixed loads beside following ones: what leaves a rod one equilibrium, and the solve at once.
#include "exact_reference/solve.h"
#include "fam/load_length.h"
#include "fam/loaded_rod.h"
#include "fam/rotation.h"
#include "scene/span_facts.h"
#include "support.h"
#include "support_fam.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using Eigen::Vector3d;
using scene::Frame;
using support::slender;
using support::uniform_rod;

// Up to five spans under following loads, and fixed ones of this share of them.
scene::Scene random_rod(std::mt19937& generator, double fixed_share, bool planar) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const auto in_plane = [&](double size, bool turns) -> Vector3d {
    const Vector3d v(normal(generator), normal(generator), normal(generator));
    return size * (planar ? (turns ? Vector3d(0, 0, v[2]) : Vector3d(v[0], v[1], 0)) : v);
  };
  scene::Scene scene;
  const int sections = 1 + static_cast<int>(3 * uniform(generator));
  for (int i = 0; i < sections; ++i) {
    scene::Section section;
    section.length_mm = 10 + 30 * uniform(generator);
    section.cross_section = support::random_stiffness(generator);
    if (uniform(generator) < 0.3) section.rest_curvature_per_mm = in_plane(0.01, true);
    scene.sections.push_back(section);
  }
  const double length_mm = scene::length_mm(scene);
  const double force_N = 750 / (length_mm * length_mm) * 10 * uniform(generator), fixed_N = fixed_share * force_N;
  const auto place = [&] { return length_mm * (uniform(generator) < 0.5 ? 1 : 0.05 + 0.9 * uniform(generator)); };
  scene.loads.push_back(scene::Force{place(), Frame::follower, in_plane(force_N, false)});
  scene.loads.push_back(scene::Force{place(), Frame::fixed, in_plane(fixed_N, false)});
  if (!planar && uniform(generator) < 0.3)
    scene.loads.push_back(scene::Force{place(), Frame::fixed, in_plane(fixed_N, false), {2, 1}});
  for (const Frame frame : {Frame::follower, Frame::fixed}) {
    const double here_N = frame == Frame::fixed ? fixed_N : force_N;
    if (uniform(generator) < 0.5)
      scene.loads.push_back(scene::Moment{place(), frame, in_plane(0.3 * here_N * length_mm, true)});
    if (uniform(generator) < 0.5)
      scene.loads.push_back(scene::DistributedForce{0, place(), frame, in_plane(here_N / length_mm, false)});
  }
  return scene;
}

// Of small turns of the tip: the clamp's beyond them, over them, at most, or about z alone.
double straying(const scene::Scene& scene, const Vector3d& tip_turn_rad, bool planar) {
  constexpr double small_rad = 1e-5;
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  const fam::GrowingLoads loads(spans);
  fam::LoadedRod<3> rod;
  rod.set(loads.way(), scene::cells_per_span(spans, 60), fam::Law::sixth_order, fam::RodModel::kirchhoff);
  rod.set_load(1);
  const auto clamp_SB = [&](const Vector3d& turn_rad) {
    fam::SectionState<3> state{fam::rotation_matrix(tip_turn_rad) * fam::rotation_matrix(turn_rad), {}};
    rod.march({0, rod.arc_count()}, state);
    return state.rotation_SB;
  };
  Eigen::Matrix3d beyond;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d turn_rad = small_rad * Vector3d::Unit(axis);
    const Eigen::Matrix3d apart = clamp_SB(-turn_rad).transpose() * clamp_SB(turn_rad);
    beyond.col(axis) = fam::rotation_vector(apart) / (2 * small_rad) - Vector3d::Unit(axis);
  }
  return planar ? beyond.col(2).norm() : beyond.jacobiSvd().singularValues()[0];
}

double bound(const scene::Scene& scene, bool planar) {
  return fam::clamp_straying(scene::spans_of(scene), planar);
}

// Marches over fine arcs from tips turned at random.
TEST(FollowingLoads, TheClampStraysNoMoreThanItsBound) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  double largest = 0;
  for (int i = 0; i < 400; ++i) {
    const bool planar = i % 2 == 0;
    const scene::Scene scene = random_rod(generator, i % 5 == 0 ? 1 : 0.03, planar);
    ASSERT_TRUE(!planar || scene::plane_direction(scene::spans_of(scene)));
    const double most = bound(scene, planar);
    for (int tip = 0; tip < 4; ++tip) {
      const Vector3d turn(normal(generator), normal(generator), normal(generator));
      const double measured = straying(scene, planar ? Vector3d(0, 0, 2 * turn[0]) : Vector3d(2 * turn), planar);
      EXPECT_LE(measured, most * (1 + 1e-6) + 1e-6) << "rod " << i;
      if (most > 1e-3 && most < 1) largest = std::max(largest, measured / most);
    }
  }
  EXPECT_GT(largest, 0.3);
}

// Straight rods that meet the bound or come near it, for each of its terms: pulled along the axis, cosh(w) - 1 with
// w^2 = F L^2 / EI; under a couple of forces off the centreline, |r| |F| L / EI; pulled along the axis by a following
// distributed force, from none at the tip; and bent about the axis of middle stiffness by a following moment, under
// which Euler's unstable spin makes a small fixed one grow by e^4.
TEST(FollowingLoads, SomeRodsStrayAsFarAsTheBound) {
  const auto rod = [](const scene::Stiffness& stiffness, std::vector<scene::Load> loads) {
    return uniform_rod(40, stiffness, std::move(loads));
  };
  const scene::Scene pulled = rod(slender(750, 500), {scene::Force{40, Frame::fixed, {3, 0, 0}}});
  EXPECT_NEAR(bound(pulled, true), std::cosh(40 * std::sqrt(3. / 750)) - 1, 1e-12);
  const scene::Scene couple = rod(slender(750, 500), {scene::Force{40, Frame::fixed, {0, 2, 0}, {1.5, 0}},
                                                      scene::Force{40, Frame::fixed, {0, -2, 0}, {-1.5, 0}}});
  EXPECT_NEAR(bound(couple, true), 2 * 1.5 * 2 * 40 / 750., 1e-12);
  for (const scene::Scene& scene : {pulled, couple})
    EXPECT_NEAR(straying(scene, Vector3d::Zero(), true), bound(scene, true), 1e-6);
  const scene::Scene hung = rod(slender(750, 500), {scene::DistributedForce{0, 40, Frame::follower, {0.4, 0, 0}},
                                                    scene::Force{40, Frame::fixed, {1e-3, 0, 0}}});
  const double hung_share = straying(hung, Vector3d::Zero(), true) / bound(hung, true);
  EXPECT_GT(hung_share, 0.2);
  EXPECT_LE(hung_share, 1);
  const scene::Scene spun = rod({1, {1 / 0.505, 100}, {}, {}, 0}, {scene::Moment{40, Frame::follower, {0, 8 / 39.6, 0}},
                                                                   scene::Moment{40, Frame::fixed, {0, 0, 1e-6}}});
  const double spun_share = straying(spun, Vector3d::Zero(), false) / bound(spun, false);
  EXPECT_GT(spun_share, 0.05);
  EXPECT_LE(spun_share, 1);
}

scene::Scene held_rod(const Vector3d& following_N, const Vector3d& fixed_N) {
  return uniform_rod(100, slender(1000, 950),
                     {scene::Force{100, Frame::follower, following_N}, scene::Force{100, Frame::fixed, fixed_N}});
}

Vector3d tip_mm(const scene::Equilibrium& result) {
  EXPECT_TRUE(result.converged()) << result.message;
  return result.converged() ? result.tip().position_B_mm : Vector3d::Constant(INFINITY);
}

// Under a following force of 37 EI/L^2 and some gravity, in the plane and in space, and pressed along the axis.
TEST(FollowingLoads, SmallFixedOnesBesideThemAreSolvedForAtOnce) {
  const std::vector<scene::Scene> scenes = {held_rod({-2, 3, 1}, {0, 0, 2e-3}), held_rod({-2, 3, 0}, {1e-3, 2e-3, 0}),
                                            held_rod({-3.7, 0, 0}, {0, 5e-3, 5e-3})};
  for (const scene::Scene& scene : scenes) {
    const std::vector<scene::Span> spans = scene::spans_of(scene);
    EXPECT_LT(fam::clamp_straying(spans, scene::plane_direction(spans).has_value()), 1);
    const scene::Equilibrium answer = support::solved(scene, 1e-3);
    EXPECT_EQ(support::fact(answer, "load_steps"), 1);
    EXPECT_LE(support::fact(answer, "newton_iterations"), 6);
    const Vector3d exact_mm = tip_mm(exact_reference::solve(scene));
    EXPECT_LT((tip_mm(answer) - exact_mm).norm(), 1e-3);
    EXPECT_GT((tip_mm(support::solved(support::stiffer(scene), 1e-3)) - exact_mm).norm(), 2e-3);
  }
}

// A fixed force half as large as the following one, which leaves a second equilibrium; the bound is 2.1.
TEST(FollowingLoads, LargeFixedOnesAreGrown) {
  const scene::Scene scene = held_rod({0.417602647, -0.0589240548, 0}, {-0.219661622, 0.10698985, 0});
  EXPECT_NEAR(fam::clamp_straying(scene::spans_of(scene), true), 2.07, 5e-3);
  const Vector3d exact_mm = tip_mm(exact_reference::solve(scene));
  EXPECT_LT((tip_mm(support::solved(scene, 1e-3)) - exact_mm).norm(), 1e-3);
  EXPECT_GT((tip_mm(support::solved(support::stiffer(scene), 1e-3)) - exact_mm).norm(), 0.1);
}

}  // namespace
