// Tendons along their own tangent and forces off the centreline: independent shooting (tests/data/14, 15), closed
// forms, derivatives by differences.
#include "exact_reference/rod_equations.h"
#include "exact_scenes.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace exact_test;
using Eigen::Matrix3d;
using exact_reference::RodEquations;
using exact_reference::State;
using exact_reference::Way;

namespace {

nlohmann::json read_json(const std::string& file) {
  std::ifstream input(std::string(TEST_DATA_DIR) + "/" + file);
  if (!input) throw std::runtime_error("cannot read " + file);
  return nlohmann::json::parse(input);
}

Vector3d vector_of(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

scene::Scene scene_of(const nlohmann::json& check) {
  std::stringstream text(check.at("scene").dump());
  return scene::read_scene(text, "check");
}

// Largest relative difference from a check: tip, rotation, own wrench at the clamp.
double mismatch(const scene::Equilibrium& result, const nlohmann::json& check) {
  if (!result.converged()) return HUGE_VAL;
  const char *force = check.contains("base_force_N") ? "base_force_N" : "base_own_force_N",
             *moment = check.contains("base_moment_Nmm") ? "base_moment_Nmm" : "base_own_moment_Nmm";
  const Vector3d tip_mm = vector_of(check.at("tip_mm")), force_N = vector_of(check.at(force)),
                 moment_Nmm = vector_of(check.at(moment));
  double largest = std::max({(result.tip().position_B_mm - tip_mm).norm() / tip_mm.norm(),
                             (result.base().force_B_N - force_N).norm() / force_N.norm(),
                             (result.base().moment_B_Nmm - moment_Nmm).norm() / moment_Nmm.norm()});
  for (int i = 0; i < 3; ++i) {
    const Vector3d row = result.tip().rotation_BS.row(i);
    largest = std::max(largest, (row - vector_of(check.at("rotation").at(i))).norm());
  }
  return largest;
}

// A unit quaternion, N, M; p = 0.
State random_state(std::mt19937& engine) {
  std::normal_distribution<double> normal;
  State y = State::Zero();
  for (int i = 0; i < 10; ++i) y[i] = normal(engine);
  y.head<4>().normalize();
  return y;
}

exact_reference::ScaledSpan span_with_everything() {
  exact_reference::ScaledSpan span;
  span.start = 0;
  span.end = 1;
  span.bending_compliance = {1.4, 1.0, 0.7};
  span.shear_compliance = {0.01, 0, 0.02};  // rigid along y
  span.rest_curvature_S = {0.1, -0.2, 0.3};
  span.follower_density_S = {0.4, 0.3, -0.2};
  span.fixed_density_B = {0.1, 0.2, 0.3};
  span.follower_load_S = {{0.2, -0.3, 0.1}, {0.3, 0.1, 0.2}};
  span.fixed_load_B = {{0.1, 0.3, -0.2}, {0.1, -0.1, 0.2}};
  span.fixed_force_arms_BS = Vector3d(0.5, -0.8, 0.3) * Vector3d(0, 0.2, -0.1).transpose() +
                             Vector3d(0.1, 1, 0) * Vector3d(0, 0, 0.3).transpose();
  span.tendons = {{{0, 0.1, 0}, 6}, {{0, -0.05, 0.08}, 3}, {{0, 0, 0}, 2}};
  return span;
}

}  // namespace

TEST(ExactTendons, IndependentShooting) {
  for (const char* file : {"14_tendons.json", "15_offset_forces.json"}) {
    for (const nlohmann::json& check : read_json(file)) {
      const scene::Scene rod = scene_of(check);
      EXPECT_LT(mismatch(solve(rod), check), 1e-8) << rod.title;
      EXPECT_LT(mismatch(solve(rod, Way::boundary_value), check), 1e-8) << rod.title;
      EXPECT_GT(mismatch(solve(stiffer(rod)), check), 1e-8) << rod.title;
    }
  }
}

TEST(ExactTendons, TwistedPair) {  // GJ u + 2 T r^2 u/sqrt(1 + r^2 u^2) = M; 0.04 per mm without the tilt
  const double L = 40, GJ = 500, T = 5, r = 3, M = 20;
  const auto twist_of = [&](double stiffness_Nmm2) {
    double u = 0;
    for (int i = 0; i < 200; ++i) u = M / (stiffness_Nmm2 + 2 * T * r * r / std::sqrt(1 + r * r * u * u));
    return u;
  };
  EXPECT_NEAR(twist_of(GJ), 0.0339249, 5e-8);
  scene::Scene rod = tip_moment(uniform_rod(L, 750, GJ), Frame::follower, {M, 0, 0});
  rod = with(with(rod, scene::Tendon{{r, 0}, T, L}), scene::Tendon{{-r, 0}, T, L});
  for (const Way way : {Way::initial_value, Way::boundary_value}) {
    const scene::Equilibrium result = solve(rod, way);
    ASSERT_TRUE(result.converged()) << result.message;
    const double u = twist_of(GJ), tilted = std::sqrt(1 + r * r * u * u);
    EXPECT_NEAR(result.tip_angle_rad, u * L, 1e-10);
    EXPECT_NEAR(result.base().moment_B_Nmm[0], GJ * u, 1e-9);
    EXPECT_NEAR(result.base().force_B_N[0], -2 * T / tilted, 1e-10);
    ASSERT_EQ(result.tendon_shortening_mm.size(), 2u);
    for (const double shortening_mm : result.tendon_shortening_mm) EXPECT_NEAR(shortening_mm, L - L * tilted, 1e-11);
    EXPECT_GT(std::abs(solve(stiffer(rod), way).tip_angle_rad - u * L), 1e-10);
  }
}

TEST(ExactTendons, ShorteningOfACircle) {  // |t| = 1 - u_z y; a slack tendon measures; the third ends half way
  const double L = 40, EI = 750, T = 3, y = 1.2, u = T * y / EI;
  scene::Scene rod = with(uniform_rod(L, EI, 500), scene::Tendon{{y, 0}, T, L});
  rod = with(with(rod, scene::Tendon{{-2, 0}, 0, L}), scene::Tendon{{0.5, 0.7}, 0, L / 2});
  rod.sections[0].rest_curvature_per_mm = {0, 0, 0.01};
  for (const Way way : {Way::initial_value, Way::boundary_value}) {
    const std::vector<double> shortening_mm = solve(rod, way).tendon_shortening_mm;
    ASSERT_EQ(shortening_mm.size(), 3u);
    EXPECT_NEAR(shortening_mm[0], u * y * L, 1e-12);
    EXPECT_NEAR(shortening_mm[1], -u * 2 * L, 1e-12);
    EXPECT_NEAR(shortening_mm[2], u * 0.5 * L / 2, 1e-12);
    EXPECT_GT(std::abs(solve(stiffer(rod), way).tendon_shortening_mm[0] - u * y * L), 1e-12);
  }
}

// The work that the tendons do is the energy that the rod takes up, however they tilt: dE = sum T d(shortening).
TEST(ExactTendons, ShorteningIsTheDerivativeOfTheEnergy) {
  const auto at = [](double tension) {
    scene::Scene rod = with(uniform_rod(40, 750, 300), scene::Tendon{{2, 0.3}, tension, 40});
    rod.sections[0].rest_curvature_per_mm = {0.02, 0.01, -0.02};
    return solve(with(rod, scene::Tendon{{-1, 1.5}, 2, 25}), Way::boundary_value);
  };
  // Potential energy P(T) at equilibrium: dP/dT = -shortening. P by Simpson's rule over uniform stretches of strain.
  const auto potential = [](const scene::Equilibrium& result, double tension) {
    const Vector3d K(300, 750, 750), u0(0.02, 0.01, -0.02);
    double energy = 0;
    for (std::size_t k = 1; k < result.stations.size(); ++k) {  // each stretch has one curvature: no load but tendons
      const scene::Station& station = result.stations[k];
      const Vector3d m = station.X_BS.rotation_BS.transpose() * station.moment_B_Nmm;
      energy += (station.s_mm - result.stations[k - 1].s_mm) * 0.5 * m.dot(m.cwiseQuotient(K));
    }
    return energy - tension * result.tendon_shortening_mm[0] - 2 * result.tendon_shortening_mm[1];
  };
  const double T = 4, dT = 1e-3;
  const double slope = (potential(at(T + dT), T + dT) - potential(at(T - dT), T - dT)) / (2 * dT);
  EXPECT_NEAR(slope, -at(T).tendon_shortening_mm[0], 1e-8);
  EXPECT_GT(std::abs(slope + at(1.05 * T).tendon_shortening_mm[0]), 1e-4);
}

TEST(ExactTendons, AloneTheyAreStableAndUnique) {  // the energy is convex: march and boundary value find the same
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 10; ++i) {
    scene::Scene rod = uniform_rod(20, 900, 300 + 250 * uniform(engine));
    rod.sections.push_back({25, scene::Stiffness{300, {400, 200}, 500, {}, 0}, {0.02, -0.01, 0.03}});
    for (int k = 0; k < 3; ++k) {
      const Vector2d offset_mm(2 * uniform(engine), 2 * uniform(engine));
      rod = with(rod, scene::Tendon{offset_mm, 6 + 5 * uniform(engine), 30 + 15 * uniform(engine)});
    }
    const scene::Equilibrium march = solve(rod, Way::initial_value), boundary = solve(rod, Way::boundary_value);
    EXPECT_EQ(march.stable, true);
    EXPECT_EQ(boundary.stable, true);
    EXPECT_LT((tip_mm(march) - tip_mm(boundary)).norm(), 1e-10) << march.message << boundary.message;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(march.tendon_shortening_mm[k], boundary.tendon_shortening_mm[k], 1e-10);
    }
    EXPECT_LT((march.base().moment_B_Nmm - boundary.base().moment_B_Nmm).norm(), 1e-9);
    EXPECT_GT((tip_mm(solve(stiffer(rod))) - tip_mm(march)).norm(), 1e-6);
  }
}

TEST(ExactTendons, CollapseIsAStatus) {  // alone: u_z = T y/EI, |t| = 1 - u_z y = 0 at T = EI/y^2
  const double EI = 750, y = 2;
  for (const double share : {0.99, 1.01, 3.0}) {
    const scene::Scene rod = with(uniform_rod(40, EI, 500), scene::Tendon{{y, 0}, share * EI / y / y, 40});
    const scene::Scene pushed = tip_force(rod, Frame::fixed, {1e-4, 2e-4, 3e-4});
    const scene::Equilibrium march = solve(rod), boundary = solve(pushed);
    if (share < 1) {
      EXPECT_TRUE(march.converged() && boundary.converged()) << march.message << boundary.message;
      EXPECT_NEAR(march.tip_angle_rad, share / y * 40, 1e-9);
    } else {
      EXPECT_EQ(march.status, scene::Status::tendon_collapsed) << share << march.message;
      EXPECT_EQ(boundary.status, scene::Status::tendon_collapsed) << share << boundary.message;
      EXPECT_TRUE(march.stations.empty() && boundary.stations.empty());
    }
  }
}

TEST(ExactTendons, JacobianByDifferences) {
  std::mt19937 engine(3);
  const exact_reference::ScaledSpan span = span_with_everything();
  const RodEquations rod(span, 0.8);
  for (int i = 0; i < 20; ++i) {
    const State y = random_state(engine);
    exact_reference::CoreMatrix slope;
    EXPECT_EQ(rod.derivative(y, slope), rod.derivative(y));
    const exact_reference::CoreMatrix loads = rod.beyond_point_loads_jacobian(y);
    for (int k = 0; k < 10; ++k) {
      const double h = 1e-5;
      const State up = y + h * State::Unit(k), down = y - h * State::Unit(k);
      const State by = (rod.derivative(up) - rod.derivative(down)) / (2 * h);
      EXPECT_LT((by.head<10>() - slope.col(k)).norm(), 1e-7) << k;
      const State beyond = (rod.beyond_point_loads(up) - rod.beyond_point_loads(down)) / (2 * h);
      EXPECT_LT((beyond.head<10>() - loads.col(k)).norm(), 1e-7) << k;
    }
  }
}

TEST(ExactOffsetForces, SecondVariationByTheEnergy) {  // -sum F . (R r), R turned by exp([theta]x)
  std::mt19937 engine(5);
  const exact_reference::ScaledSpan span = span_with_everything();
  const RodEquations rod(span, 1);
  for (int i = 0; i < 20; ++i) {
    const State y = random_state(engine);
    const Matrix3d R = exact_reference::rotation_of(y.head<4>());
    const auto energy = [&](const Vector3d& theta) {
      const Matrix3d turned = Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix() * R;
      return -(span.fixed_force_arms_BS.transpose() * turned).trace();
    };
    const Vector3d theta = 1e-3 * y.segment<3>(7).normalized();
    const double none = -(span.fixed_force_arms_BS.transpose() * R).trace();
    const double second = energy(theta) + energy(-theta) - 2 * none;
    EXPECT_NEAR(second / 1e-6, theta.dot(rod.arms_second_variation(y) * theta) / 1e-6, 1e-6);
  }
}

// Two forces that press on a section from either side twist the rod away once 2 F a exceeds its torsional spring, GJ/L.
TEST(ExactOffsetForces, PressedTogetherTheyTwistTheRod) {
  const double L = 30, GJ = 400, a = 2, critical = GJ / L / (2 * a);
  for (const double factor : {1 - 1e-6, 1 + 1e-6, -5.0}) {
    scene::Scene rod = uniform_rod(L, 1e7, GJ);
    for (const double side : {1.0, -1.0}) {
      rod = with(rod, scene::Force{L, Frame::fixed, {0, -side * factor * critical, 0}, {side * a, 0}});
    }
    const scene::Equilibrium result = solve(rod);
    ASSERT_TRUE(result.converged()) << result.message;
    EXPECT_EQ(result.stable, factor < 1) << factor;
    EXPECT_EQ(solve(stiffer(rod)).stable, true);
  }
}

TEST(ExactOffsetForces, CancellingForcesAreStillSeen) {  // a couple fixed in the base frame whose arms turn
  scene::Scene rod = uniform_rod(30, 700, 400);
  rod = with(rod, scene::Force{30, Frame::fixed, {0, 0, 2}, {1.5, 0}});
  rod = with(rod, scene::Force{30, Frame::fixed, {0, 0, -2}, {-1.5, 0}});
  EXPECT_EQ(solve(rod, Way::initial_value).status, scene::Status::unsupported);
  // Pure twist: GJ phi/L = 2 F a cos(phi).
  double phi = 0;
  for (int i = 0; i < 200; ++i) phi = 0.5 * phi + 0.5 * 30 * 6 * std::cos(phi) / 400;
  const scene::Equilibrium result = solve(rod);
  ASSERT_TRUE(result.converged()) << result.message;
  EXPECT_NEAR(result.tip_angle_rad, phi, 1e-11);
  EXPECT_EQ(result.stable, true);
  EXPECT_GT(std::abs(solve(stiffer(rod)).tip_angle_rad - phi), 1e-11);
}
