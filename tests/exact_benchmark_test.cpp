// The exact reference against computed benchmark tables, to all digits that the files carry. Each file's head says how
// its numbers were made; none comes from this project. Units are those of each source, consistent sets.
#include "exact_scenes.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

using namespace exact_test;
using exact_reference::RodModel;
using exact_reference::Way;
using std::numbers::pi;

namespace {

RodModel model_of(const std::string& cell) {
  return cell == "K" ? RodModel::kirchhoff : RodModel::reissner;
}

// Torsion constant of a rectangle b x t, t <= b (St. Venant's series).
double rectangle_torsion_constant(double b, double t) {
  double sum = 0;
  for (int n = 1; n < 40; n += 2) sum += std::tanh(n * pi * b / (2 * t)) / std::pow(n, 5);
  return b * t * t * t * (1.0 / 3 - 64 * t / (std::pow(pi, 5) * b) * sum);
}

}  // namespace

TEST(ExactBenchmark, Bend45UnderDeadForce) {  // 9 digits of positions of size 100; the file claims 1e-9
  const double R = 100, E = 1e7, G = 5e6;
  for (const auto& row : rows("03_bend45_dead_reference.csv")) {
    const double J = row[1] == "polar" ? 1.0 / 6 : row[1] == "sv" ? 0.140577 : 0.141;
    scene::Scene rod = uniform_rod(R * pi / 4, E / 12, G * J);
    stiffness(rod).axial_N = E;
    stiffness(rod).shear_N = Vector2d::Constant(row[0] == "SR56" ? G * 5 / 6 : G);
    rod.sections[0].rest_curvature_per_mm = {0, 0, 1 / R};
    rod = tip_force(rod, Frame::fixed, {0, 0, number(row[2])});
    const Vector3d wanted(number(row[3]), number(row[4]), number(row[5]));
    const double limit = 1.5e-9;
    const scene::Equilibrium result = solve(rod, Way::automatic, model_of(row[0]));
    EXPECT_LT((tip_mm(result) - wanted).norm(), limit) << row[0] << " " << row[1] << " " << row[2] << result.message;
    EXPECT_EQ(result.stable, true);
    EXPECT_GT((tip_mm(solve(stiffer(rod), Way::automatic, model_of(row[0]))) - wanted).norm(), limit);
  }
}

TEST(ExactBenchmark, HelixToTenTurns) {  // 10 digits; every tenth load, and the last
  for (const bool shear : {true, false}) {
    for (const auto& row : rows(shear ? "04_helix_reference_SR.csv" : "04_helix_reference_K.csv")) {
      const double lambda = number(row[0]);
      if (std::abs(std::remainder(lambda, 0.1)) > 1e-9) continue;
      scene::Scene rod = uniform_rod(10, 100, 100);
      stiffness(rod).axial_N = 1e4;
      stiffness(rod).shear_N = Vector2d(1e4, 1e4);
      rod = tip_force(rod, Frame::fixed, {0, 0, 50 * lambda});
      rod = tip_moment(rod, Frame::fixed, {0, 0, 200 * pi * lambda});
      const scene::Equilibrium result = solve(rod, Way::automatic, shear ? RodModel::reissner : RodModel::kirchhoff);
      ASSERT_TRUE(result.converged()) << result.message;
      const Vector3d displacement = tip_mm(result) - Vector3d(10, 0, 0);
      EXPECT_LT((displacement - Vector3d(number(row[1]), number(row[2]), number(row[3]))).norm(), 2e-10) << lambda;
      const Vector3d tangent = result.tip().rotation_BS.col(0);
      EXPECT_LT((tangent - Vector3d(number(row[4]), number(row[5]), number(row[6]))).norm(), 3e-12) << lambda;
    }
  }
}

TEST(ExactBenchmark, HelixIdentity) {  // equal shear and axial, equal bending and torsion: u3 differs by F L/EA exactly
  scene::Scene rod = uniform_rod(10, 100, 100);
  stiffness(rod).axial_N = 1e4;
  stiffness(rod).shear_N = Vector2d(1e4, 1e4);
  rod = tip_moment(tip_force(rod, Frame::fixed, {0, 0, 50}), Frame::fixed, {0, 0, 200 * pi});
  const Vector3d flexible = tip_mm(solve(rod));
  const Vector3d rigid = tip_mm(solve(rod, Way::automatic, RodModel::kirchhoff));
  EXPECT_LT((flexible - rigid - Vector3d(0, 0, 0.05)).norm(), 1e-11);
  stiffness(rod).axial_N = 1.05e4;  // breaks the identity
  EXPECT_GT((tip_mm(solve(rod)) - rigid - Vector3d(0, 0, 0.05)).norm(), 1e-5);
}

TEST(ExactBenchmark, FollowerForceMarched) {
  for (const auto& row : rows("05_follower_tip_force_reference.csv")) {
    const scene::Scene rod = tip_force(uniform_rod(1, 1, 1), Frame::follower, {0, number(row[0]), 0});
    const scene::Equilibrium result = solve(rod);
    ASSERT_TRUE(result.converged());
    EXPECT_LT((tip_mm(result) - Vector3d(number(row[1]), number(row[2]), 0)).norm(), 1.5e-12) << row[0];
    EXPECT_NEAR(result.tip_angle_rad, number(row[3]), 1e-9) << row[0];
  }
}

TEST(ExactBenchmark, PrincetonBeam) {  // metres, newtons; 9 digits after the point
  const double b = 12.3777e-3, t = 3.2024e-3, E = 71.7e9, G = E / 2 / 1.31, A = b * t;
  for (const auto& row : rows("07_princeton_reference.csv")) {
    scene::Scene rod = uniform_rod(0.508, 1, G * rectangle_torsion_constant(b, t));
    stiffness(rod).bending_Nmm2 = {E * b * t * t * t / 12, E * t * b * b * b / 12};
    stiffness(rod).axial_N = E * A;
    stiffness(rod).shear_N = Vector2d::Constant(G * A);  // no shear coefficient: the file was made so, by its numbers
    const double angle = number(row[2]) * pi / 180, P = number(row[1]);
    rod = tip_force(rod, Frame::fixed, {0, P * std::cos(angle), P * std::sin(angle)});
    const Vector3d wanted(0.508 + number(row[3]), number(row[4]), number(row[5]));
    const scene::Equilibrium result = solve(rod, Way::automatic, model_of(row[0]));
    EXPECT_LT((tip_mm(result) - wanted).norm(), 1.5e-9) << row[0] << " " << P << " " << row[2] << result.message;
    EXPECT_GT((tip_mm(solve(stiffer(rod), Way::automatic, model_of(row[0]))) - wanted).norm(), 1.5e-9);
  }
}

TEST(ExactBenchmark, HeavyElastica) {  // 12 digits
  for (const auto& row : rows("08_heavy_elastica_reference.csv")) {
    const scene::DistributedForce weight{0, 1, Frame::fixed, {0, number(row[0]), 0}};
    const Vector3d wanted(number(row[1]), number(row[2]), 0);
    const scene::Equilibrium result = solve(with(uniform_rod(1, 1, 1), weight));
    EXPECT_LT((tip_mm(result) - wanted).norm(), 1.5e-12) << row[0] << " " << result.message;
    EXPECT_NEAR(result.tip_angle_rad, number(row[3]), 3e-12) << row[0];
    EXPECT_EQ(result.stable, true);
    EXPECT_GT((tip_mm(solve(stiffer(with(uniform_rod(1, 1, 1), weight)))) - wanted).norm(), 1.5e-12);
  }
}

TEST(ExactBenchmark, ThickCantilever) {  // Nachbagauer 2011, metres, newtons; shear coefficient by Cowper's rectangle
  const double L = 2, b = 0.1, h = 0.5, E = 2.07e11, nu = 0.3, G = E / 2 / (1 + nu);
  scene::Scene rod = uniform_rod(L, E * b * h * h * h / 12, 1e9);
  stiffness(rod).axial_N = E * b * h;
  stiffness(rod).shear_N = Vector2d::Constant(G * b * h * 10 * (1 + nu) / (12 + 11 * nu));
  for (const auto& row : rows("12_misc_planar_published.csv")) {
    const bool large = row[0].starts_with("Nachbagauer");
    if (!large && !row[0].starts_with("same")) continue;
    const Vector3d wanted(L - number(row[3]), number(row[4]), 0);
    const scene::Scene loaded = tip_force(rod, Frame::fixed, {0, large ? 6.25e7 : 6.25e4, 0});
    EXPECT_LT((tip_mm(solve(loaded)) - wanted).norm(), 1.5e-12) << row[0];
    EXPECT_GT((tip_mm(solve(stiffer(loaded))) - wanted).norm(), 1.5e-12);
  }
}

TEST(ExactBenchmark, CriticalLoads) {  // `stable` changes within 1e-6 of the classical loads
  std::vector<std::pair<std::string, double>> constants;
  for (const auto& row : rows("06_critical_load_constants.csv")) constants.emplace_back(row[0], number(row[1]));
  const auto stable = [&](const std::string& name, double factor) {
    for (const auto& [key, value] : constants) {
      if (key != name) continue;
      const double load = value * factor;
      scene::Scene rod = uniform_rod(1, 1, 1);
      if (name == "euler_clamped_free") return solve(tip_force(rod, Frame::fixed, {-load, 0, 0})).stable;
      if (name == "self_buckling_heavy_column") {
        return solve(with(rod, scene::DistributedForce{0, 1, Frame::fixed, {-load, 0, 0}})).stable;
      }
      stiffness(rod).bending_Nmm2 = {1e8, 1};  // narrow beam, loaded in its stiff plane
      if (name == "lateral_cantilever_centroid_tip_load")
        return solve(tip_force(rod, Frame::fixed, {0, 0, load})).stable;
      return solve(with(rod, scene::DistributedForce{0, 1, Frame::fixed, {0, 0, load}})).stable;
    }
    return std::optional<bool>();
  };
  for (const char* name : {"euler_clamped_free", "self_buckling_heavy_column", "lateral_cantilever_centroid_tip_load",
                           "lateral_cantilever_uniform_load"}) {
    EXPECT_EQ(stable(name, 1 - 1e-6), true) << name;
    EXPECT_EQ(stable(name, 1 + 1e-6), false) << name;
  }
}
