// The condensed linear system against the whole one, which a dense LU decomposition solves: increments and
// determinants.
#include "fem_reference/band_system.h"
#include "fem_reference/beam_system.h"
#include "fem_whole_system.h"
#include "support.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <random>

namespace fem_reference {
namespace {

using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;
using scene::Frame;

VectorXd flat(const BeamIncrement& increment) {
  std::vector<double> values;
  for (std::size_t i = 1; i < increment.displacement_B.size(); ++i) {
    for (const Vector3d* part : {&increment.displacement_B[i], &increment.rotation_S[i]}) {
      values.insert(values.end(), part->begin(), part->end());
    }
  }
  for (const Vector3d& force_S : increment.force_S) values.insert(values.end(), force_S.begin(), force_S.end());
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void expect_same(const scene::Determinant& found, const scene::Determinant& expected, int trace) {
  EXPECT_EQ(found.negative, expected.negative) << trace;
  EXPECT_NEAR(found.log_size, expected.log_size, 1e-9 * (1 + std::abs(expected.log_size))) << trace;
}

// Far from equilibrium; in the x-y plane alone if asked.
BeamState disturbed(const BeamModel& model, unsigned seed, bool planar) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const Vector3d in_plane = planar ? Vector3d(1, 1, 0) : Vector3d::Ones();
  const Vector3d turn = planar ? Vector3d(0, 0, 1) : Vector3d::Ones();
  const auto random = [&](const Vector3d& components) {
    return Vector3d(components.cwiseProduct(Vector3d(normal(generator), normal(generator), normal(generator))));
  };
  BeamState state = rest_state(model);
  BeamIncrement increment = difference(state, state);
  for (Vector3d& v : increment.displacement_B) v = 0.05 * random(in_plane);
  for (Vector3d& v : increment.rotation_S) v = 0.3 * random(turn);
  for (Vector3d& v : increment.force_S) v = 8 * random(in_plane);
  increment.displacement_B.front().setZero();
  increment.rotation_S.front().setZero();
  advance(state, increment);
  return state;
}

// All kinds of loads on two sections; in the x-y plane alone if asked.
scene::Scene loaded(bool planar, bool stretches, bool with_tendons) {
  const double z = planar ? 0 : 1;
  scene::Stiffness thick = support::slender(1500, 1000), thin = support::slender(700, 900);
  thin.bending_Nmm2[1] = 1100;
  for (scene::Stiffness* stiffness : {&thick, &thin}) {
    if (!stretches) continue;
    stiffness->axial_N = 80;
    stiffness->shear_N = Eigen::Vector2d(30, 20);
  }
  scene::Scene scene{
      "",
      {{25, thick, Vector3d(0.01 * z, -0.01 * z, 0.02)}, {15, thin, Vector3d::Zero()}},
      {scene::Force{40, Frame::fixed, {-2, 0.5, 0.7 * z}}, scene::Force{40, Frame::follower, {-1, 1, -z}},
       scene::Moment{30, Frame::fixed, {5 * z, 6 * z, 9}}, scene::Moment{25, Frame::follower, {5 * z, -6 * z, 9}},
       scene::DistributedForce{5, 40, Frame::follower, {-0.01, 0.02, 0.03 * z}},
       scene::DistributedForce{0, 20, Frame::fixed, {-0.03, 0.02, -0.01 * z}}}};
  if (with_tendons) scene.loads.push_back(scene::Tendon{{1.5, 0.5 * z}, 12, 30});
  return scene;
}

TEST(FemCondensation, IncrementAndDeterminantAreThoseOfTheWholeSystem) {
  int trace = 0;
  for (const int order : {1, 2, 3}) {
    for (const int more_points : {0, 1}) {
      for (const bool tendons : {false, true}) {
        for (const bool stretches : {false, true}) {
          if (more_points > 0 && !stretches) continue;
          const BeamModel model = beam_model(scene::spans_of(loaded(false, stretches, tendons)), {1, 2, 1, 2, 1},
                                             reference_element(order, order + more_points), false);
          for (const unsigned seed : {1U, 2U, 3U, 4U}) {
            const BeamState state = disturbed(model, seed, false);
            BeamSystem system(model);
            const WholeSystem whole(model, state, 0.9);
            EXPECT_EQ(system.residual(state, 0.9).largest(), system.assemble(state, 0.9).largest());
            EXPECT_NEAR(system.assemble(state, 0.9).largest(), whole.residual.lpNorm<Eigen::Infinity>(), 1e-12);
            BeamIncrement increment;
            ASSERT_TRUE(system.newton_increment(increment));
            const VectorXd expected = whole.tangent.fullPivLu().solve(-whole.residual);
            EXPECT_LT((flat(increment) - expected).norm(), 1e-8 * expected.norm()) << ++trace;
            expect_same(system.determinant().value(), whole.determinant(whole.all()), trace);
          }
        }
      }
    }
  }
}

// A clamped rod that is unloaded, and one pressed far beyond where it buckles, have determinants of both signs: the
// inner blocks', the row exchanges' and the pivots' signs all count.
TEST(FemCondensation, SignsOfBothKindsOccur) {
  int negative = 0, cases = 0;
  for (const double pressed_N : {0.0, 5.0, 20.0, 80.0, 300.0, 1000.0, 3000.0}) {
    scene::Stiffness stiffness = support::slender(750, 500);
    stiffness.bending_Nmm2[1] = 1300;
    const BeamModel model = beam_model(
        scene::spans_of(support::uniform_rod(40, stiffness, {scene::Force{40, Frame::fixed, {-pressed_N, 1, 1}}})), {5},
        reference_element(2, 2), true);
    for (const unsigned seed : {1U, 2U, 3U}) {
      BeamState state = disturbed(model, seed, false);
      for (Vector3d& force_S : state.force_S) force_S.x() -= pressed_N / model.force_unit_N;
      BeamSystem system(model);
      system.assemble(state, 1);
      const WholeSystem whole(model, state, 1);
      expect_same(system.determinant().value(), whole.determinant(whole.all()), cases);
      negative += system.determinant().value().negative;
      ++cases;
    }
  }
  EXPECT_GT(negative, 2);
  EXPECT_LT(negative, cases - 2);
}

TEST(FemCondensation, InAPlaneTheDeterminantIsThatOfMotionsInIt) {
  for (const bool stretches : {false, true}) {
    for (const int order : {1, 2, 3}) {
      const BeamModel model = beam_model(scene::spans_of(loaded(true, stretches, true)), {1, 2, 1, 2, 1},
                                         reference_element(order, order), false);
      ASSERT_EQ(model.symmetry, scene::Symmetry::plane_xy);
      const BeamState state = disturbed(model, 5, true);
      const WholeSystem whole(model, state, 0.9);
      std::vector<int> in_plane;
      for (int k = 0; k < whole.residual.size(); ++k) {
        const bool is_turn = k < 6 * (model.nodes() - 1) && k % 6 >= 3;
        if ((k % 3 == 2) == is_turn) in_plane.push_back(k);
      }
      BeamSystem system(model);
      system.assemble(state, 0.9);
      expect_same(system.determinant().value(), whole.determinant(in_plane), order);
    }
  }
}

TEST(FemCondensation, ASystemThatIsNotFiniteOrSingularSaysSo) {
  const BeamModel model =
      beam_model(scene::spans_of(loaded(false, true, true)), {1, 2, 1, 2, 1}, reference_element(2, 2), false);
  BeamState state = disturbed(model, 1, false);
  state.position_B[3].x() = std::nan("");
  BeamSystem system(model);
  EXPECT_FALSE(system.assemble(state, 1).finite());
  EXPECT_FALSE(system.residual(state, 1).finite());
  BeamIncrement increment;
  EXPECT_FALSE(system.newton_increment(increment) && flat(increment).allFinite());

  BandSystem band(3, 1, 1);
  EXPECT_FALSE(band.factorise());  // all zero
}

TEST(FemCondensation, BandSystemSolvesAndTellsItsDeterminant) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const int size = 2 + trial % 12, lower = trial % 3, upper = trial % 4;
    MatrixXd dense = MatrixXd::Zero(size, size);
    BandSystem band(size, lower, upper);
    for (int i = 0; i < size; ++i) {
      for (int j = std::max(0, i - lower); j <= std::min(size - 1, i + upper); ++j) {
        band.entry(i, j) = dense(i, j) = normal(generator);
      }
    }
    std::vector<double> x(static_cast<std::size_t>(size));
    for (double& value : x) value = normal(generator);
    const VectorXd right = Eigen::Map<const VectorXd>(x.data(), size);
    ASSERT_TRUE(band.factorise());
    band.solve(x);
    const VectorXd found = Eigen::Map<const VectorXd>(x.data(), size);
    EXPECT_LT((dense * found - right).norm(), 1e-12 * (dense.norm() * found.norm() + 1));
    const double determinant = dense.partialPivLu().determinant();
    EXPECT_EQ(band.determinant().negative, determinant < 0);
    EXPECT_NEAR(band.determinant().log_size, std::log(std::abs(determinant)), 1e-10);
  }
}

}  // namespace
}  // namespace fem_reference
