// The determinants along a load: a change of sign, and the way to a zero.
#include "scene/branch_watch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

TEST(BranchWatch, TellsAChangeOfSignAndTheWayToAZero) {
  scene::BranchWatch watch;
  EXPECT_FALSE(watch.has_left({0, true}));
  EXPECT_EQ(watch.longest_step(0), HUGE_VAL);
  watch.keep(0, {std::log(4.0), true});
  EXPECT_EQ(watch.longest_step(0), HUGE_VAL);
  watch.keep(0.5, {std::log(3.0), true});  // the line through both vanishes at 2
  EXPECT_NEAR(watch.longest_step(0.5), 0.8 * 1.5, 1e-12);
  EXPECT_NEAR(watch.longest_step(0.25), 0.8 * 1.75, 1e-12);
  EXPECT_FALSE(watch.has_left({0, true}));
  EXPECT_TRUE(watch.has_left({0, false}));
  watch.keep(1, {std::log(5.0), true});
  EXPECT_EQ(watch.longest_step(1), HUGE_VAL);
}

// A taut rod's determinant falls as it slackens, which leads to no critical point.
TEST(BranchWatch, TellsADeterminantThatHasFallen) {
  EXPECT_FALSE(scene::has_fallen({0, false}, {std::log(0.5), false}));
  EXPECT_TRUE(scene::has_fallen({0, false}, {std::log(0.1), false}));
  EXPECT_TRUE(scene::has_fallen({0, false}, {0, true}));
  EXPECT_FALSE(scene::has_fallen({5, false, 5}, {2, false, 2}));
  EXPECT_TRUE(scene::has_fallen({5, false, 2}, {2, false, 2}));
}

}  // namespace
