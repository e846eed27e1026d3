// Random scenes: valid, the same on every machine, and over all that the scene format can say.
#include "studies/scenes/random_scene.h"

#include <gtest/gtest.h>

#include <map>

namespace {

template <class Load>
const char* frame_of(const Load& load) {
  return load.frame == scene::Frame::fixed ? " fixed" : " follower";
}

std::string kind_of(const scene::Load& load) {
  if (const auto* l = std::get_if<scene::Force>(&load)) return std::string("force") + frame_of(*l);
  if (const auto* l = std::get_if<scene::Moment>(&load)) return std::string("moment") + frame_of(*l);
  if (const auto* l = std::get_if<scene::DistributedForce>(&load)) return std::string("distributed") + frame_of(*l);
  return std::holds_alternative<scene::Gravity>(load) ? "gravity" : "tendon";
}

TEST(RandomScene, AThousandAreValidAndHoldEveryKindOfLoad) {
  std::map<std::string, int> kinds;
  std::map<std::size_t, int> sections;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const scene::Scene scene = studies::random_scene(seed);
    ASSERT_NO_THROW(scene::validate(scene)) << "seed " << seed;
    ++sections[scene.sections.size()];
    for (const scene::Load& load : scene.loads) ++kinds[kind_of(load)];
  }
  EXPECT_EQ(kinds.size(), 8u);
  for (const auto& [kind, count] : kinds) EXPECT_GT(count, 50) << kind;
  EXPECT_EQ(sections.size(), 20u);
}

TEST(RandomScene, ASeedIsOneScene) {
  const scene::Scene scene = studies::random_scene(7);
  EXPECT_EQ(scene.title, "random scene 7");
  EXPECT_EQ(scene::length_mm(scene), scene::length_mm(studies::random_scene(7)));
  EXPECT_NE(scene::length_mm(scene), scene::length_mm(studies::random_scene(8)));
}

TEST(RandomScene, LimitsHold) {
  studies::RandomSceneLimits limits;
  limits.sections_max = 3;
  limits.length_min_mm = 10, limits.length_max_mm = 20;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const scene::Scene scene = studies::random_scene(seed, limits);
    EXPECT_LE(scene.sections.size(), 3u);
    EXPECT_GE(scene::length_mm(scene), 9.999);
    EXPECT_LE(scene::length_mm(scene), 20.001);
  }
}

TEST(RandomScene, RodsThatBuckleAreValid) {
  int pressed = 0, bent = 0;
  for (std::uint64_t seed = studies::first_buckling_seed; seed < studies::first_buckling_seed + 1000; ++seed) {
    const scene::Scene scene = studies::random_scene(seed);
    ASSERT_NO_THROW(scene::validate(scene)) << "seed " << seed;
    const Eigen::Vector3d force_N = std::get<scene::Force>(scene.loads.front()).value_N;
    ++(force_N.x() < 0 ? pressed : bent);
    EXPECT_GE(scene.loads.size(), 2u);
  }
  EXPECT_GT(pressed, 600);
  EXPECT_GT(bent, 150);
}

}  // namespace
