// The determinants along a load: a change of sign, and the way to a zero.
#include "scene/branch_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

scene::BranchWatch watched(const std::vector<double>& ways_left, double exponent) {
  scene::BranchWatch watch;
  for (const double left : ways_left) watch.keep(1 - left, {3 + exponent * std::log(left), true});
  return watch;
}

// As the root of the way left: a fold. As the way itself: two branches that part, or all but do, where a stable one may
// go on; as its power 2/3: all but a fold.
TEST(BranchWatch, TellsAFold) {
  const std::vector<double> steps = {1, 0.5, 0.3, 0.28, 0.14, 0.12, 0.04, 1e-2, 4e-3, 1e-3, 4e-4};
  EXPECT_TRUE(watched(steps, 0.5).nears_fold_before(1.01));
  EXPECT_FALSE(watched(steps, 1).nears_fold_before(1.01));
  EXPECT_FALSE(watched(steps, 2.0 / 3).nears_fold_before(1.01));
  EXPECT_FALSE(watched({1, 0.5, 0.24, 0.11, 0.05, 0.02, 0.009}, 0.5).nears_fold_before(1.01));  // not yet
  EXPECT_TRUE(watched({1, 0.5, 0.24, 0.11, 0.05, 0.02, 0.009, 0.004}, 0.5).nears_fold_before(1.01));
  EXPECT_FALSE(watched({1, 0.97, 0.94, 0.91, 0.88, 0.85, 0.82, 0.79, 0.76, 0.73}, 1).nears_fold_before(1.01));
  // One long step to where it all but vanishes says nothing of how it fell.
  EXPECT_FALSE(watched({1, 0.7, 0.5, 1e-4}, 1).nears_fold_before(1.01));
  EXPECT_FALSE(watched({1, 0.9, 1e-9}, 0.5).nears_fold_before(1.01));

  // Nor is it one where the way ends before.
  EXPECT_FALSE(watched(steps, 0.5).nears_fold_before(1));
  EXPECT_FALSE(watched(steps, 0.5).nears_fold_before(0.999));

  scene::BranchWatch watch = watched(steps, 0.5);
  watch.keep(1 - 3e-4, {3 + 0.5 * std::log(5e-4), true});  // it rises again
  EXPECT_FALSE(watch.nears_fold_before(1.01));
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
