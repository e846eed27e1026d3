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

// 4 - (load - 1)^2, whose last two values are far from zero and from each other little: it vanishes at 3.
TEST(BranchWatch, TellsTheWayToAZeroThatBendsCloser) {
  scene::BranchWatch watch;
  watch.keep(0, {std::log(3.0), true});
  watch.keep(0.5, {std::log(3.75), true});
  EXPECT_EQ(watch.longest_bent_step(0.5), HUGE_VAL);
  watch.keep(1.75, {std::log(3.4375), true});
  EXPECT_GT(watch.longest_step(1.75), 10);
  EXPECT_NEAR(watch.longest_bent_step(1.75), 0.8 * 1.25, 1e-12);
  EXPECT_NEAR(watch.longest_bent_step(2), 0.8 * 1, 1e-12);
  watch.keep(3.5, {std::log(2.25), false});
  EXPECT_EQ(watch.longest_bent_step(3.5), HUGE_VAL);
}
// One that bends away from zero: 1 / (1 + load).
TEST(BranchWatch, SeesNoZeroWhereTheDeterminantBendsAway) {
  scene::BranchWatch watch;
  for (const double load : {0.0, 1.0, 2.0}) watch.keep(load, {-std::log1p(load)});
  EXPECT_EQ(watch.longest_bent_step(2), HUGE_VAL);
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
