// The finite element beam against closed forms, published benchmarks and independent solutions.
#include "fem_benchmark.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace {

using Eigen::Vector3d;
using fem_benchmark::bare;
using fem_benchmark::solved;
using fem_reference::Options;
using fem_reference::RodModel;
using scene::Frame;

constexpr double pi = std::numbers::pi;

// Limits are at most twice what is measured, which stands beside them; each has a twin of 5 % more stiffness that must
// miss it. Where nothing but Newton's tolerance and round-off is left of the error:
constexpr double round_off_mm = 1e-11;  // measured 1e-13 at most

using support::number;
using support::read_csv;
using support::uniform_rod;

scene::Stiffness stiffness(double torsion_Nmm2, double bending_Nmm2) {
  scene::Stiffness result;
  result.torsion_Nmm2 = torsion_Nmm2;
  result.bending_Nmm2.setConstant(bending_Nmm2);
  return result;
}

scene::Stiffness stiffness(double torsion_Nmm2, double bending_Nmm2, double axial_N, double shear_N) {
  scene::Stiffness result = stiffness(torsion_Nmm2, bending_Nmm2);
  result.axial_N = axial_N;
  result.shear_N = Eigen::Vector2d::Constant(shear_N);
  return result;
}

Vector3d tip_mm(const scene::Scene& scene, const Options& options) {
  return solved(scene, options).tip().position_B_mm;
}

int fact(const scene::Equilibrium& found, const std::string& name) {
  for (const scene::Fact& f : found.model) {
    if (f.first == name) return std::get<int>(f.second);
  }
  return -1;
}

// Tip force on a straight cantilever of length 1 and EI = 1 (consistent units).
scene::Scene cantilever(Frame frame, double force_N, double bending_Nmm2 = 1) {
  return uniform_rod(1, stiffness(1, bending_Nmm2), {scene::Force{1, frame, Vector3d(0, force_N, 0)}});
}

// --- closed forms ---------------------------------------------------------------------------------------------------

TEST(FemBeam, RollUpByAnEndMoment) {
  const double L = 40, EI = 750;
  const auto roll = [&](int turns, const scene::Stiffness& k, const Options& options) {
    return solved(uniform_rod(L, k, {scene::Moment{L, Frame::follower, {0, 0, turns * 2 * pi * EI / L}}}), options);
  };
  for (const scene::Stiffness& k : {stiffness(500, EI), stiffness(500, EI, 333, 99)}) {
    const scene::Equilibrium one = roll(1, k, bare(50));
    EXPECT_LT(one.tip().position_B_mm.norm(), 1e-5);  // measured 5.2e-6
    EXPECT_NEAR(one.tip_angle_rad, 2 * pi, 1.6e-6);   // 8.2e-7
    EXPECT_LT((one.base().moment_B_Nmm - Vector3d(0, 0, 2 * pi * EI / L)).norm(), round_off_mm * EI / L);
    const scene::Equilibrium two = roll(2, k, bare(50));
    EXPECT_LT(two.tip().position_B_mm.norm(), 1.6e-4);  // 8.3e-5
    EXPECT_NEAR(two.tip_angle_rad, 4 * pi, 5e-5);       // 2.6e-5
    const scene::Equilibrium finer = roll(2, k, bare(100));
    EXPECT_LT(finer.tip().position_B_mm.norm(), 1e-5);  // 5.2e-6
    EXPECT_NEAR(finer.tip_angle_rad, 4 * pi, 3.2e-6);   // 1.6e-6
  }
  const scene::Equilibrium twin = roll(1, stiffness(500, 1.05 * EI), bare());
  EXPECT_GT(twin.tip().position_B_mm.norm(), 1e-2 * L);
  EXPECT_GT(2 * pi - twin.tip_angle_rad, 0.2);
}

TEST(FemBeam, TwistByAnEndMoment) {
  // Torsion alone: the rod stays straight and turns by M L / GJ, here through more than one turn, of which a rotation
  // outside a plane shows the rest.
  const auto twisted = [](double torsion_Nmm2) {
    return solved(uniform_rod(40, stiffness(torsion_Nmm2, 750), {scene::Moment{40, Frame::follower, {100, 0, 0}}}));
  };
  const scene::Equilibrium found = twisted(500);
  EXPECT_LT((found.tip().position_B_mm - Vector3d(40, 0, 0)).norm(), round_off_mm);
  EXPECT_NEAR(found.tip_angle_rad, 8 - 2 * pi, 5.5e-6);  // measured 2.7e-6
  EXPECT_GT(std::abs(twisted(525).tip_angle_rad - (8 - 2 * pi)), 0.1);
}

TEST(FemBeam, StretchAndShearOfAShortRod) {
  // A follower force along the rod stretches it by F / EA.
  const scene::Equilibrium found =
      solved(uniform_rod(40, stiffness(500, 750, 333, 99), {scene::Force{40, Frame::follower, {30, 0, 0}}}), bare());
  EXPECT_NEAR(found.tip().position_B_mm.x(), 40 * (1 + 30 / 333.0), round_off_mm);
}

// --- published benchmarks and computed tables
// -------------------------------------------------------------------------

TEST(FemBeam, ElasticaUnderAFixedTipForce) {
  Options options = bare();
  options.model = RodModel::kirchhoff;
  for (const auto& row : read_csv("01_cantilever_dead_tip_load_elliptic.csv")) {
    const double alpha = number(row, "alpha");
    const Vector3d exact(1 - number(row, "u_over_L"), number(row, "w_over_L"), 0);
    const scene::Equilibrium found = solved(cantilever(Frame::fixed, alpha), options);
    EXPECT_LT((found.tip().position_B_mm - exact).norm(), 3.8e-6) << alpha;       // measured 1.9e-6 of L
    EXPECT_NEAR(found.tip_angle_rad, number(row, "theta_rad"), 4.4e-8) << alpha;  // 2.2e-8
    if (alpha < 1 || alpha > 10) continue;
    EXPECT_GT((tip_mm(cantilever(Frame::fixed, alpha, 1.05), options) - exact).norm(), 1e-3) << alpha;
  }
}

TEST(FemBeam, ElasticaUnderAFollowerTipForce) {
  Options options = bare();
  options.model = RodModel::kirchhoff;
  const auto rows = read_csv("05_follower_tip_force_reference.csv");
  for (std::size_t i = 0; i < rows.size(); i += 10) {
    const double beta = number(rows[i], "beta");
    const Vector3d exact(number(rows[i], "x_over_L"), number(rows[i], "y_over_L"), 0);
    const scene::Equilibrium found = solved(cantilever(Frame::follower, beta), options);
    EXPECT_LT((found.tip().position_B_mm - exact).norm(), 7.5e-6) << beta;           // measured 3.8e-6 of L
    EXPECT_NEAR(found.tip_angle_rad, number(rows[i], "theta_rad"), 1.5e-5) << beta;  // 7.7e-6
    if (beta < 1) continue;
    EXPECT_GT((tip_mm(cantilever(Frame::follower, beta, 1.05), options) - exact).norm(), 1e-3) << beta;
  }
}

TEST(FemBeam, HeavyElastica) {
  Options options = bare();
  options.model = RodModel::kirchhoff;
  for (const auto& row : read_csv("08_heavy_elastica_reference.csv")) {
    const double g = number(row, "g");
    const scene::Scene scene =
        uniform_rod(1, stiffness(1, 1), {scene::DistributedForce{0, 1, Frame::fixed, {0, g, 0}}});
    const Vector3d exact(number(row, "x_over_L"), number(row, "y_over_L"), 0);
    // At g = 1000 the rod turns within a boundary layer at the clamp, L / 10 long.
    EXPECT_LT((tip_mm(scene, options) - exact).norm(), 1e-4) << g;  // measured 5.3e-5 of L
    if (g >= 1 && g <= 100) {  // beyond, the tip hangs straight down whatever the stiffness
      EXPECT_GT((tip_mm(support::stiffer(scene), options) - exact).norm(), 1e-4) << g;
    }
  }
}

scene::Scene bend_45_degrees(double force_N, double stiffer = 1) {
  const double R = 100, L = R * pi / 4, E = stiffer * 1e7, G = stiffer * 5e6;
  scene::Scene scene = uniform_rod(L, stiffness(G / 6, E / 12, E, G), {scene::Force{L, Frame::fixed, {0, 0, force_N}}});
  scene.sections[0].rest_curvature_per_mm = {0, 0, 1 / R};
  return scene;
}

TEST(FemBeam, Bend45Degrees) {
  int compared = 0;
  for (const auto& row : read_csv("03_bend45_dead_reference.csv")) {
    if (row.at("model") != "SR" || row.at("GJ_choice") != "polar") continue;
    const double force_N = number(row, "F");
    const Vector3d exact(number(row, "x"), number(row, "y"), number(row, "z"));
    // Measured 2.2e-7.
    EXPECT_LT((tip_mm(bend_45_degrees(force_N), bare()) - exact).norm(), 4.3e-7 * exact.norm()) << force_N;
    EXPECT_GT((tip_mm(bend_45_degrees(force_N, 1.05), bare()) - exact).norm(), 1e-3 * exact.norm());
    ++compared;
  }
  EXPECT_EQ(compared, 4);  // 300, 450, 600, 3000
}

TEST(FemBeam, HelixOfTenTurns) {
  const scene::Scene scene =
      uniform_rod(10, stiffness(100, 100, 1e4, 1e4),
                  {scene::Force{10, Frame::fixed, {0, 0, 50}}, scene::Moment{10, Frame::fixed, {0, 0, 200 * pi}}});
  const Vector3d exact = Vector3d(10, 0, 0) + Vector3d(-9.9951967503, 0.0000724968, -0.0764417417);
  EXPECT_LT((tip_mm(scene, bare(100, 3)) - exact).norm(), 1.5e-6);  // measured 7.7e-7
  EXPECT_GT((tip_mm(support::stiffer(scene), bare(100, 3)) - exact).norm(), 1e-4 * 10);
}

TEST(FemBeam, ThickCantileverWithShear) {
  // Nachbagauer 2011: L = 2 m, 0.1 m x 0.5 m, E = 2.07e11 Pa, nu = 0.3, k = 10 (1 + nu) / (12 + 11 nu), F = 6.25e7 N.
  const double E = 2.07e11, b = 0.1, h = 0.5, nu = 0.3, k = 10 * (1 + nu) / (12 + 11 * nu), EA = E * b * h;
  const scene::Scene scene = uniform_rod(2, stiffness(1e9, E * b * h * h * h / 12, EA, k * EA / (2 * (1 + nu))),
                                         {scene::Force{2, Frame::fixed, {0, 6.25e7, 0}}});
  const Vector3d exact(2 - 0.150971144239, 0.710568597854, 0);
  EXPECT_LT((tip_mm(scene, bare()) - exact).norm(), 4.2e-9);  // measured 2.1e-9
  EXPECT_GT((tip_mm(support::stiffer(scene), bare()) - exact).norm(), 1e-6 * 2);
}

TEST(FemBeam, LargeFixedForceStaysOnTheStableBranch) {
  // By collocation with continuation, independent of this project; other equilibria exist.
  const auto tip = [](double factor, double stiffness_factor) {
    const Vector3d force_N = factor * Vector3d(-0.3, 0.8, 0.6);
    const scene::Scene scene = uniform_rod(40, stiffness(1000, 1500), {scene::Force{40, Frame::fixed, force_N}});
    return tip_mm(support::stiffer(scene, stiffness_factor), bare(200));
  };
  const Vector3d exact_111(-4.7903, 29.7072, 22.2804), exact_1112(-9.37405, 30.35216, 22.76412);
  EXPECT_LT((tip(100, 1) - exact_111).norm(), 6e-5);  // measured 3.1e-5: the reference's last digit
  EXPECT_GT((tip(100, 1.05) - exact_111).norm(), 2e-4);
  EXPECT_LT((tip(1000, 1) - exact_1112).norm(), 4e-5);  // measured 2.0e-5
  EXPECT_GT((tip(1000, 1.05) - exact_1112).norm(), 1e-4);
}

// --- loads along a rod of two sections ------------------------------------------------------------------------------

// References: scipy DOP853 shooting at rtol 1e-12, Newton on the clamp's rotation to 1e-11; independent of this
// project.
scene::Scene two_sections(std::vector<scene::Load> loads) {
  scene::Stiffness proximal = stiffness(600, 800, 400, 120);
  proximal.bending_Nmm2[1] = 1200;
  (*proximal.shear_N)[1] = 90;
  proximal.mass_per_length_kg_per_m = 0.5;
  scene::Stiffness distal = stiffness(200, 300);
  distal.mass_per_length_kg_per_m = 0.2;
  scene::Scene scene;
  scene.sections = {{25, proximal, Vector3d::Zero()}, {15, distal, Vector3d(0.01, -0.02, 0.03)}};
  scene.loads = std::move(loads);
  return scene;
}

struct Reference {
  Vector3d tip_mm, base_force_N, base_moment_Nmm;
};

// The scene meets the reference; a stiffer rod does not. Measured: 5.0e-9 mm, 2.2e-11 N, 1.3e-9 N mm at most.
void expect_equal(const scene::Scene& scene, const Options& options, const Reference& reference) {
  const double limit_mm = 1e-8;
  const scene::Equilibrium found = solved(scene, options);
  EXPECT_LT((found.tip().position_B_mm - reference.tip_mm).norm(), limit_mm);
  EXPECT_LT((found.base().force_B_N - reference.base_force_N).norm(), 4.4e-11);
  EXPECT_LT((found.base().moment_B_Nmm - reference.base_moment_Nmm).norm(), 2.7e-9);
  const scene::Equilibrium twin = solved(support::stiffer(scene), options);
  EXPECT_GT((twin.tip().position_B_mm - reference.tip_mm).norm(), 1e6 * limit_mm);
  EXPECT_GT((twin.base().moment_B_Nmm - reference.base_moment_Nmm).norm(), 1e-3);
}

std::vector<scene::Load> mixed_loads() {
  return {scene::Force{18, Frame::follower, {0.1, 0.4, -0.3}}, scene::Moment{18, Frame::follower, {4, -6, 5}},
          scene::Force{33, Frame::fixed, {-0.2, 0.3, 0.2}},    scene::Moment{33, Frame::fixed, {-3, 2, 4}},
          scene::Force{40, Frame::fixed, {0.1, -0.1, 0.25}},   scene::Moment{40, Frame::follower, {2, 1, -3}}};
}

TEST(FemBeam, PointLoadsOfBothFramesAlongTheRod) {
  expect_equal(two_sections(mixed_loads()), bare(100),
               {{36.4274839028, 10.5338691458, 9.35959114078},
                {-0.0481644410663, 0.65726998783, 0.230415772287},
                {4.15709689441, -12.1308848276, 21.8124032434}});
  Options kirchhoff = bare(100);
  kirchhoff.model = RodModel::kirchhoff;
  expect_equal(two_sections(mixed_loads()), kirchhoff,
               {{36.450791103, 10.428902732, 9.28582774272},
                {-0.0481995758378, 0.657306230217, 0.230482966808},
                {4.16500530541, -12.1341950913, 21.8188126646}});
}

TEST(FemBeam, FollowerLoadsAlongTheRod) {
  const scene::Scene scene =
      two_sections({scene::Force{18, Frame::follower, {0.1, 0.4, -0.3}}, scene::Moment{18, Frame::follower, {4, -6, 5}},
                    scene::Force{40, Frame::follower, {0.1, -0.1, 0.25}}});
  expect_equal(scene, bare(100),
               {{36.9259265439, 3.52682046876, 11.9076561538},
                {0.109466086265, 0.291038102677, 0.0339940085183},
                {4.68935995015, -11.6732120366, 7.17743654292}});
}

TEST(FemBeam, DistributedForcesAndGravity) {
  const scene::Scene scene = two_sections({scene::DistributedForce{10, 33, Frame::follower, {0.005, 0.02, -0.03}},
                                           scene::DistributedForce{0, 40, Frame::fixed, {-0.004, -0.006, 0.01}},
                                           scene::Gravity{{1, -9.81, 3}}});
  expect_equal(scene, bare(100),
               {{39.2564316638, 4.12063106905, 0.00558903411935},
                {-0.0926941838876, 0.088758645357, -0.236204959229},
                {0.210210133445, 5.88832501453, 3.2869020543}});
}

// --- order, locking, invariance
// ---------------------------------------------------------------------------------------

scene::Scene spatial_load(const scene::Stiffness& k) {
  return uniform_rod(
      40, k, {scene::Force{40, Frame::follower, {-0.5, 0.8, 0.6}}, scene::Moment{40, Frame::follower, {10, 20, -15}}});
}

TEST(FemBeam, TipConvergesWithTwiceTheOrder) {
  const Vector3d exact_mm(39.801266166031, 3.068161908374, 0.175073477554);  // ExactReference.SpatialFollowerLoad
  const scene::Scene scene = spatial_load(stiffness(1000, 1500));
  const int coarse[] = {16, 8, 4};
  for (const int order : {1, 2, 3}) {
    const int n = coarse[order - 1];
    const double first = (tip_mm(scene, bare(n, order)) - exact_mm).norm();
    const double second = (tip_mm(scene, bare(2 * n, order)) - exact_mm).norm();
    EXPECT_NEAR(std::log2(first / second), 2 * order, 0.024) << order;  // measured 0.012
  }
}

TEST(FemBeam, FullIntegrationLocksAndReducedDoesNot) {
  // A thin rod: EI / (kGA L^2) = 1e-6.
  const scene::Scene scene = spatial_load(stiffness(1000, 1500, 3e6, 1e6));
  const Vector3d fine_mm = tip_mm(scene, bare(200, 3));
  const auto error = [&](int order, bool full) {
    Options options = bare(16, order);
    options.full_integration = full;
    return (tip_mm(scene, options) - fine_mm).norm();
  };
  EXPECT_GT(error(1, true), 100 * error(1, false));
  EXPECT_GT(error(2, true), 10 * error(2, false));
}

TEST(FemBeam, FullIntegrationOfARigidSectionIsRefused) {
  Options options = bare();
  options.full_integration = true;
  const scene::Equilibrium found = fem_reference::solve(spatial_load(stiffness(1000, 1500)), options);
  EXPECT_EQ(found.status, scene::Status::unsupported);
  EXPECT_TRUE(found.stations.empty());
}

TEST(FemBeam, ResultDoesNotDependOnTheLoadSteps) {
  for (const scene::Scene& scene :
       {spatial_load(stiffness(1000, 1500, 666, 198)), two_sections(mixed_loads()), bend_45_degrees(600)}) {
    const scene::Equilibrium usual = solved(scene, bare());
    Options many = bare();
    many.initial_load_step = 0.01;
    many.largest_rotation_rad = 0.05;
    const scene::Equilibrium small_steps = solved(scene, many);
    Options few = bare();
    few.initial_load_step = 1;
    few.largest_rotation_rad = 3;
    const scene::Equilibrium large_steps = solved(scene, few);
    EXPECT_GT(fact(small_steps, "load_steps"), 2 * fact(usual, "load_steps"));
    EXPECT_LT((small_steps.tip().position_B_mm - usual.tip().position_B_mm).norm(), round_off_mm);
    EXPECT_LT((large_steps.tip().position_B_mm - usual.tip().position_B_mm).norm(), round_off_mm);
  }
}

TEST(FemBeam, ATurnedSceneHasTheTurnedAnswer) {
  const double angle = 0.7;
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix();
  const auto scene = [](const Eigen::Matrix3d& turn) {
    scene::Scene s = uniform_rod(40, stiffness(1000, 1500, 666, 198),
                                 {scene::Force{40, Frame::follower, turn * Vector3d(-0.5, 0.8, 0.6)},
                                  scene::Moment{25, Frame::fixed, turn * Vector3d(5, -10, 8)},
                                  scene::DistributedForce{5, 30, Frame::fixed, turn * Vector3d(0.01, -0.02, 0.03)}});
    s.sections[0].rest_curvature_per_mm = turn * Vector3d(0.005, 0.01, -0.02);
    return s;
  };
  const scene::Equilibrium a = solved(scene(Eigen::Matrix3d::Identity()), bare());
  const scene::Equilibrium b = solved(scene(Q), bare());
  ASSERT_EQ(a.stations.size(), b.stations.size());
  for (std::size_t i = 0; i < a.stations.size(); ++i) {
    EXPECT_LT((Q * a.stations[i].X_BS.position_B_mm - b.stations[i].X_BS.position_B_mm).norm(), round_off_mm);
    EXPECT_LT((Q * a.stations[i].X_BS.rotation_BS * Q.transpose() - b.stations[i].X_BS.rotation_BS).norm(),
              round_off_mm);
    EXPECT_LT((Q * a.stations[i].moment_B_Nmm - b.stations[i].moment_B_Nmm).norm(), round_off_mm);
  }
}

// --- what is reported
// -------------------------------------------------------------------------------------------------

TEST(FemBeam, UnloadedRodKeepsItsRestShape) {
  scene::Scene scene = uniform_rod(40, stiffness(1000, 1500), {});
  EXPECT_LT((tip_mm(scene, bare()) - Vector3d(40, 0, 0)).norm(), round_off_mm);
  scene.sections[0].rest_curvature_per_mm = {0, 0, 0.05};
  EXPECT_LT((tip_mm(scene, bare()) - Vector3d(std::sin(2.0), 1 - std::cos(2.0), 0) / 0.05).norm(), 6.7e-8);  // 3.3e-8
}

TEST(FemBeam, StationsRunFromClampToTip) {
  const scene::Equilibrium found = solved(two_sections(mixed_loads()), Options{});
  ASSERT_GE(found.stations.size(), 101U);
  EXPECT_EQ(found.stations.front().s_mm, 0);
  EXPECT_EQ(found.stations.front().X_BS.position_B_mm.norm(), 0);
  EXPECT_NEAR(found.stations.back().s_mm, 40, 1e-12);
  for (std::size_t i = 1; i < found.stations.size(); ++i) {
    EXPECT_GT(found.stations[i].s_mm, found.stations[i - 1].s_mm);
    const Eigen::Matrix3d& R = found.stations[i].X_BS.rotation_BS;
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-13);
  }
  EXPECT_EQ(fact(found, "elements"), 50);
  EXPECT_EQ(fact(found, "order"), 2);
  EXPECT_GT(fact(found, "load_steps"), 0);
  EXPECT_GE(fact(found, "newton_iterations"), fact(found, "load_steps"));
  EXPECT_GT(found.error_estimate_mm, 0);
  EXPECT_FALSE(found.stable.has_value());
}

void expect_no_shape(const scene::Equilibrium& found, scene::Status status, const std::string& words) {
  EXPECT_EQ(found.status, status) << found.message;
  EXPECT_TRUE(found.stations.empty());
  EXPECT_NE(found.message.find(words), std::string::npos) << found.message;
}

TEST(FemBeam, ALoadThatCannotBeCarriedEndsInAStatus) {
  // A ring stiff in torsion, pulled open slightly out of its plane, snaps: the path from no load ends in a fold.
  scene::Scene snapping = uniform_rod(40, stiffness(5000, 1500), {scene::Force{40, Frame::fixed, {30, 0, 3}}});
  snapping.sections[0].rest_curvature_per_mm = {0, 0, 5.0 / 40};
  expect_no_shape(fem_reference::solve(snapping), scene::Status::load_step_too_small, "load factor 0.645");

  // The linear law would turn the rod inside out.
  const scene::Scene crushed =
      uniform_rod(40, stiffness(500, 750, 100, 99), {scene::Force{40, Frame::follower, {-150, 0, 0}}});
  expect_no_shape(fem_reference::solve(crushed), scene::Status::not_converged, "compressed to nothing");

  // Two turns on one element are no result.
  const scene::Scene coarse =
      uniform_rod(40, stiffness(500, 750), {scene::Moment{40, Frame::follower, {0, 0, 4 * pi * 750 / 40}}});
  expect_no_shape(fem_reference::solve(coarse, bare(1)), scene::Status::not_converged, "mesh is too coarse");

  Options impatient = bare();
  impatient.max_load_steps = 3;
  expect_no_shape(fem_reference::solve(coarse, impatient), scene::Status::work_limit, "load factor");
}

TEST(FemBeam, OptionsOutOfRangeAreRefused) {
  const scene::Scene scene = cantilever(Frame::fixed, 1);
  EXPECT_THROW(fem_reference::solve(scene, bare(0)), scene::SceneError);
  EXPECT_THROW(fem_reference::solve(scene, bare(50, 4)), scene::SceneError);
  Options options;
  options.tolerance = 0;
  EXPECT_THROW(fem_reference::solve(scene, options), scene::SceneError);
}

}  // namespace
