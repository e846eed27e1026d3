// The finite element beam's order, locking and invariance.
#include "fem_beam.h"

namespace {

using namespace fem_beam;

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

}  // namespace
