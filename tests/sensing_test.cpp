// The trials of study `sensing`: estimates are as sure as they say, and the trials see where they are not.
#include "studies/sensing/trials.h"

#include <gtest/gtest.h>

namespace {

using studies::Mismatch;
using studies::Sensing;
using studies::SensingResult;
using studies::SensingSettings;

SensingSettings few(Sensing kind, double noise) {
  SensingSettings settings;
  settings.kind = kind;
  settings.noise = noise;
  settings.truths = 20;
  settings.noises_each = 20;
  return settings;
}

SensingResult ran(const SensingSettings& settings) {
  return studies::run_trials(settings, STUDY_CASES_DIR);
}

// Chi-squared of n unknowns has mean n and variance 2n: the band is 1.96 sqrt(2n / trials), 0.24 of 400 trials.
TEST(Sensing, TipForcesAreAsSureAsTheySay) {
  for (const Sensing kind : {Sensing::tip_pose, Sensing::four_positions}) {
    const SensingResult found = ran(few(kind, 0.01));
    EXPECT_EQ(found.counted(), 400);
    EXPECT_TRUE(found.in_band()) << found.nees << " of 3 +- " << found.band();
    EXPECT_EQ(found.wrong_and_fitting, 0);
  }
}

// A load of unknown place between five sensors of curvature; beside it a model that is 5 % too stiff.
TEST(Sensing, PlacesBetweenSensorsAreAsSureAsTheySay) {
  for (const Sensing kind : {Sensing::placed_force, Sensing::placed_moment}) {
    SensingSettings settings = few(kind, 1e-5);
    settings.positions = 5;
    const SensingResult found = ran(settings);
    EXPECT_EQ(found.counted(), 400);
    EXPECT_EQ(found.places, 400);
    EXPECT_LE(found.place_beyond_3sd, 4);  // 1 of 370 normal numbers is
    settings.mismatch = Mismatch::stiffer;
    EXPECT_GT(ran(settings).nees, 10 * found.unknowns);
  }
}

// The twins: the trials must see a model that is 5 % too stiff.
TEST(Sensing, StifferModelLeavesTheBand) {
  SensingSettings settings = few(Sensing::four_positions, 0.01);
  settings.mismatch = Mismatch::stiffer;
  const SensingResult found = ran(settings);
  EXPECT_FALSE(found.in_band());
  EXPECT_GT(found.nees, 3 + found.band());
}

// Deviations told half as large: NEES of 4 an unknown, within its band four times as wide.
TEST(Sensing, DeviationsToldHalfGiveFourTimesTheNees) {
  SensingSettings settings = few(Sensing::four_positions, 0.01);
  settings.stated = 0.5;
  const SensingResult found = ran(settings);
  EXPECT_FALSE(found.in_band());
  EXPECT_NEAR(found.nees, 12, 4 * found.band());
}

// Linear in the unknowns: in the band whatever the noise.
TEST(Sensing, BaseWrenchIsInItsBand) {
  const SensingResult found = ran(few(Sensing::base_wrench, 0.01));
  EXPECT_TRUE(found.in_band()) << found.nees;
}

// 10^5 numbers: mean within 4 deviations of its own, variance likewise; 4 sqrt(1/n), 4 sqrt(2/n).
TEST(Sensing, NoiseIsNormal) {
  studies::Noise noise(7);
  constexpr int n = 100'000;
  double sum = 0, squares = 0, fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double x = noise.normal();
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / n, 0, 0.0127);
  EXPECT_NEAR(squares / n, 1, 0.0179);
  EXPECT_NEAR(fourth / n, 3, 0.124);  // variance of x^4: 96
}

}  // namespace
