// Where a growing load meets a fold: the rod snaps.
#include "fem_reference/solve.h"
#include "support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fem_limit {

using scene::Frame;

// A planar hook, its tip pushed on a lever arm. The equation of the elastica, integrated from the tip by SciPy's DOP853
// to 1e-13 together with its derivative by the tip's angle, has a fold at this load (60 and 1.05 times it, stiffer).
constexpr double fold = 0.2382751703;
inline scene::Scene hook(double load_factor = 1) {
  const double angle_rad = 300 * std::numbers::pi / 180, force_N = 30 * load_factor;
  scene::Stiffness stiffness = support::slender(1, 100);  // it is to stay in its plane
  stiffness.bending_Nmm2[0] = 100;
  scene::Scene scene = support::uniform_rod(
      1, stiffness,
      {scene::Force{
          1, Frame::fixed, force_N * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0), {0.2, 0}}});
  scene.sections[0].rest_curvature_per_mm = {0, 0, 3};
  return scene;
}

inline scene::Equilibrium solved(const scene::Scene& scene, int elements = 100) {
  fem_reference::Options options;
  options.elements = elements;
  options.estimate_error = false;
  return fem_reference::solve(scene, options);
}

TEST(FemLimit, TheLoadFactorOfTheFold) {
  const scene::Equilibrium found = fem_limit::solved(hook());
  EXPECT_EQ(found.status, scene::Status::limit_point);
  EXPECT_EQ(found.message, "snaps at 23.8 % of the load");
  ASSERT_TRUE(found.limit.has_value());
  EXPECT_NEAR(found.limit->load_factor, fold, 1e-6);  // measured 4e-8
  EXPECT_EQ(found.limit->kind, "fold");
  EXPECT_TRUE(found.stations.empty());

  const scene::Equilibrium twin = fem_limit::solved(support::stiffer(hook()));
  EXPECT_GT(std::abs(twin.limit.value().load_factor - fold), 1e-2);
}

TEST(FemLimit, BelowItTheRodIsStable) {
  const scene::Equilibrium below = fem_limit::solved(hook(0.999 * fold));
  EXPECT_TRUE(below.converged()) << below.message;
  EXPECT_EQ(below.stable, true);
  EXPECT_FALSE(below.limit.has_value());
}

}  // namespace fem_limit
