// Derivatives of solved rods: an independent shooting (tests/data/13), central differences of the kernel's and of the
// exact reference's solutions, and what balance and energy say.
#include "exact_reference/solve.h"
#include "response_support.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace support;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using fam::Law;
using scene::DistributedForce, scene::Force, scene::Frame, scene::Gravity, scene::Moment, scene::Scene, scene::Tendon;

namespace {

const char* const names[] = {"pose", "strain", "wrench"};

// The largest difference over the largest entry, rows of positions and of turns (u and v, forces and moments) apart;
// entries below the floor are zero.
double mismatch(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double floor_top = 0, double floor_bottom = 0) {
  const auto part = [&](const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, double floor) {
    return (x - y).cwiseAbs().maxCoeff() / std::max({y.cwiseAbs().maxCoeff(), floor, 1e-300});
  };
  return std::max(part(a.topRows(3), b.topRows(3), floor_top), part(a.bottomRows(3), b.bottomRows(3), floor_bottom));
}

nlohmann::json check_values() {
  std::ifstream input(TEST_DATA_DIR "/13_derivatives.json");
  return nlohmann::json::parse(input);
}
Scene scene_of(const nlohmann::json& check) {
  std::stringstream text(check.at("scene").dump());
  return scene::read_scene(text, "13_derivatives.json");
}
Eigen::MatrixXd matrix_of(const nlohmann::json& rows) {
  const bool one_column = !rows.at(0).is_array();
  Eigen::MatrixXd matrix(rows.size(), one_column ? 1 : rows.at(0).size());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      const nlohmann::json& row = rows.at(static_cast<std::size_t>(i));
      matrix(i, k) = (one_column ? row : row.at(static_cast<std::size_t>(k))).get<double>();
    }
  }
  return matrix;
}

// The largest difference of a block from the check values over the block's largest entry.
double check_mismatch(const Scene& scene, const nlohmann::json& check) {
  SolvedRod rod(scene, 160);
  const double tip = rod.length_mm();
  if (!rod.converged()) return HUGE_VAL;
  double largest = 0;
  const auto compare = [&](const Eigen::MatrixXd& block, const nlohmann::json& expected) {
    const Eigen::MatrixXd values = matrix_of(expected);
    largest = std::max(largest, (block - values).cwiseAbs().maxCoeff() / values.cwiseAbs().maxCoeff());
  };
  for (const auto& load : check.at("loads"))
    compare(rod.response().by_load(load.at("load"), tip, What::pose), load.at("tip"));
  for (const auto& section : check.at("sections")) {
    const std::size_t i = section.at("section");
    const Columns stiffness = rod.response().by_stiffness(i, tip, What::pose);
    compare(stiffness.col(0), section.at("torsion_Nmm2"));
    compare(stiffness.rightCols<2>(), section.at("bending_Nmm2"));
    compare(rod.response().by_rest_curvature(i, tip, What::pose), section.at("rest_curvature_per_mm"));
  }
  if (check.contains("tip_compliance")) compare(rod.response().compliance(tip, What::pose), check.at("tip_compliance"));
  return largest;
}

// Limit: the 1e-7 of each block's largest entry. Origin: differences of an independent shooting (tests/data).
TEST(Derivatives, MatchTheCheckValues) {
  for (const nlohmann::json& check : check_values()) {
    EXPECT_LE(check_mismatch(scene_of(check), check), 1e-7) << scene_of(check).title;
    EXPECT_GE(check_mismatch(stiffer(scene_of(check)), check), 1e-2) << "the twin, 5 % stiffer";
  }
}

scene::Stiffness soft() {
  scene::Stiffness stiffness = slender(1000, 800);
  stiffness.bending_Nmm2[1] = 1500;
  stiffness.mass_per_length_kg_per_m = 0.04;
  stiffness.axial_N = 150;
  stiffness.shear_N = Eigen::Vector2d(40, 60);
  return stiffness;
}
scene::Stiffness rigid_in_shear() {
  scene::Stiffness stiffness = soft();
  stiffness.axial_N.reset();
  stiffness.shear_N.reset();
  return stiffness;
}

// Every kind of load, in both frames, with arms; two sections, one of them bent at rest.
Scene everything(const scene::Stiffness& stiffness, double size) {
  Scene scene;
  scene.sections = {{60, stiffness, {0, 0, 0}}, {40, stiffness, {0.004, -0.01, 0.02}}};
  scene.loads = {Force{100, Frame::fixed, size * Vector3d(-0.05, 0.1, 0.15), {2, -3}},
                 Force{75, Frame::follower, size * Vector3d(0.05, -0.2, 0.1), {-1, 2}},
                 Moment{100, Frame::fixed, size * Vector3d(3, -5, 4)},
                 Moment{35, Frame::follower, size * Vector3d(4, 2, -3)},
                 DistributedForce{20, 80, Frame::fixed, size * Vector3d(0, 2e-3, -1e-3)},
                 DistributedForce{0, 60, Frame::follower, size * Vector3d(1e-3, -2e-3, 2e-3)},
                 Gravity{size * Vector3d(1, -2, -9.81)}};
  return scene;
}
// Five: more than the slopes take at once.
Scene with_tendons(Scene scene, double tension_N) {
  scene.loads.push_back(Tendon{{0, 3}, tension_N, 100});
  scene.loads.push_back(Tendon{{-2, -1}, 0.7 * tension_N, 80});
  scene.loads.push_back(Tendon{{1, -1.5}, 0.4 * tension_N, 100});
  scene.loads.push_back(Tendon{{1.5, 1}, 0.2 * tension_N, 45});
  scene.loads.push_back(Tendon{{-1, 2}, 0.3 * tension_N, 80});
  return scene;
}

// The kernel's derivatives against differences of its own solutions of changed scenes. Those by places are the rod's,
// not the arcs', whose lengths change with them: left out where arcs are few.
enum class Arcs { few, many };
void expect_differences(SolvedRod& rod, Arcs arcs,
                        std::initializer_list<What> whats = {What::pose, What::strain, What::wrench}) {
  constexpr double limit = 1e-6;
  ASSERT_TRUE(rod.converged());
  const double L = rod.length_mm();
  for (const fam::Parameter& parameter : parameters_of(rod.scene())) {
    if (arcs == Arcs::few && parameter.kind == Kind::place) continue;
    const double step = step_of(rod.scene(), parameter);
    const Differences differences_by(rod, parameter);
    for (const double share : {0.317, 1.0}) {
      for (const What what : whats) {
        const double floor_top[] = {1e-3 * L, 1e-5 / L, 1e-5 * 1000 / L / L};
        const double floor_bottom[] = {1e-3, 1e-5, 1e-5 * 1000 / L};
        const auto w = static_cast<int>(what);
        const Vector6 exact = derivative(rod.response(), parameter, share * L, what);
        const Vector6 differences = differences_by.at(share * L, what);
        EXPECT_LE(mismatch(exact * step, differences * step, floor_top[w], floor_bottom[w]), limit)
            << names[w] << " at " << share << " L by kind " << static_cast<int>(parameter.kind) << " index "
            << parameter.index << " component " << parameter.component << "\n"
            << exact.transpose() << "\n"
            << differences.transpose();
      }
    }
  }
}

// Limit: what differences over steps of 1e-2 resolve after one extrapolation.
TEST(Derivatives, AreThoseOfTheDiscreteRod) {
  for (const Law law : {Law::midpoint, Law::fourth_order, Law::sixth_order}) {
    SolvedRod kirchhoff(everything(rigid_in_shear(), 1), 30, law), reissner(everything(soft(), 1), 30, law);
    expect_differences(kirchhoff, Arcs::few, {What::pose});
    expect_differences(reissner, Arcs::few, {What::pose});
  }
}
TEST(Derivatives, OfStrainsAndWrenches) {
  SolvedRod kirchhoff(everything(rigid_in_shear(), 1), 80), reissner(everything(soft(), 1), 80);
  expect_differences(kirchhoff, Arcs::many);
  expect_differences(reissner, Arcs::many);
}
TEST(Derivatives, OfTendons) {
  SolvedRod kirchhoff(with_tendons(everything(rigid_in_shear(), 1), 2), 80);
  SolvedRod reissner(with_tendons(everything(soft(), 1), 2), 80);
  SolvedRod by_midpoint(with_tendons(everything(soft(), 1), 2), 30, Law::midpoint);
  expect_differences(kirchhoff, Arcs::many);
  expect_differences(reissner, Arcs::many);
  expect_differences(by_midpoint, Arcs::few, {What::pose});
}
// Loads of zero, slack tendons among them.
TEST(Derivatives, OfLoadsOfZero) {
  SolvedRod kirchhoff(with_tendons(everything(rigid_in_shear(), 0), 0), 80);
  SolvedRod reissner(with_tendons(everything(soft(), 0), 0), 80);
  expect_differences(kirchhoff, Arcs::many);
  expect_differences(reissner, Arcs::many);
}
TEST(Derivatives, OfAPlanarRodOutOfItsPlane) {
  Scene scene = uniform_rod(100, rigid_in_shear(), {Force{100, Frame::fixed, {-0.1, 0.2, 0}}, Tendon{{3, 0}, 1, 100}});
  SolvedRod rod(scene, 60);
  expect_differences(rod, Arcs::many);
}

// A follower moment bends a strip to a circle, exact with a single arc; what bends it sideways then turns by 5 rad. The
// kept solver's slopes against those of 400 arcs, and those of few arcs, which must fail.
TEST(Derivatives, OfACircleOutOfItsPlane) {
  scene::Stiffness strip = slender(60, 0.17);
  strip.bending_Nmm2[0] = 0.22;
  const double L = 1.6;
  const Scene scene = uniform_rod(L, strip, {Moment{L, Frame::follower, {0, 0, -0.67}}});
  fam::Options options;
  options.tolerance_mm = 1e-6 * L;
  auto made = fam::Solver::make(scene, options);
  auto& solver = std::get<fam::Solver>(made);
  ASSERT_TRUE(solver.solve().converged());
  SolvedRod fine(scene, 400), coarse(scene, static_cast<int>(solver.s_mm().size()) - 1);
  const Eigen::Matrix<double, 6, 6> expected = fine.response().compliance(L, What::pose);
  EXPECT_LE(mismatch(solver.compliance(L), expected), 1e-5);
  EXPECT_GE(mismatch(coarse.response().compliance(L, What::pose), expected), 1e-2) << "the twin, arcs of the circle";
}

// A fixed wrench at the tip arrives at the clamp whole: its force, and its moment there with that of the tip's way
// under the force that it had. Limit: round-off of the carried wrench.
TEST(Derivatives, BalanceTheLoads) {
  const Vector3d force_N(-0.05, 0.2, 0.1);
  SolvedRod rod(uniform_rod(100, soft(), {Force{100, Frame::fixed, force_N}}), 40);
  const Eigen::Matrix<double, 6, 6> base = rod.response().compliance(0, What::wrench);
  const Eigen::Matrix<double, 6, 6> tip = rod.response().compliance(rod.length_mm(), What::pose);
  const auto cross = [](const Vector3d& a) {
    return (Matrix3d() << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0).finished();
  };
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Identity();
  expected.bottomLeftCorner<3, 3>() = cross(rod.section(rod.length_mm()).pose.position_B_mm);
  expected.bottomRows<3>() -= cross(force_N) * tip.topRows<3>();
  EXPECT_LE((base - expected).topRows<3>().cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((base - expected).bottomRows<3>().cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
  EXPECT_LE(rod.response().compliance(0, What::pose).cwiseAbs().maxCoeff(), 1e-12 * tip.cwiseAbs().maxCoeff());
}

// Loads with an energy: the compliance is its second derivative's inverse. Limit: the 1e-8.
TEST(Derivatives, ComplianceIsSymmetricWhereTheLoadsHaveAnEnergy) {
  Scene scene = uniform_rod(100, soft(),
                            {Force{100, Frame::fixed, {-0.05, 0.2, 0.1}, {2, -3}}, Gravity{{0, 0, -9.81}},
                             DistributedForce{0, 60, Frame::fixed, {0, 1e-3, 1e-3}}, Tendon{{0, 2}, 3, 100}});
  const auto asymmetry = [](const Scene& of) {
    SolvedRod rod(of, 100);
    const Eigen::Matrix<double, 6, 6> C = rod.response().compliance(rod.length_mm(), What::pose);
    return (C - C.transpose()).cwiseAbs().maxCoeff() / C.cwiseAbs().maxCoeff();
  };
  EXPECT_LE(asymmetry(scene), 1e-8);
  scene.loads.push_back(Force{100, Frame::follower, {0, 0.1, 0}});
  EXPECT_GE(asymmetry(scene), 1e-4) << "the twin: a follower force has no energy";
}

// A cantilever's small tip deflections: F L^3/(3 EI), F L^2/(2 EI), and P a^2 (3L - a)/(6 EI) by its place a.
TEST(Derivatives, AreTheBeamTheorysAtRest) {
  const double L = 50, EI = 300, GJ = 200, a = 20, P = 1e-9;
  SolvedRod rod(uniform_rod(L, slender(EI, GJ), {Force{a, Frame::fixed, {0, P, 0}}}), 4);
  const Eigen::Matrix<double, 6, 6> C = rod.response().compliance(L, What::pose);
  EXPECT_NEAR(C(1, 1), L * L * L / (3 * EI), 1e-9);
  EXPECT_NEAR(C(5, 1), L * L / (2 * EI), 1e-9);
  EXPECT_NEAR(C(3, 3), L / GJ, 1e-12);
  EXPECT_NEAR(rod.response().by_load(0, L, What::pose)(1, 1), a * a * (3 * L - a) / (6 * EI), 1e-9);
  EXPECT_NEAR(rod.response().by_place(0, L, What::pose)(1, 0) / P, (6 * a * L - 3 * a * a) / (6 * EI), 1e-8);
}

// At the tip a load can only move towards the clamp: one-sided differences of the exact derivative a (2L - a)/(2EI) ...
TEST(Derivatives, ByThePlaceOfATipLoad) {
  const double L = 50, EI = 300, P = 1e-9;
  SolvedRod rod(uniform_rod(L, slender(EI, 200), {Force{L, Frame::fixed, {0, P, 0}}}), 4);
  EXPECT_NEAR(rod.response().by_place(0, L, What::pose)(1, 0) / P, L * L / (2 * EI), 1e-8);
  EXPECT_NEAR(rod.response().by_place(0, L, What::pose)(5, 0) / P, L / EI, 1e-9);
}

// Against the exact reference: differences of its solutions.
double exact_mismatch(const Scene& scene, int arcs) {
  SolvedRod rod(scene, arcs);
  if (!rod.converged()) return HUGE_VAL;
  double largest = 0;
  const double L = rod.length_mm();
  for (const fam::Parameter& parameter : parameters_of(scene)) {
    const double step = step_of(scene, parameter);
    const auto central = [&](double h) -> Vector6 {
      const auto tip = [&](double change) {
        return exact_reference::solve(changed(scene, parameter, change),
                                      {.model = model_of(scene), .tolerance = 1e-12});
      };
      const auto more = tip(h), less = tip(-h);
      Vector6 result;
      result << more.tip().position_B_mm - less.tip().position_B_mm,
          fam::rotation_vector(Matrix3d(more.tip().rotation_BS * less.tip().rotation_BS.transpose()));
      return result / (2 * h);
    };
    const Vector6 expected = (4 * central(step / 2) - central(step)) / 3;
    const Vector6 found = derivative(rod.response(), parameter, L, What::pose);
    largest = std::max(largest, mismatch(found * step, expected * step, 1e-3 * L, 1e-3));
  }
  return largest;
}
TEST(Derivatives, MatchTheExactReference) {
  EXPECT_LE(exact_mismatch(with_tendons(everything(soft(), 1), 2), 120), 1e-6);
}

TEST(Derivatives, AreNotANumberWhereThereIsNothing) {
  SolvedRod rod(everything(soft(), 1), 20);
  fam::Response& response = rod.response();
  EXPECT_TRUE(response.by_load(99, 50, What::pose).array().isNaN().all());
  EXPECT_TRUE(response.by_rest_curvature(2, 50, What::pose).array().isNaN().all());
  EXPECT_TRUE(response.by_stiffness(2, 50, What::strain).array().isNaN().all());
  EXPECT_TRUE(response.by_place(6, 50, What::pose).array().isNaN().all()) << "gravity has no place";
  for (const double s : {-1e-9, 100.001, std::nan("")}) {
    EXPECT_TRUE(response.compliance(s, What::wrench).array().isNaN().all()) << s;
  }
}

}  // namespace
