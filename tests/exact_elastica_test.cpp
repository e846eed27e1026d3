// The closed form against tables, against GSL, against a march and a boundary value solution: four independent sides.
#include "exact_reference/elastica.h"
#include "exact_scenes.h"

#include <gsl/gsl_sf_elljac.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace exact_test;
using exact_reference::Elastica;
using exact_reference::Way;

namespace {

double distance(const exact_reference::PlanarPose& pose, const Vector3d& position_mm) {
  return (Vector3d(pose.position_B_mm[0], pose.position_B_mm[1], 0) - position_mm).norm();
}

// Largest distance of the closed form from all stations, mm.
double largest_distance(const Elastica& elastica, const scene::Equilibrium& result) {
  if (!result.converged()) return HUGE_VAL;
  double largest = 0;
  for (const scene::Station& station : result.stations) {
    largest = std::max(largest, distance(elastica.at(station.s_mm), station.X_BS.position_B_mm));
    const double angle = elastica.at(station.s_mm).angle_rad;
    largest =
        std::max(largest, (station.X_BS.rotation_BS.col(0) - Vector3d(std::cos(angle), std::sin(angle), 0)).norm());
  }
  return largest;
}

}  // namespace

TEST(Elastica, AmplitudeAgreesWithGsl) {  // where GSL's own function is good
  for (const double m : {0.01, 0.1, 0.5, 0.9, 0.99}) {
    for (const double u : {-7.0, -3.0, 0.0, 0.3, 1.7, 5.0, 40.0}) {
      double sn = 0, cn = 0, dn = 0;
      gsl_sf_elljac_e(u, m, &sn, &cn, &dn);
      const double phi = exact_reference::jacobi_amplitude(u, 1 - m);
      EXPECT_NEAR(std::sin(phi), sn, 2e-14) << m << " " << u;
      EXPECT_NEAR(std::cos(phi), cn, 2e-14) << m << " " << u;
      EXPECT_NEAR(exact_reference::elliptic_integral_F(phi, 1 - m), u, 3e-14 * (1 + std::abs(u)));
    }
  }
}

TEST(Elastica, FixedTransverseForceToAlpha100) {  // elliptic integrals by 40-digit arithmetic, 18 digits in the file
  for (const auto& row : rows("01_cantilever_dead_tip_load_elliptic.csv")) {
    const auto tip = Elastica::with_fixed_load({1, 1, {0, number(row[0])}, 0})->tip();
    EXPECT_NEAR(1 - tip.position_B_mm[0], number(row[1]), 1e-14) << "alpha " << row[0];
    EXPECT_NEAR(tip.position_B_mm[1], number(row[2]), 1e-14) << "alpha " << row[0];
    EXPECT_NEAR(tip.angle_rad, number(row[3]), 1e-14) << "alpha " << row[0];
    const auto twin = Elastica::with_fixed_load({1, 1.05, {0, number(row[0])}, 0})->tip();
    EXPECT_GT(std::abs(twin.position_B_mm[1] - number(row[2])), 1e-14) << "alpha " << row[0];
  }
}

TEST(Elastica, FollowerTransverseForceToBeta40) {  // 12 digits of position, 9 of angle in the file
  for (const auto& row : rows("05_follower_tip_force_reference.csv")) {
    const double beta = number(row[0]);
    const auto tip = Elastica::with_follower_load({1, 1, {0, beta}, 0}).tip();
    EXPECT_NEAR(tip.position_B_mm[0], number(row[1]), 1e-12) << beta;
    EXPECT_NEAR(tip.position_B_mm[1], number(row[2]), 1e-12) << beta;
    EXPECT_NEAR(tip.angle_rad, number(row[3]), 1e-9) << beta;
  }
}

TEST(Elastica, AgreesWithMarchAndBoundaryValueUnderFollowerLoads) {
  const double L = 40, EI = 750;
  const std::vector<Vector3d> loads{{0, -1.5, 60},  {0, 1, 0},     {0, 0, 90},       {-3, 0.2, 0}, {2, 1, -50},
                                    {0, 0.05, 400}, {0, 18.75, 0}, {-0.4, 0.01, -7}, {0, 0.3, 60}};  // F_x, F_y, M
  for (const Vector3d& load : loads) {
    const Elastica elastica = Elastica::with_follower_load({L, EI, load.head<2>(), load[2]});
    scene::Scene rod = tip_force(uniform_rod(L, EI, 500), Frame::follower, {load[0], load[1], 0});
    rod = tip_moment(rod, Frame::follower, {0, 0, load[2]});
    EXPECT_LT(largest_distance(elastica, solve(rod, Way::initial_value)), 1e-10 * L) << load.transpose();
    EXPECT_LT(largest_distance(elastica, solve(rod, Way::boundary_value)), 1e-10 * L) << load.transpose();
    EXPECT_GT(largest_distance(elastica, solve(stiffer(rod))), 1e-10 * L) << load.transpose();
  }
}

TEST(Elastica, AgreesWithBoundaryValueUnderFixedForces) {  // up to F L^2/EI = 22500, in all directions
  for (const double w : {0.3, 1.0, 3.0, 10.0, 50.0, 150.0}) {
    for (const double direction : {0.1, 0.9, 1.6, 2.5, 3.0, -2.8}) {
      const Vector3d force = w * w * Vector3d(std::cos(direction), std::sin(direction), 0);
      const auto elastica = Elastica::with_fixed_load({1, 1, force.head<2>(), 0});
      const scene::Scene rod = tip_force(uniform_rod(1, 1, 1), Frame::fixed, force);
      const scene::Equilibrium result = solve(rod);
      EXPECT_LT(largest_distance(*elastica, result), 1e-11) << w << " " << direction << " " << result.message;
      EXPECT_EQ(result.stable, true) << w << " " << direction;
      EXPECT_GT(largest_distance(*elastica, solve(stiffer(rod))), 1e-11);
    }
  }
}

TEST(Elastica, FixedForceWithMoment) {
  const auto elastica = Elastica::with_fixed_load({40, 750, {-0.3, 1}, 30});
  const scene::Scene rod =
      tip_moment(tip_force(uniform_rod(40, 750, 500), Frame::fixed, {-0.3, 1, 0}), Frame::fixed, {0, 0, 30});
  EXPECT_LT(largest_distance(*elastica, solve(rod)), 1e-10 * 40);
  EXPECT_GT(largest_distance(*elastica, solve(stiffer(rod))), 1e-10 * 40);
}

TEST(Elastica, ValuesByCollocation) {
  // By collocation, independent of this project: P4, follower (0, -1.5) N, 60 N mm; a fixed 1 N.
  const auto p4 = Elastica::with_follower_load({40, 750, {0, -1.5}, 60}).tip();
  EXPECT_LT(distance(p4, {15.93118975, 28.31369838, 0}), 1e-8);
  const auto fixed = Elastica::with_fixed_load({40, 750, {0, 1}, 0})->tip();
  EXPECT_LT(distance(fixed, {33.03110716, 20.47065732, 0}), 1e-8);
}
