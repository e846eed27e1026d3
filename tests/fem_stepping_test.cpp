// When Newton's iteration ends, and what a load step refuses.
#include "fem_benchmark.h"
#include "fem_reference/load_stepping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace fem_reference {
namespace {

using Eigen::Vector3d;
using scene::Frame;
using support::slender;
using support::uniform_rod;

constexpr double pi = std::numbers::pi;

BeamModel model_of(const scene::Scene& scene, int elements = 50) {
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  return beam_model(spans, scene::cells_per_span(spans, elements), reference_element(2, 2), true);
}

Residual residual(double force, double moment, double gap) {
  Residual result;
  result.largest_force = force;
  result.largest_moment = moment;
  result.largest_gap = gap;
  return result;
}

TEST(FemStepping, NewtonEndsWithASmallIncrementAndASmallResidual) {
  const double tolerance = 1e-10, small = 0.9e-10, large = 1.1e-10;
  EXPECT_TRUE(is_converged(small, residual(small, small, small), 0, tolerance));
  EXPECT_FALSE(is_converged(large, residual(0, 0, 0), 0, tolerance));
  EXPECT_FALSE(is_converged(0, residual(large, 0, 0), 0, tolerance));
  EXPECT_FALSE(is_converged(0, residual(0, large, 0), 0, tolerance));
  EXPECT_FALSE(is_converged(0, residual(0, 0, large), 0, tolerance));
  // The residual counts by the size of the forces, the increment does not.
  EXPECT_TRUE(is_converged(0, residual(large, large, large), 2, tolerance));
  EXPECT_FALSE(is_converged(large, residual(0, 0, 0), 2, tolerance));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_converged(nan, residual(0, 0, 0), 0, tolerance));
  EXPECT_FALSE(is_converged(0, residual(0, nan, 0), 0, tolerance));
}

TEST(FemStepping, TheNextIncrementFollowsFromTheLastTwo) {
  EXPECT_EQ(next_increment(0, 1e-3), 1e-3);  // nothing to go by
  EXPECT_DOUBLE_EQ(next_increment(1e-3, 1e-6), 1e-9);
  EXPECT_EQ(next_increment(1e-6, 1e-3), 1e-3);  // it grows
}

// A coarse tolerance shows whether the result keeps it: the residual of the state that was handed out.
TEST(FemStepping, TheResultKeepsTheTolerance) {
  const BeamModel model = model_of(uniform_rod(40, slender(1500, 1000), {scene::Force{40, Frame::fixed, {-3, 8, 6}}}));
  for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
    SteppingOptions options;
    options.tolerance = tolerance;
    const SteppingResult found = step_to_full_load(model, options);
    ASSERT_EQ(found.status, scene::Status::converged) << found.message;
    double force = 1;
    for (const Vector3d& force_S : found.state.force_S) force = std::max(force, force_S.lpNorm<Eigen::Infinity>());
    EXPECT_LE(BeamSystem(model).assemble(found.state, 1).largest(), tolerance * force) << tolerance;
  }
}

// A column on its axis, whose determinant nobody watches, falls from stable to unstable at Euler's load: not in a step
// longer than smallest_bifurcation_step, nor at all where that is zero.
TEST(FemStepping, AStepToAnUnstableEquilibriumIsRefused) {
  const double pressed_N = 1.25 * pi * pi * 750 / (4 * 40 * 40);
  const BeamModel model =
      model_of(uniform_rod(40, slender(750, 500), {scene::Force{40, Frame::fixed, {-pressed_N, 0, 0}}}));
  SteppingOptions never;
  never.smallest_bifurcation_step = 0;
  const SteppingResult refused = step_to_full_load(model, never);
  EXPECT_EQ(refused.status, scene::Status::load_step_too_small);
  EXPECT_NE(refused.message.find("load factor 0.8"), std::string::npos) << refused.message;
  EXPECT_NE(refused.message.find("unstable"), std::string::npos) << refused.message;

  const SteppingResult held = step_to_full_load(model, {});
  EXPECT_EQ(held.status, scene::Status::converged);
  EXPECT_EQ(held.stable, false);
}

}  // namespace
}  // namespace fem_reference
