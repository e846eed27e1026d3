// The cutting of a scene into spans.
#include "scene/span_facts.h"

#include "support.h"

#include <gtest/gtest.h>

#include <numeric>

namespace {

using scene::Frame;
using support::slender;

// 10.1 + 20.2 is a hair less than 30.3, where the border was meant to be.
TEST(Span, APlaceOnABorderIsTheSectionsTowardsTheClamp) {
  scene::Scene scene = support::uniform_rod(10.1, slender(1, 1), {});
  for (const double length_mm : {20.2, 10.0}) {
    scene.sections.push_back(scene.sections[0]);
    scene.sections.back().length_mm = length_mm;
  }
  EXPECT_EQ(&scene::section_at(scene, 0), &scene.sections[0]);
  EXPECT_EQ(&scene::section_at(scene, 30.3), &scene.sections[1]);
  EXPECT_EQ(&scene::section_at(scene, 30.3 + 1e-9), &scene.sections[2]);
  EXPECT_EQ(&scene::section_at(scene, 41), &scene.sections[2]);
}

TEST(Span, CutsAtSectionsLoadsAndEndsOnce) {
  scene::Scene scene = support::uniform_rod(30, slender(1, 1), {});
  scene.sections.push_back(scene.sections[0]);
  scene.sections[1].length_mm = 10;
  scene.sections[1].cross_section = slender(2, 2);
  scene.loads = {scene::Force{40, Frame::follower, {1, 0, 0}},
                 scene::Force{40, Frame::fixed, {0, 2, 0}},
                 scene::Moment{30 + 1e-12, Frame::fixed, {0, 0, 3}},
                 scene::Force{25, Frame::follower, {4, 0, 0}},
                 scene::DistributedForce{5, 35, Frame::fixed, {0, 0, 1}},
                 scene::Tendon{{2, 3}, 10, 25}};
  const auto spans = scene::spans_of(scene);
  ASSERT_EQ(spans.size(), 5u);  // 0 5 25 30 35 40
  EXPECT_EQ(spans[1].end_mm, 25);
  EXPECT_EQ(spans[2].end_mm, 30);
  EXPECT_EQ(spans[4].end_mm, 40);
  EXPECT_EQ(spans[1].follower_load_S.force_N[0], 4);
  EXPECT_EQ(spans[2].fixed_load_B.moment_Nmm[2], 3);
  EXPECT_EQ(spans[4].follower_load_S.force_N[0], 1);
  EXPECT_EQ(spans[4].fixed_load_B.force_N[1], 2);
  EXPECT_EQ(spans[2].stiffness.torsion_Nmm2, 1);
  EXPECT_EQ(spans[3].stiffness.torsion_Nmm2, 2);
  const std::vector<double> distributed = {0, 1, 1, 1, 0};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(spans[i].fixed_force_B_N_per_mm[2], distributed[i]);
  // r x (-T e_x) with r = (0, 2, 3): (0, -3 T, 2 T).
  ASSERT_EQ(spans[1].tendons.size(), 1u);
  EXPECT_EQ(spans[1].tendons[0].arm_S_mm, Eigen::Vector3d(0, 2, 3));
  EXPECT_EQ(spans[1].tendons[0].tension_N, 10);
  EXPECT_TRUE(spans[2].tendons.empty());
}

// The last section is 7037 units in the last place of its end long, the same-place distance 7036.9 of them: s -
// distance rounds to the start of the section, and a load at the tip once cut an empty span.
TEST(Span, ALoadAtTheEndOfTheShortestSection) {
  scene::Scene scene = support::uniform_rod(100, slender(1, 1), {});
  scene.sections.push_back(scene.sections[0]);
  scene.sections[1].length_mm = 1e-10;
  const double tip = scene::length_mm(scene);
  scene.loads = {scene::Moment{tip, Frame::fixed, {1, 0, 0}}};
  const auto spans = scene::spans_of(scene);
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_EQ(spans[0].end_mm, 100);
  EXPECT_EQ(spans[1].end_mm, tip);
  EXPECT_EQ(spans[1].fixed_load_B.moment_Nmm[0], 1);
}

// 0.03 kg/m under 9.81 m/s^2 weighs 0.2943 N/m = 2.943e-4 N/mm.
TEST(Span, GravityInNewtonPerMillimetre) {
  scene::Stiffness heavy = slender(1, 1);
  heavy.mass_per_length_kg_per_m = 0.03;
  const auto spans = scene::spans_of(support::uniform_rod(10, heavy, {scene::Gravity{{0, 0, -9.81}}}));
  EXPECT_NEAR(spans[0].fixed_force_B_N_per_mm[2], -2.943e-4, 1e-18);
}

TEST(Span, SharesCellsByLengthAtLeastOneEach) {
  scene::Scene scene =
      support::uniform_rod(100, slender(1, 1),
                           {scene::Force{1, Frame::fixed, {1, 0, 0}}, scene::Force{2, Frame::fixed, {1, 0, 0}},
                            scene::Force{52, Frame::fixed, {1, 0, 0}}});
  const auto spans = scene::spans_of(scene);
  for (int count : {1, 2, 4, 5, 7, 12, 100, 1000}) {
    const auto cells = scene::cells_per_span(spans, count);
    EXPECT_EQ(std::accumulate(cells.begin(), cells.end(), 0), std::max(count, 4));
    for (const int n : cells) EXPECT_GE(n, 1);
    if (count >= 100) {
      EXPECT_EQ(cells[2], count / 2);
    }
  }
}

TEST(Span, ThousandsOfLoads) {
  std::vector<scene::Load> loads;
  for (int i = 1; i <= 5000; ++i) loads.push_back(scene::Force{0.01 * i, Frame::follower, {0, 1, 0}});
  const auto spans = scene::spans_of(support::uniform_rod(50, slender(1, 1), loads));
  ASSERT_EQ(spans.size(), 5000u);
  for (const auto& span : spans) ASSERT_EQ(span.follower_load_S.force_N[1], 1);
}

// Moments fixed in space alone; one load of any other kind and they are not.
TEST(Span, MomentsThatAreKnownBeforeTheShape) {
  using scene::Frame;
  const Eigen::Vector3d some(1, -2, 3);
  const auto known = [](std::vector<scene::Load> loads) {
    loads.push_back(scene::Moment{40, Frame::fixed, {5, 6, 7}});
    return scene::moments_are_known(scene::spans_of(support::uniform_rod(40, support::slender(750, 500), loads)));
  };
  EXPECT_TRUE(known({}));
  EXPECT_TRUE(known({scene::Moment{20, Frame::fixed, some}}));
  const std::vector<scene::Load> others = {scene::Moment{20, Frame::follower, some},
                                           scene::Force{20, Frame::fixed, some},
                                           scene::Force{20, Frame::follower, some},
                                           scene::DistributedForce{0, 40, Frame::fixed, some},
                                           scene::DistributedForce{0, 40, Frame::follower, some},
                                           scene::Force{40, Frame::fixed, some, {1, 1}},
                                           scene::Tendon{{1, 0}, 1, 40}};
  for (const scene::Load& load : others) EXPECT_FALSE(known({load})) << load.index();
}

TEST(Span, SymmetryOfLoadsAndRestShape) {
  using scene::Symmetry;
  const auto symmetry = [](const std::vector<scene::Load>& loads) {
    return scene::symmetry_of(scene::spans_of(support::uniform_rod(40, slender(1, 1), loads)));
  };
  const scene::Load pressed = scene::Force{40, Frame::fixed, {-1, 0, 0}};
  EXPECT_EQ(symmetry({}), Symmetry::axis);
  EXPECT_EQ(symmetry({pressed, scene::Moment{20, Frame::follower, {1, 0, 0}}}), Symmetry::axis);
  EXPECT_EQ(symmetry({pressed, scene::Force{20, Frame::follower, {0, 1, 0}}}), Symmetry::plane_xy);
  EXPECT_EQ(symmetry({pressed, scene::Moment{20, Frame::fixed, {0, 1, 0}}}), Symmetry::plane_xz);
  EXPECT_EQ(symmetry({scene::Tendon{{1, 0}, 1, 40}, scene::Moment{20, Frame::fixed, {0, 0, 1}}}), Symmetry::plane_xy);
  EXPECT_EQ(symmetry({scene::Force{20, Frame::fixed, {0, 1, 0}}, scene::Moment{20, Frame::fixed, {1, 0, 0}}}),
            Symmetry::none);
  EXPECT_EQ(symmetry({pressed, scene::DistributedForce{0, 20, Frame::fixed, {0, 1, 1}}}), Symmetry::none);
}

}  // namespace
