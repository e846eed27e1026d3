// What mutants once survived: facts of scenes.
#include "survivors.h"

#include "scene/span_facts.h"

namespace {

using namespace survivors;

// Cowper's own limit for a thin tube: k = 2 (1 + nu) / (4 + 3 nu), area pi d t. A thick one's k lies beyond 1e-3 of it.
TEST(SurvivorsScene, ShearOfAThinTube) {
  const auto relative = [](double thickness) {
    const double E = 200, nu = 0.3, d = 10;
    const double k = 2 * (1 + nu) / (4 + 3 * nu), G = E / (2 * (1 + nu));
    const scene::Stiffness tube = stiffness_of(scene::CircularSection{d, d - 2 * thickness, E, nu, 0});
    return (*tube.shear_N)[0] / (k * G * pi * d * thickness) - 1;
  };
  EXPECT_LT(std::abs(relative(1e-4)), 1e-4);
  EXPECT_GT(std::abs(relative(1)), 1e-3);
}

TEST(SurvivorsScene, ARodIsCutWhereATendonEnds) {
  const auto cut = spans(uniform_rod(40, slender(1, 1), {Tendon{{1, 0}, 3, 25}, Tendon{{1, 0}, 4, 40}}));
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_EQ(cut[0].end_mm, 25);
  ASSERT_EQ(cut[0].tendons.size(), 1u);
  EXPECT_EQ(cut[0].tendons[0].tension_N, 7);
  EXPECT_EQ(cut[1].tendons[0].tension_N, 4);
}

TEST(SurvivorsScene, ArmsOfForces) {  // r x F with r = (0, 1, 2), F = (3, 4, 5)
  const auto rod = spans(uniform_rod(40, slender(1, 1), {Force{40, Frame::follower, {3, 4, 5}, {1, 2}}}));
  EXPECT_EQ(rod[0].follower_load_S.moment_Nmm, Vector3d(-3, 6, -3));
  const auto fixed = spans(uniform_rod(40, slender(1, 1), {Force{40, Frame::fixed, {3, 4, 5}, {1, 2}}}));
  EXPECT_EQ(scene::moment_of_arms(fixed[0].fixed_force_arms_BS_Nmm), Vector3d(-3, 6, -3));
}

TEST(SurvivorsScene, FactsOfLeverArmsAndTendons) {
  const auto of = [](const std::vector<Load>& loads) { return spans(uniform_rod(40, slender(1, 1), loads)); };
  using scene::Symmetry;
  const auto bending = of(couple(40, {1, 0, 0}, {2, 0})), twisting = of(couple(40, {0, 0, 1}, {2, 0}));
  EXPECT_FALSE(scene::all_loads_follow(bending));
  EXPECT_FALSE(scene::is_round(bending));
  EXPECT_TRUE(scene::is_round(of({Force{40, Frame::fixed, {1, 2, 3}}})));
  EXPECT_EQ(scene::symmetry_of(bending), Symmetry::plane_xy);
  EXPECT_EQ(scene::symmetry_of(twisting), Symmetry::none);
  EXPECT_TRUE(scene::plane_direction(bending).has_value());
  EXPECT_FALSE(scene::plane_direction(twisting).has_value());
  // Two tendons across the plane of the force, and the mirrored pair.
  const Load aside = Force{40, Frame::fixed, {0, 1, 0}};
  EXPECT_FALSE(scene::plane_direction(of({Tendon{{1, 1}, 1, 40}, Tendon{{-1, -1}, 1, 40}, aside})).has_value());
  EXPECT_TRUE(scene::plane_direction(of({Tendon{{1, 1}, 1, 40}, Tendon{{1, -1}, 1, 40}, aside})).has_value());
  EXPECT_EQ(scene::symmetry_of(of({Tendon{{2, 0}, 1, 40}, Tendon{{-2, 0}, 1, 40}})), Symmetry::axis);
  EXPECT_EQ(scene::symmetry_of(of({Tendon{{2, 0}, 1, 40}, Tendon{{-2, 0}, 2, 40}})), Symmetry::plane_xy);
  EXPECT_TRUE(scene::is_conservative(of({aside})));
  EXPECT_FALSE(scene::is_conservative(of({aside, Moment{40, Frame::fixed, {0, 0, 1}}})));
}

TEST(SurvivorsScene, FactsOfFlatSections) {
  const std::vector<Load> oblique = {Force{40, Frame::fixed, {0, 1, 1}}};
  EXPECT_FALSE(scene::plane_direction(spans(uniform_rod(40, strip(), oblique))).has_value());
  EXPECT_TRUE(scene::plane_direction(spans(uniform_rod(40, slender(1, 1), oblique))).has_value());
  EXPECT_FALSE(scene::is_round(spans(uniform_rod(40, strip(), {}))));
  scene::Stiffness sheared = slender(1, 1);
  sheared.shear_N = Vector2d(10, 20);
  EXPECT_FALSE(scene::is_isotropic(spans(uniform_rod(40, sheared, oblique))));
  sheared.shear_N = Vector2d(10, 10);
  EXPECT_TRUE(scene::is_isotropic(spans(uniform_rod(40, sheared, oblique))));
}

TEST(SurvivorsScene, TurnsBackAndForthCancel) {
  std::vector<scene::Station> stations(3);
  stations[1].X_BS.rotation_BS = AngleAxisd(0.4, Vector3d::UnitZ()).toRotationMatrix();
  stations[2].X_BS.rotation_BS = AngleAxisd(-0.1, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(scene::tip_angle_rad(stations, Vector3d(0, 0, 1)), 0.1, 1e-14);
}

}  // namespace
