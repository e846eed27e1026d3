// What the finite element beam answers: loads along a rod of two sections, stations, statuses.
#include "fem_beam.h"

namespace {

using namespace fem_beam;
using fem_reference::RodModel;

// By scipy DOP853 shooting at rtol 1e-12, Newton on the clamp's rotation to 1e-11; independent of this project.
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
  expect_no_shape(fem_reference::solve(snapping), scene::Status::limit_point, "snaps at 64.5 %");

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
