// The march: check values, orders, invariances, memory.
#include "allocation_counter.h"
#include "support.h"
#include "support_fam.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <numbers>

namespace {

using Eigen::Vector3d;
using fam::Law;
using fam::RodModel;
using scene::Frame;
using support::slender;
using support::uniform_rod;

fam::Options with(Law law, int arcs, RodModel model = RodModel::automatic) {
  fam::Options options;
  options.law = law;
  options.arcs = arcs;
  options.model = model;
  options.estimate_error = false;
  return options;
}

Vector3d tip(const scene::Scene& scene, const fam::Options& options) {
  const scene::Equilibrium result = fam::solve(scene, options);
  EXPECT_TRUE(result.converged()) << result.message;
  return result.converged() ? result.tip().position_B_mm : Vector3d::Constant(NAN);
}

scene::Scene tip_loaded(const scene::Stiffness& stiffness, const Vector3d& force_N, const Vector3d& moment_Nmm,
                        double length_mm = 40) {
  return uniform_rod(
      length_mm, stiffness,
      {scene::Force{length_mm, Frame::follower, force_N}, scene::Moment{length_mm, Frame::follower, moment_Nmm}});
}

// A prototype's rod and its tip to 12 decimals; the exact reference finds the same
// (ExactReference.SpatialFollowerLoad).
const Vector3d check_tip_mm(39.801266166031, 3.068161908374, 0.175073477554);
scene::Scene check_rod(double stiffness_factor = 1) {
  return tip_loaded(slender(stiffness_factor * 1500, stiffness_factor * 1000), {-0.5, 0.8, 0.6}, {10, 20, -15});
}

TEST(March, CheckValue) {
  const double limit_mm = 1e-8;  // measured 1.2e-9
  EXPECT_LT((tip(check_rod(), with(Law::fourth_order, 128)) - check_tip_mm).norm(), limit_mm);
  EXPECT_GT((tip(check_rod(1.05), with(Law::fourth_order, 128)) - check_tip_mm).norm(), limit_mm);
  EXPECT_GT((tip(check_rod(), with(Law::fourth_order, 50)) - check_tip_mm).norm(), limit_mm);
}

// Errors that an independent prototype of the same laws measured, to the digits it printed.
TEST(March, ErrorsOfThePrototype) {
  const auto error = [](Law law, int arcs) { return (tip(check_rod(), with(law, arcs)) - check_tip_mm).norm(); };
  EXPECT_NEAR(error(Law::midpoint, 1), 3.7, 0.05);
  EXPECT_NEAR(error(Law::midpoint, 12), 2.8e-2, 0.05e-2);
  EXPECT_NEAR(error(Law::fourth_order, 1), 0.35, 0.005);
  EXPECT_NEAR(error(Law::fourth_order, 12), 1.6e-5, 0.05e-5);
  EXPECT_NEAR(error(Law::fourth_order, 128), 1.2e-9, 0.05e-9);

  const Vector3d p4_tip_mm(15.93118975, 28.31369838, 0);
  const auto planar = [&](int arcs) {
    return (tip(support::study1_scene("P4", "follower"), with(Law::published, arcs)) - p4_tip_mm).norm();
  };
  EXPECT_NEAR(planar(4), 0.1415, 0.0002);
  EXPECT_NEAR(planar(12), 0.01579, 0.00002);
  EXPECT_NEAR(planar(50), 9.05e-4, 0.01e-4);
  EXPECT_NEAR(planar(500), 9.03e-6, 0.02e-6);
}

// With shear and stretch, and without, by an independent collocation. It was made with E = 11.789 MPa, EI = 749.98 N
// mm^2, which moves the tip by 5e-4 mm, hence the limit; GatesOfStudy1 is the sharp test of the same rod (P2).
TEST(March, ShearAndStretch) {
  const double limit_mm = 1e-3;
  scene::Stiffness thick = slender(750, 500);
  thick.axial_N = 333.4;
  thick.shear_N = Eigen::Vector2d::Constant(0.9 * 333.4 / 3);
  const scene::Scene scene = tip_loaded(thick, {0, 1, 0}, {0, 0, 0});
  const Vector3d sheared_mm(29.3134, 24.2739, 0), unsheared_mm(29.5996, 24.0091, 0);
  EXPECT_LT((tip(scene, with(Law::fourth_order, 64)) - sheared_mm).norm(), limit_mm);
  EXPECT_LT((tip(scene, with(Law::fourth_order, 64, RodModel::kirchhoff)) - unsheared_mm).norm(), limit_mm);
  EXPECT_GT((tip(support::stiffer(scene), with(Law::fourth_order, 64)) - sheared_mm).norm(), limit_mm);
}

// The table of gates, tests/data/study1_gates.csv, whose head says what its columns are.
TEST(March, GatesOfStudy1) {
  for (const support::Row& row : support::read_csv("study1_gates.csv")) {
    SCOPED_TRACE(row.at("case") + " " + row.at("law") + " " + row.at("arcs") + " " + row.at("model"));
    const RodModel model = row.at("model") == "reissner" ? RodModel::reissner : RodModel::kirchhoff;
    const fam::Options options = with(*fam::law_named(row.at("law")), std::stoi(row.at("arcs")), model);
    const Vector3d exact_mm = support::study1_tip_mm(row.at("case"), "follower", row.at("model"));
    const scene::Scene scene = support::study1_scene(row.at("case"), "follower");
    const double measured_mm = support::number(row, "measured_mm"), limit_mm = support::number(row, "limit_mm");
    EXPECT_LE(limit_mm, std::max(2 * measured_mm, 2e-8));
    EXPECT_LE((tip(scene, options) - exact_mm).norm(), limit_mm);
    const double twin_mm = (tip(support::stiffer(scene), options) - exact_mm).norm();
    EXPECT_TRUE(twin_mm > limit_mm || twin_mm < 0.95 * measured_mm) << twin_mm;
  }
}

double observed_order(const scene::Scene& scene, const Vector3d& exact_mm, fam::Options options) {
  const double coarse = (tip(scene, options) - exact_mm).norm();
  options.arcs *= 2;
  return std::log2(coarse / (tip(scene, options) - exact_mm).norm());
}

TEST(March, ObservedOrders) {
  const scene::Scene planar = support::study1_scene("P4", "follower");
  const scene::Scene spatial = support::study1_scene("S6", "follower");
  const Vector3d planar_tip = support::study1_tip_mm("P4", "follower", "kirchhoff");
  const Vector3d spatial_tip = support::study1_tip_mm("S6", "follower", "kirchhoff");
  constexpr auto kirchhoff = RodModel::kirchhoff;
  EXPECT_NEAR(observed_order(planar, planar_tip, with(Law::published, 100, kirchhoff)), 2, 0.05);
  EXPECT_NEAR(observed_order(spatial, spatial_tip, with(Law::published, 400, kirchhoff)), 1, 0.05);
  EXPECT_NEAR(observed_order(planar, planar_tip, with(Law::midpoint, 100, kirchhoff)), 2, 0.05);
  EXPECT_NEAR(observed_order(spatial, spatial_tip, with(Law::midpoint, 100, kirchhoff)), 2, 0.05);
  EXPECT_GT(observed_order(planar, planar_tip, with(Law::sixth_order, 10, kirchhoff)), 5.8);  // leading term small here
  EXPECT_NEAR(observed_order(spatial, spatial_tip, with(Law::sixth_order, 10, kirchhoff)), 6, 0.3);
  EXPECT_NEAR(observed_order(planar, planar_tip, with(Law::fourth_order, 40, kirchhoff)), 4, 0.1);
  EXPECT_NEAR(observed_order(spatial, spatial_tip, with(Law::fourth_order, 40, kirchhoff)), 4, 0.1);
  const Vector3d sheared_tip = support::study1_tip_mm("S6", "follower", "reissner");
  EXPECT_NEAR(observed_order(spatial, sheared_tip, with(Law::fourth_order, 40, RodModel::reissner)), 4, 0.1);
}

// Published law on the planar cases: below 1e-8 L at N = 5000, no rise on the way.
TEST(March, PublishedLawFallsToTheEnd) {
  for (const std::string name : {"P1", "P2", "P4", "P5", "P6", "P7", "P8"}) {
    const scene::Scene scene = support::study1_scene(name, "follower");
    const Vector3d exact_mm = support::study1_tip_mm(name, "follower", "kirchhoff");
    double last = 1e9;
    for (const int arcs : {2, 4, 12, 50, 200, 500, 1000, 2000, 5000}) {
      const double error = (tip(scene, with(Law::published, arcs)) - exact_mm).norm();
      EXPECT_LT(error, last) << name << " " << arcs;
      last = error;
    }
    EXPECT_LT(last, 1e-8 * 40) << name;
  }
}

// A pure moment is a circle: two turns with one arc of any law, closed to round-off; at a million arcs still 1e-10 L.
TEST(March, RollUp) {
  const double two_turns = 4 * std::numbers::pi * 750 / 40;
  const scene::Scene scene = tip_loaded(slender(750, 500), {0, 0, 0}, {0, 0, two_turns});
  for (const Law law : fam::all_laws()) {
    EXPECT_LT(tip(scene, with(law, 1)).norm(), 1e-13);
    EXPECT_LT(tip(scene, with(law, 1000)).norm(), 1e-11);
  }
  EXPECT_LT(tip(scene, with(Law::fourth_order, 1'000'000)).norm(), 40e-10);
  const scene::Equilibrium result = fam::solve(scene);
  EXPECT_NEAR(result.tip_angle_rad, 4 * std::numbers::pi, 1e-12);
  EXPECT_EQ(std::get<int>(result.model[1].second), 1);
}

// Base wrench from global equilibrium: n(0) = R F, m(0) = R M + p x n, with the tip's pose.
TEST(March, BaseWrenchBalancesTheLoads) {
  for (const Law law : fam::all_laws()) {
    const scene::Equilibrium result = fam::solve(check_rod(), with(law, 12));
    const Vector3d force = result.tip().rotation_BS * Vector3d(-0.5, 0.8, 0.6);
    const Vector3d moment = result.tip().rotation_BS * Vector3d(10, 20, -15) + result.tip().position_B_mm.cross(force);
    EXPECT_LT((result.base().force_B_N - force).norm(), 1e-14);
    EXPECT_LT((result.base().moment_B_Nmm - moment).norm(), 1e-12);
  }
}

// Turned about the rod's axis, mirrored and scaled scenes give turned, mirrored and scaled answers.
TEST(March, Invariances) {
  const Vector3d F(-0.5, 0.8, 0.6), M(10, 20, -15);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d::UnitX()).toRotationMatrix();
  for (const Law law : fam::all_laws()) {
    const fam::Options options = with(law, 7);
    const Vector3d straight = tip(check_rod(), options);
    EXPECT_LT((tip(tip_loaded(slender(1500, 1000), turn * F, turn * M), options) - turn * straight).norm(), 1e-13);
    // Mirrored in the x-y plane: z of a vector and x, y of an axial vector change sign.
    const Vector3d mirrored = tip(tip_loaded(slender(1500, 1000), {F[0], F[1], -F[2]}, {-M[0], -M[1], M[2]}), options);
    EXPECT_LT((mirrored - Vector3d(straight[0], straight[1], -straight[2])).norm(), 1e-13);
    // Lengths times 1000, forces the same: stiffness times 1e6, moments times 1000.
    const Vector3d large = tip(tip_loaded(slender(1500e6, 1000e6), F, 1000 * M, 40'000), options);
    EXPECT_LT((large / 1000 - straight).norm(), 1e-12);
    // The mirror's twin: without the signs of the axial vector it must not agree.
    EXPECT_GT((tip(tip_loaded(slender(1500, 1000), {F[0], F[1], -F[2]}, M), options) - mirrored).norm(), 1e-3);
  }
}

// A tendon at the offset r bends to the constant curvature T r / EI: a circle, for every law.
TEST(March, TendonClosedForm) {
  const double curvature = 3.0 * 1.5 / 750;  // tension 3 N at y = 1.5 mm
  const Vector3d circle(std::sin(40 * curvature) / curvature, (1 - std::cos(40 * curvature)) / curvature, 0);
  for (const Law law : fam::all_laws()) {
    const scene::Scene scene = uniform_rod(40, slender(750, 500), {scene::Tendon{{1.5, 0}, 3, 40}});
    EXPECT_LT((tip(scene, with(law, 5)) - circle).norm(), 1e-13);
    const scene::Equilibrium result = fam::solve(scene, with(law, 5));
    EXPECT_LT((result.base().force_B_N - Vector3d(-3, 0, 0)).norm(), 1e-15);
    EXPECT_LT((result.base().moment_B_Nmm - Vector3d(0, 0, 4.5)).norm(), 1e-15);
    EXPECT_GT((tip(support::stiffer(scene), with(law, 5)) - circle).norm(), 1e-2);
  }
}

TEST(March, RestCurvatureIsTheUnloadedShape) {
  scene::Scene scene = uniform_rod(40, slender(750, 500), {});
  scene.sections[0].rest_curvature_per_mm = {0, 0, 0.02};
  for (const Law law : fam::all_laws()) {
    EXPECT_LT((tip(scene, with(law, 3)) - Vector3d(50 * std::sin(0.8), 50 * (1 - std::cos(0.8)), 0)).norm(), 1e-13);
  }
}

// Two sections, rest curvature, loads at the tip and at 25 mm. Tip by scipy's DOP853 marching the Cosserat equations
// at rtol 1e-12, independent of this project (tests/data/march_tips.csv).
TEST(March, SectionsAndLoadsAlongTheRod) {
  const support::Row row = support::read_csv("march_tips.csv").at(0);
  scene::Scene scene = uniform_rod(25, slender(900, 700), {});
  scene.sections.push_back(scene.sections[0]);
  scene.sections[1].length_mm = 15;
  scene::Stiffness tube = slender(400, 300);
  tube.bending_Nmm2 = {400, 500};
  tube.axial_N = 300;
  tube.shear_N = Eigen::Vector2d(90, 80);
  scene.sections[1].cross_section = tube;
  scene.sections[1].rest_curvature_per_mm = {0.005, -0.01, 0.02};
  scene.loads = {scene::Force{40, Frame::follower, {0.3, 0.5, -0.4}}, scene::Moment{40, Frame::follower, {5, 0, 8}},
                 scene::Force{20, Frame::follower, {0, -0.6, 0.9}}, scene::Moment{25, Frame::follower, {0, -6, 4}}};
  const double limit_mm = 1e-9;
  EXPECT_LT((tip(scene, with(Law::fourth_order, 800)) - support::position_mm(row)).norm(), limit_mm);
  EXPECT_GT((tip(support::stiffer(scene), with(Law::fourth_order, 800)) - support::position_mm(row)).norm(), limit_mm);
  EXPECT_LT((tip(scene, with(Law::midpoint, 800)) - support::position_mm(row)).norm(), 1e-4);
}

TEST(March, SolvesWithoutAllocating) {
  for (const Law law : fam::all_laws()) {
    for (const RodModel model : {RodModel::kirchhoff, RodModel::reissner}) {
      if (law == Law::published && model == RodModel::reissner) continue;
      fam::Solver solver = support::kept(support::study1_scene("S4", "follower"), with(law, 500, model));
      const std::size_t before = allocation_count();
      EXPECT_TRUE(solver.solve().converged());
      EXPECT_EQ(allocation_count(), before) << fam::name(law);
    }
  }
  // The twin: making does allocate, so the counter counts.
  const std::size_t before = allocation_count();
  support::kept(check_rod(), with(Law::midpoint, 500));
  EXPECT_GT(allocation_count(), before);
}

// The estimate brackets the true error where the arcs resolve the rod.
TEST(Solve, ErrorEstimate) {
  for (const std::string& name : support::study1_cases()) {
    for (const Law law : fam::all_laws()) {
      fam::Options options = with(law, 24, RodModel::kirchhoff);
      options.estimate_error = true;
      const scene::Equilibrium result = fam::solve(support::study1_scene(name, "follower"), options);
      const double error_mm =
          (result.tip().position_B_mm - support::study1_tip_mm(name, "follower", "kirchhoff")).norm();
      EXPECT_LT(error_mm, 1.3 * result.error_estimate_mm + 1e-11) << name << fam::name(law);
      EXPECT_GT(error_mm, 0.05 * result.error_estimate_mm - 1e-11) << name << fam::name(law);
    }
  }
}

TEST(Solve, ToleranceIsKeptByFewArcs) {
  for (const std::string& name : support::study1_cases()) {
    for (const double tolerance_mm : {1.0, 1e-2, 1e-4, 1e-6, 1e-8}) {
      fam::Options options;
      options.tolerance_mm = tolerance_mm;
      const scene::Equilibrium result = fam::solve(support::study1_scene(name, "follower"), options);
      ASSERT_TRUE(result.converged()) << result.message;
      EXPECT_LE(result.error_estimate_mm, tolerance_mm);
      EXPECT_LT((result.tip().position_B_mm - support::study1_tip_mm(name, "follower", "reissner")).norm(),
                tolerance_mm)
          << name;
    }
  }
}

TEST(Solve, DropsShearOnlyWhereItCannotMatter) {
  const auto shear = [](double tolerance_mm) {
    fam::Options options;
    options.tolerance_mm = tolerance_mm;
    const auto result = fam::solve(support::study1_scene("P1", "follower"), options);
    for (const auto& [key, value] : result.model) {
      if (key == "shear") return std::get<bool>(value);
    }
    return false;
  };
  EXPECT_TRUE(shear(0.1));
  EXPECT_FALSE(shear(20));
}

struct Unsupported {
  scene::Load load;
  const char* what;
};

TEST(Solve, PublishedLawNamesTheLoadItCannotSolve) {
  scene::Stiffness heavy = slender(750, 500);
  heavy.mass_per_length_kg_per_m = 0.1;
  const std::vector<Unsupported> cases = {
      {scene::Force{40, Frame::fixed, {0, 1, 0}}, "a force in a fixed frame"},
      {scene::Moment{40, Frame::fixed, {0, 1, 0}}, "a moment in a fixed frame"},
      {scene::DistributedForce{0, 40, Frame::follower, {0, 1, 0}}, "a distributed force"},
      {scene::Gravity{{0, 0, -9.81}}, "gravity"}};
  for (const Unsupported& c : cases) {
    const scene::Scene scene = uniform_rod(40, heavy, {scene::Tendon{{1, 0}, 1, 40}, c.load});
    const scene::Equilibrium result = fam::solve(scene, with(Law::published, 12));
    EXPECT_EQ(result.status, scene::Status::unsupported);
    EXPECT_EQ(result.message, std::string("loads[1]: the published law cannot solve ") + c.what);
    EXPECT_TRUE(result.stations.empty());
  }
}

TEST(Solve, PublishedLawNamesItsLimits) {
  scene::Stiffness flat = slender(750, 500);
  flat.bending_Nmm2[1] = 100;
  const scene::Equilibrium ribbon = fam::solve(tip_loaded(flat, {0, 1, 0}, {0, 0, 0}), with(Law::published, 12));
  EXPECT_EQ(ribbon.status, scene::Status::unsupported);
  const scene::Equilibrium sheared =
      fam::solve(support::study1_scene("P1", "follower"), with(Law::published, 12, RodModel::reissner));
  EXPECT_EQ(sheared.status, scene::Status::unsupported);
}

// First order in space: errors are told from runs with four times the arcs, and are numbers where no arcs suffice.
TEST(Solve, PublishedLawIsEstimated) {
  const scene::Scene scene = support::study1_scene("S4", "follower");
  const Vector3d exact_mm = support::study1_tip_mm("S4", "follower", "kirchhoff");
  for (const double tolerance_mm : {1.0, 0.1, 0.01}) {
    const scene::Equilibrium result = fam::solve(scene, {.law = Law::published, .tolerance_mm = tolerance_mm});
    ASSERT_TRUE(result.converged());
    const double error_mm = (result.tip().position_B_mm - exact_mm).norm();
    EXPECT_LE(error_mm, tolerance_mm);
    EXPECT_LE(error_mm, 1.1 * result.error_estimate_mm);  // measured 0.89 to 0.96 of it
    EXPECT_GE(error_mm, 0.5 * result.error_estimate_mm);
  }
  const scene::Equilibrium none = fam::solve(scene, {.law = Law::published, .tolerance_mm = 1e-9});
  EXPECT_EQ(none.status, scene::Status::tolerance_not_met);
  EXPECT_EQ(none.message.find("inf"), std::string::npos) << none.message;
}

TEST(Solve, OverflowIsAStatus) {
  const scene::Equilibrium result =
      fam::solve(tip_loaded(slender(1e-300, 1e-300), {1e300, 1e300, 0}, {0, 0, 1e300}), with(Law::midpoint, 10));
  EXPECT_EQ(result.status, scene::Status::not_finite);
  EXPECT_TRUE(result.stations.empty());
}

}  // namespace
