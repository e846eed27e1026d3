// What mutants once survived: the three methods on rods turned about their axis, with tendons and arms.
#include "survivors.h"

namespace {

using namespace survivors;

// A tendon at a constant offset and a rest curvature k0 in its plane: the rod's own moment is that of the tendon, so
// that the rod is an arc of curvature k0 + T r/EI up to the tendon's end. |t| = 1 - k r: the tendon shortens by T
// r^2/EI times its length, wherever it started from.
void tendon_on_a_curved_rod(const Method& solve) {
  const double T = 6, r = 2, EI = 750, k0 = 0.02, to_mm = 30, M = 5;
  for (const double angle : {0., 0.6435011087932844, pi / 2}) {  // (1, 0), (0.8, 0.6), (0, 1)
    const Vector2d along = angle == pi / 2 ? Vector2d(0, 1) : angle == 0 ? Vector2d(1, 0) : Vector2d(0.8, 0.6);
    const Vector3d normal(0, -along[1], along[0]);
    const auto found = [&](double factor) {
      Scene scene = uniform_rod(
          40, slender(EI, 500),
          {Tendon{r * along, T, to_mm}, Tendon{-r * along, 0, 40}, Moment{40, Frame::follower, M * normal}});
      scene.sections[0].rest_curvature_per_mm = k0 * normal;
      return solve(support::stiffer(scene, factor));
    };
    const Equilibrium result = found(1), twin = found(1.05);
    ASSERT_TRUE(result.converged() && twin.converged()) << result.message << twin.message;
    ASSERT_EQ(result.tendon_shortening_mm.size(), 2u);
    const double shortening = r * (T * r + M) / EI * to_mm, beyond = r * M / EI * (40 - to_mm);
    EXPECT_NEAR(result.tendon_shortening_mm[0], shortening, 1e-8) << angle;
    EXPECT_NEAR(result.tendon_shortening_mm[1], -shortening - beyond, 1e-8) << angle;
    EXPECT_GT(std::abs(twin.tendon_shortening_mm[0] - shortening), 1e-2);
    const double k = k0 + (T * r + M) / EI, turn = k * to_mm, end_k = k0 + M / EI, end = turn + end_k * (40 - to_mm);
    const double x = std::sin(turn) / k + (std::sin(end) - std::sin(turn)) / end_k;
    const double aside = (1 - std::cos(turn)) / k + (std::cos(turn) - std::cos(end)) / end_k;
    EXPECT_LT((tip(result) - Vector3d(x, aside * along[0], aside * along[1])).norm(), 1e-8) << angle;
    EXPECT_NEAR(result.tip_angle_rad, end, 1e-8);
    EXPECT_LT((result.base().moment_B_Nmm - (T * r + M) * normal).norm(), 1e-8);
    EXPECT_LT((result.base().force_B_N - Vector3d(-T, 0, 0)).norm(), 1e-8);
  }
}

TEST(SurvivorsFam, TendonOnACurvedRod) {
  tendon_on_a_curved_rod([](const Scene& scene) { return by_fam(scene, 1e-9); });
}
TEST(SurvivorsFem, TendonOnACurvedRod) {
  tendon_on_a_curved_rod([](const Scene& scene) { return by_fem(scene); });
}
TEST(SurvivorsExact, TendonOnACurvedRod) {
  tendon_on_a_curved_rod([](const Scene& scene) { return by_exact(scene); });
}

// One scene with every kind of load in the x-y plane, and the same turned about the axis.
void turned_about_the_axis(const Method& solve, double limit_mm) {
  const auto loaded = [](double c, double s) {
    const auto turn = [&](double x, double y) { return Vector3d(x, c * y, s * y); };
    const auto arm = [&](double y) { return Vector2d(c * y, s * y); };
    scene::Stiffness stiffness = slender(750, 500);
    stiffness.axial_N = 400;
    stiffness.shear_N = Vector2d::Constant(150);
    Scene scene = uniform_rod(
        40, stiffness,
        {Force{40, Frame::fixed, turn(-0.2, 0.5), arm(2)}, Tendon{arm(1.5), 4, 30},
         Force{25, Frame::follower, turn(0.1, -0.4), arm(-1)}, DistributedForce{5, 35, Frame::fixed, turn(0.002, 0.01)},
         DistributedForce{0, 20, Frame::follower, turn(0, -0.02)}});
    for (const Load& load : couple(20, turn(2, 0.5), arm(3))) scene.loads.push_back(load);
    scene.sections[0].rest_curvature_per_mm = 0.01 * Vector3d(0, -s, c);
    return scene;
  };
  const Equilibrium flat = solve(loaded(1, 0));
  ASSERT_TRUE(flat.converged()) << flat.message;
  EXPECT_GT((tip(flat) - tip(solve(support::stiffer(loaded(1, 0))))).norm(), 1e-2);
  for (const auto& [c, s] : {std::pair{0., 1.}, {0.8, 0.6}, {-0.6, 0.8}}) {
    const Equilibrium turned = solve(loaded(c, s));
    Matrix3d Q;
    Q << 1, 0, 0, 0, c, -s, 0, s, c;
    EXPECT_LT((tip(turned) - Q * tip(flat)).norm(), limit_mm) << c;
    ASSERT_EQ(turned.stations.size(), flat.stations.size());
    for (std::size_t k = 0; k < flat.stations.size(); ++k) {
      EXPECT_LT((turned.stations[k].moment_B_Nmm - Q * flat.stations[k].moment_B_Nmm).norm(), 100 * limit_mm);
    }
    EXPECT_NEAR(turned.tendon_shortening_mm[0], flat.tendon_shortening_mm[0], limit_mm) << c;
  }
}

TEST(SurvivorsFam, TurnedAboutTheAxis) {
  turned_about_the_axis([](const Scene& scene) { return by_fam(scene, 1e-8); }, 2e-8);
}
TEST(SurvivorsFem, TurnedAboutTheAxis) {
  turned_about_the_axis([](const Scene& scene) { return by_fem(scene); }, 1e-9);
}
TEST(SurvivorsExact, TurnedAboutTheAxis) {
  turned_about_the_axis([](const Scene& scene) { return by_exact(scene); }, 1e-9);
}

// One fixed force off the centreline, in planes at all angles: few enough round-offs for the turned scene to be planar.
void arm_turned_about_the_axis(const Method& solve, double limit_mm) {
  const auto loaded = [](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return uniform_rod(40, slender(750, 500), {Force{40, Frame::fixed, {-0.3, 0.5 * c, 0.5 * s}, {3 * c, 3 * s}}});
  };
  const Vector3d flat = tip(solve(loaded(0)));
  EXPECT_GT((flat - tip(solve(support::stiffer(loaded(0))))).norm(), 1e-2);
  int planar = 0;
  for (const double angle : {0.3, 0.7, 1.1, 1.9, 2.6, -0.4, -2.}) {
    const Matrix3d Q = AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix();
    EXPECT_LT((tip(solve(loaded(angle))) - Q * flat).norm(), limit_mm) << angle;
    planar += scene::plane_direction(spans(loaded(angle))).has_value();
  }
  EXPECT_GT(planar, 2);
}

TEST(SurvivorsFam, ArmTurnedAboutTheAxis) {
  arm_turned_about_the_axis([](const Scene& scene) { return by_fam(scene, 1e-8); }, 2e-8);
}
TEST(SurvivorsExact, ArmTurnedAboutTheAxis) {
  arm_turned_about_the_axis([](const Scene& scene) { return by_exact(scene); }, 1e-9);
}

}  // namespace
