// What mutants once survived: the model that FAM chooses, and its published law.
#include "survivors.h"

#include "fam/load_length.h"
#include "fam/model_choice.h"
#include "studies/scenes/random_scene.h"

namespace {

using namespace survivors;

// One arc: bend_twist bends by theta about z, then twists by phi; twist_bend the other way round.
TEST(SurvivorsFam, OrdersOfThePublishedLaw) {
  const double theta = 20. * 40 / 750, phi = 10. * 40 / 500;
  const Matrix3d bend = AngleAxisd(theta, Vector3d::UnitZ()).toRotationMatrix();
  const Matrix3d turn = AngleAxisd(phi, Vector3d::UnitX()).toRotationMatrix();
  const auto rotation = [](fam::TwistOrder order) {
    fam::Options options;
    options.law = fam::Law::published;
    options.arcs = 1;
    options.twist_order = order;
    return fam::solve(uniform_rod(40, slender(750, 500), {Moment{40, Frame::follower, {10, 0, 20}}}), options)
        .tip()
        .rotation_BS;
  };
  EXPECT_LT((rotation(fam::TwistOrder::bend_twist) - bend * turn).norm(), 1e-12);
  EXPECT_LT((rotation(fam::TwistOrder::twist_bend) - turn * bend).norm(), 1e-12);
  EXPECT_GT((bend * turn - turn * bend).norm(), 0.5);
}

// A pure moment: every place of one published arc lies on the circle but for what the Bezier curve misses.
TEST(SurvivorsFam, PublishedArcsInside) {
  const Equilibrium found =
      by_fam(uniform_rod(40, slender(750, 500), {Moment{40, Frame::follower, {0, 0, 25}}}), fam::Law::published, 1);
  const double k = 25. / 750;
  double largest = 0;
  for (const scene::Station& station : found.stations) {
    largest = std::max(largest, std::abs((station.X_BS.position_B_mm - Vector3d(0, 1 / k, 0)).norm() - 1 / k));
  }
  EXPECT_LT(largest, 0.01);
  EXPECT_GT(largest, 1e-6);
}

// Timoshenko: a small force at a stubby cantilever moves its tip by F L^3/3EI + F L/kGA, each of its own direction.
TEST(SurvivorsFam, StubbyFlatRodInBothPlanes) {
  const double L = 10, F = 0.01;
  scene::Stiffness flat = slender(1, 800);
  flat.bending_Nmm2 = {1000, 3000};  // about y: under forces along z
  flat.shear_N = Vector2d(500, 200);
  const double along_y = F * L * L * L / 9000 + F * L / 500, along_z = F * L * L * L / 3000 + F * L / 200;
  for (const Frame frame : {Frame::fixed, Frame::follower}) {
    const Vector3d y = tip(by_fam(uniform_rod(L, flat, {Force{L, frame, {0, F, 0}}}), 1e-9));
    const Vector3d z = tip(by_fam(uniform_rod(L, flat, {Force{L, frame, {0, 0, F}}}), 1e-9));
    EXPECT_NEAR(y[1], along_y, 1e-6);
    EXPECT_NEAR(z[2], along_z, 1e-6);
  }
  EXPECT_GT(std::abs(along_y - along_z), 1e-4);
}

// What shear moves, F L/kGA, must be in the estimate of an answer without it; and it is left out only up to a tenth of
// the tolerance.
TEST(SurvivorsFam, LeftOutShearIsInTheEstimate) {
  const double L = 10, F = 0.1, kGA = 50;
  scene::Stiffness soft = slender(1000, 800);
  soft.shear_N = Vector2d::Constant(kGA);
  for (const Frame frame : {Frame::fixed, Frame::follower}) {
    const Scene scene = uniform_rod(L, soft, {Force{L, frame, {0, F, 0}}});
    const Equilibrium without = by_fam(scene, 1), with = by_fam(scene, 1e-8);
    EXPECT_FALSE(fact<bool>(without, "shear"));
    EXPECT_TRUE(fact<bool>(with, "shear"));
    const double moved_mm = (tip(with) - tip(without)).norm();
    EXPECT_NEAR(moved_mm, F * L / kGA, 1e-3);
    EXPECT_GE(without.error_estimate_mm, moved_mm);
    EXPECT_TRUE(fact<bool>(by_fam(scene, 5 * moved_mm), "shear"));
  }
}

// A scene whose loads all follow, 46 load lengths long, and one coiled by 156 rad: the strains shift their tips by 4e-6
// and 2e-3 L, and the loads, which turn with that, by 1.3e-3 and 0.5 L.
TEST(SurvivorsFam, LeftOutShearThatFollowerLoadsAmplify) {
  for (const std::uint64_t seed : {std::uint64_t{4110}, studies::mixed_seed(2640)}) {
    const Scene scene = studies::random_scene(seed);
    ASSERT_TRUE(scene::all_loads_follow(scene::spans_of(scene)));
    const double L = scene::length_mm(scene);
    fam::Options options;
    options.model = fam::RodModel::reissner;
    options.tolerance_mm = 1e-5 * L;
    const Equilibrium true_rod = fam::solve(scene, options);
    for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
      const Equilibrium found = by_fam(scene, tolerance * L);
      ASSERT_TRUE(true_rod.converged() && found.converged());
      EXPECT_LE((tip(found) - tip(true_rod)).norm(), tolerance * L) << seed;
    }
  }
}

// Fixed loads whose load length is 59 and 78: the tips move 5.5 and 3.9 times as far as the strains add up to.
TEST(SurvivorsFam, LeftOutShearThatLongFixedLoadsAmplify) {
  for (const std::uint64_t index : {6779, 1169}) {
    const Scene scene = studies::random_scene(studies::campaign_seed(777, index));
    const auto spans = scene::spans_of(scene);
    ASSERT_FALSE(scene::all_loads_follow(spans));
    const double L = scene::length_mm(scene);
    const auto solved_as = [&](fam::RodModel model) {
      fam::Options options;
      options.model = model;
      options.tolerance_mm = 1e-6 * L;
      const Equilibrium result = fam::solve(scene, options);
      EXPECT_TRUE(result.converged());
      return tip(result);
    };
    const double moved_mm = (solved_as(fam::RodModel::reissner) - solved_as(fam::RodModel::kirchhoff)).norm();
    const double bound_mm = fam::choose_rod(spans, fam::RodModel::automatic, L).left_out_mm;
    EXPECT_GT(moved_mm, 1e-3 * L);
    EXPECT_GT(bound_mm, moved_mm) << index;
  }
}

// The rules that model_choice.h states, by hand.
std::vector<int> first_arcs(const std::vector<scene::Span>& spans, bool planar) {
  std::vector<int> arcs;
  fam::set_first_arcs(spans, planar, arcs);
  return arcs;
}

TEST(SurvivorsFam, FirstArcs) {
  // Rest curvature of 20 rad under a force: 10 arcs of first_turn_rad = 2. Without the force one.
  Scene coil = uniform_rod(10, slender(1, 1), {Force{10, Frame::fixed, {0, 1e-6, 0}}});
  coil.sections[0].rest_curvature_per_mm = {0, 0, 2};
  EXPECT_EQ(first_arcs(spans(coil), true), std::vector<int>{10});
  coil.loads.clear();
  EXPECT_EQ(first_arcs(spans(coil), true), std::vector<int>{1});
  // A moment of 10 in space, compliances 1/4, 1/2, 1: load length 10 sqrt(1/4 1/2) 10 = 35.4 over first_load_length
  // = 1.5.
  scene::Stiffness uneven = slender(2, 1);
  uneven.bending_Nmm2[1] = 4;
  const auto twisted = spans(uniform_rod(10, uneven, {Moment{10, Frame::follower, {10, 0, 0}}}));
  EXPECT_EQ(first_arcs(twisted, false), std::vector<int>{24});
  // A force at the tip counts in all spans: sqrt(100) 5 / 1.5 arcs in each.
  const auto two = spans(
      uniform_rod(10, slender(1, 1), {Force{10, Frame::fixed, {0, 100, 0}}, Moment{5, Frame::fixed, {0, 0, 1e-9}}}));
  EXPECT_EQ(first_arcs(two, true), (std::vector<int>{34, 34}));
}

// A top spun about its middle axis: the turn grows with sqrt((c2 - c1)(c3 - c2)) M, here sqrt(0.9 9), not with c2 M =
// M.
TEST(SurvivorsFam, SwingOfAMoment) {
  scene::Stiffness uneven = slender(1, 0.1);
  uneven.bending_Nmm2[1] = 10;
  const auto rod = spans(uniform_rod(10, uneven, {Force{10, Frame::fixed, {1e-9, 0, 0}}}));
  const double M = 0.03;
  fam::Arc arc;
  arc.screw.rotation = Vector3d(0, 10 * M, 0);
  EXPECT_NEAR(fam::largest_swing_rad<3>(rod, std::vector<int>{1}, std::vector<fam::Arc>{arc}),
              std::sqrt(0.9 * 9) * 10 * M, 1e-12);
  fam::BasicArc<2> planar;
  planar.screw.rotation[0] = 10 * M;
  EXPECT_NEAR(fam::largest_swing_rad<2>(rod, std::vector<int>{1}, std::vector<fam::BasicArc<2>>{planar}), 10 * M,
              1e-12);
}

TEST(SurvivorsFam, LeverArmsAreMoments) {  // |F| |r| = 3 2, summed over the couple
  double moment_Nmm = 0;
  fam::walk_from_tip(spans(uniform_rod(10, slender(1, 1), couple(10, {0, 3, 0}, {2, 0}))), fam::OneEach{},
                     [&](const fam::LoadedCell& cell) { moment_Nmm = cell.moment_Nmm; });
  EXPECT_DOUBLE_EQ(moment_Nmm, 12);
}

// Fixed forces add up as vectors, those that follow the rod by their sizes; on a cell the larger of its ends' counts.
TEST(SurvivorsFam, OppositeForcesCancelBelow) {
  const Scene pressed = uniform_rod(
      30, slender(1, 1),
      {Force{30, Frame::fixed, {0, 3, 0}}, Force{20, Frame::fixed, {0, -3, 0}}, Force{10, Frame::follower, {0, 0, 2}},
       Moment{30, Frame::fixed, {0, 5, 0}}, Moment{20, Frame::fixed, {0, 0, 12}}});
  const auto met = [&](fam::Sum sum) {
    std::vector<double> values;
    fam::walk_from_tip(
        spans(pressed), fam::OneEach{},
        [&](const fam::LoadedCell& cell) {
          values.insert(values.end(), {cell.force_N, cell.moment_Nmm});
        },
        sum);
    return values;
  };
  EXPECT_EQ(met(fam::Sum::vectors), (std::vector<double>{3, 5, 0, 13, 2, 13}));
  EXPECT_EQ(met(fam::Sum::sizes), (std::vector<double>{3, 5, 6, 17, 8, 17}));
}

// A torque M on two sections: the turn is M s/GJ, of each its own, and the rod stays straight.
TEST(SurvivorsFam, TwistOfTwoRoundSections) {
  for (const Frame frame : {Frame::follower, Frame::fixed}) {
    Scene scene = uniform_rod(20, slender(750, 500), {Moment{40, frame, {20, 0, 0}}});
    scene.sections.push_back(scene.sections[0]);
    scene.sections[1].cross_section = slender(750, 2000);
    const Equilibrium found = by_fam(scene);
    ASSERT_TRUE(found.converged());
    EXPECT_LT((tip(found) - Vector3d(40, 0, 0)).norm(), 1e-10);
    for (const scene::Station& station : found.stations) {
      const double s = station.s_mm;
      EXPECT_NEAR(twist(station.X_BS.rotation_BS), s <= 20 ? 20 * s / 500 : 0.8 + 20 * (s - 20) / 2000, 1e-9) << s;
    }
  }
}

}  // namespace
