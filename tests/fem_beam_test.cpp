// The finite element beam against closed forms, published benchmarks and independent solutions.
#include "fem_beam.h"

namespace {

using namespace fem_beam;
using fem_reference::RodModel;
using support::number;
using support::read_csv;

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

// --- published benchmarks and computed tables ------------------------------------------------------------------------

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

}  // namespace
