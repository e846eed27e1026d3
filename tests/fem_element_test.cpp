// The finite element by itself: its derivatives against central differences, its strains under rigid rotations.
#include "fem_reference/beam_element.h"
#include "fem_reference/section_strain.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace fem_reference {
namespace {

using Eigen::Vector3d;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double number() { return distribution_(generator_); }
  Vector3d vector() { return {number(), number(), number()}; }

 private:
  std::mt19937 generator_;
  std::uniform_real_distribution<double> distribution_{-1, 1};
};

struct Sample {
  ReferenceElement reference;
  ElementData data;
  BeamState state;

  ElementState element() const { return {state.position_B, state.rotation_BS, state.force_S}; }
};

// An element with all loads, far from equilibrium, turning by about a radian.
Sample sample(int order, bool full_integration, unsigned seed) {
  Random random(seed);
  Sample s;
  s.reference = reference_element(order, order + (full_integration ? 1 : 0));
  s.data.length = 0.3;
  s.data.moment_stiffness = Vector3d(0.7, 1.0, 1.4);
  s.data.force_compliance = Vector3d(0.1, 0.3, 0.2);
  s.data.rest_curvature = random.vector();
  for (const double tension : {0.6, 1.3}) s.data.tendons.push_back({0.2 * random.vector(), tension});
  s.data.follower_force_S = random.vector();
  s.data.fixed_force_B = random.vector();
  const Quaternion mean = exponential(3 * random.vector());
  for (int i = 0; i <= order; ++i) {
    s.state.position_B.push_back(Vector3d(0.3 * s.reference.node(i), 0, 0) + 0.1 * random.vector());
    s.state.rotation_BS.push_back(product(mean, exponential(0.5 * random.vector())));
  }
  for (int g = 0; g < s.reference.points(); ++g) s.state.force_S.push_back(random.vector());
  return s;
}

// The state with unknown number k of the element's order changed by `change`.
BeamState moved(const Sample& s, int k, double change) {
  BeamState state = s.state;
  const int nodes = s.reference.nodes();
  if (k >= 6 * nodes) {
    const int f = k - 6 * nodes;
    state.force_S[static_cast<std::size_t>(f / 3)][f % 3] += change;
  } else if (k % 6 < 3) {
    state.position_B[static_cast<std::size_t>(k / 6)][k % 6] += change;
  } else {
    Quaternion& q = state.rotation_BS[static_cast<std::size_t>(k / 6)];
    q = product(q, exponential(change * Vector3d::Unit(k % 6 - 3)));
  }
  return state;
}

TEST(FemElement, TangentIsTheDerivativeOfTheResidual) {
  const double load_factor = 0.8, step = 1e-5;
  for (const int order : {1, 2, 3}) {
    for (const bool full : {false, true}) {
      for (const unsigned seed : {1U, 2U, 3U}) {
        const Sample s = sample(order, full, seed);
        ElementSystem system, above, below;
        element_system(s.reference, s.data, s.element(), load_factor, system);
        Eigen::MatrixXd differences(system.tangent.rows(), system.tangent.cols());
        for (int k = 0; k < differences.cols(); ++k) {
          Sample up = s, down = s;
          up.state = moved(s, k, step);
          down.state = moved(s, k, -step);
          element_system(up.reference, up.data, up.element(), load_factor, above);
          element_system(down.reference, down.data, down.element(), load_factor, below);
          differences.col(k) = (above.residual - below.residual) / (2 * step);
        }
        const double scale = system.tangent.cwiseAbs().maxCoeff();
        EXPECT_LT((differences - system.tangent).cwiseAbs().maxCoeff(), 1e-8 * scale) << order << full << seed;
      }
    }
  }
}

TEST(FemElement, NodalLoadTangentIsTheDerivativeOfItsResidual) {
  Random random(7);
  const double step = 1e-5;
  NodalLoad load{0, {random.vector(), random.vector()}, {random.vector(), random.vector()}};
  for (int i = 0; i < 2; ++i) load.fixed_force_arms_BS += random.vector() * random.vector().transpose();
  const Quaternion q = exponential(4 * random.vector());
  const NodalSystem system = nodal_system(load, q, 0.7);
  EXPECT_EQ(system.tangent.leftCols<3>().cwiseAbs().maxCoeff(), 0);
  for (int k = 0; k < 3; ++k) {
    const Vector3d turn = step * Vector3d::Unit(k);
    const auto above = nodal_system(load, product(q, exponential(turn)), 0.7).residual;
    const auto below = nodal_system(load, product(q, exponential(-turn)), 0.7).residual;
    EXPECT_LT(((above - below) / (2 * step) - system.tangent.col(3 + k)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

// The unsymmetric term of each node's own block vanishes in equilibrium only. Here it is large enough for the
// comparison above to fail if it were left out or had the wrong sign.
TEST(FemElement, NodalTermOfTheTangentMatters) {
  const Sample s = sample(2, false, 1);
  ElementSystem system;
  element_system(s.reference, s.data, s.element(), 0.8, system);
  const Eigen::Matrix3d block = system.tangent.block<3, 3>(3, 3);
  EXPECT_GT((block - block.transpose()).cwiseAbs().maxCoeff(), 1e-3 * system.tangent.cwiseAbs().maxCoeff());
}

TEST(FemElement, StrainsAreUnchangedByARigidMotion) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    Random random(100 + seed);
    const Sample s = sample(2, false, seed);
    const Quaternion turn = exponential(5 * random.vector());
    const Vector3d shift = 10 * random.vector();
    Sample turned = s;
    for (Vector3d& r : turned.state.position_B) r = shift + rotated(turn, r);
    for (Quaternion& q : turned.state.rotation_BS) q = product(turn, q);
    for (int g = 0; g < s.reference.points(); ++g) {
      const SectionStrain a = element_strain(s.reference, s.data, s.element(), g);
      const SectionStrain b = element_strain(turned.reference, turned.data, turned.element(), g);
      EXPECT_LT((a.u - b.u).norm(), 1e-13 * (1 + a.u.norm()));
      EXPECT_LT((a.v - b.v).norm(), 1e-12 * (1 + a.v.norm()));
    }
  }
}

TEST(FemElement, StrainOfAnArcIsItsCurvature) {
  // Rotation e_z kappa s: u = (0, 0, kappa) up to the interpolation, v = e_x. At 1e-8 the sign is still right.
  for (const double kappa : {0.0, 1e-8, 0.4}) {
    BeamModel model;
    model.reference = reference_element(2, 2);
    model.elements.resize(1);
    model.elements[0].length = 0.5;
    model.elements[0].rest_curvature = Vector3d(0, 0, kappa);
    const BeamState rest = rest_state(model);
    for (int g = 0; g < 2; ++g) {
      const SectionStrain strain =
          element_strain(model.reference, model.elements[0], {rest.position_B, rest.rotation_BS, rest.force_S}, g);
      EXPECT_NEAR(strain.u.z(), kappa, 1e-4 * kappa + 1e-16);
      EXPECT_LT((strain.v - Vector3d::UnitX()).norm(), 1e-3 * kappa + 1e-15);
    }
  }
}

TEST(FemRotation, ExponentialAndLogarithmBelongTogether) {
  Random random(11);
  for (const double size : {0.0, 1e-12, 1e-8, 1e-4, 1.0, 6.0}) {
    const Vector3d vector = size * random.vector().normalized();
    EXPECT_LT((logarithm(exponential(vector)) - vector).norm(), 1e-14 * (1 + size));
  }
  const Quaternion turn = exponential(Vector3d(0, 0, 2 * std::numbers::pi));
  EXPECT_LT((turn + Quaternion::Unit(0)).norm(), 1e-15);
  const Vector3d quarter = rotated(exponential(Vector3d(0, 0, std::numbers::pi / 2)), Vector3d::UnitX());
  EXPECT_LT((quarter - Vector3d::UnitY()).norm(), 1e-15);
}

TEST(FemReferenceElement, IntegratesAndInterpolates) {
  for (const int order : {1, 2, 3}) {
    const ReferenceElement element = reference_element(order, order);
    EXPECT_NEAR(element.weight.sum(), 1, 1e-14);
    for (int g = 0; g < element.points(); ++g) {
      double value = 0, slope = 0;
      for (int i = 0; i <= order; ++i) {
        value += element.value(g, i) * element.node(i);
        slope += element.slope(g, i) * element.node(i);
      }
      EXPECT_NEAR(value, element.point(g), 1e-14);
      EXPECT_NEAR(slope, 1, 1e-13);
    }
    for (int i = 1; i <= order; ++i) EXPECT_GT(element.node(i), element.node(i - 1));
  }
}

}  // namespace
}  // namespace fem_reference
