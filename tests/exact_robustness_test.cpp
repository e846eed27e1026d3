// Random scenes over all load kinds: how many converge, and whether the error estimate keeps its promise.
#include "exact_scenes.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>

using namespace exact_test;

namespace {

class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : engine_(seed) {}

  // One to three sections, one to three loads of any kind; forces up to `largest` EI/L^2, moments up to its root EI/L.
  scene::Scene next(double largest) {
    const double L = std::pow(10, uniform(0, 2.5)), EI = std::pow(10, uniform(1, 5));
    scene::Scene rod;
    const int sections = integer(1, 3);
    for (int i = 0; i < sections; ++i) rod.sections.push_back(section(L / sections, EI));
    const int loads = integer(1, 3);
    for (int i = 0; i < loads; ++i)
      rod.loads.push_back(load(L, EI, std::exp(uniform(std::log(0.1), std::log(largest)))));
    return rod;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Vector3d direction() { return Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized(); }

  scene::Section section(double length, double EI) {
    scene::Stiffness s;
    s.bending_Nmm2 = EI * Vector2d(uniform(0.5, 2), uniform(0.5, 2));
    s.torsion_Nmm2 = EI * uniform(0.3, 1.5);
    s.mass_per_length_kg_per_m = 1;
    if (integer(0, 1) == 1) s.axial_N = EI / length / length * std::pow(10, uniform(2, 6));
    if (integer(0, 1) == 1) s.shear_N = Vector2d::Constant(EI / length / length * std::pow(10, uniform(2, 6)));
    const Vector3d rest =
        integer(0, 2) == 0 ? Vector3d(uniform(0, 1) / length * direction()) : Vector3d(Vector3d::Zero());
    return {length, s, rest};
  }

  scene::Load load(double L, double EI, double size) {
    const Vector3d force = size * EI / L / L * direction();
    const Frame frame = integer(0, 1) == 0 ? Frame::fixed : Frame::follower;
    const double place = integer(0, 1) == 0 ? L : L * uniform(0.2, 1);
    switch (integer(0, 4)) {
      case 0: return scene::Force{place, frame, force};
      case 1: return scene::Moment{place, frame, std::sqrt(size) * EI / L * direction()};
      case 2: return scene::DistributedForce{L * uniform(0, 0.4), L * uniform(0.5, 1), frame, force / L};
      case 3: return scene::Gravity{1e3 * force / L};  // 1 kg/m
      default: return scene::Tendon{0.05 * L * Vector2d(uniform(-1, 1), uniform(-1, 1)), force.norm(), place};
    }
  }

  std::mt19937 engine_;
};

struct Outcome {
  int converged = 0, limit_point = 0, not_converged = 0;
  int broken_promises = 0;  // true error above the estimate
  double largest_error = 0, largest_ratio = 0;
  double worst_estimate = 0;
};

// "Truth": the same scene by a mesh adapted to a local error 100 times smaller or more.
Outcome run(int scenes, double largest, double tolerance) {
  RandomScenes random(20240607);
  Outcome outcome;
  for (int i = 0; i < scenes; ++i) {
    const scene::Scene rod = random.next(largest);
    const scene::Equilibrium result = exact_reference::solve(
        rod, {exact_reference::RodModel::reissner, tolerance, exact_reference::Way::boundary_value});
    outcome.limit_point += result.status == scene::Status::limit_point;
    outcome.not_converged += result.status == scene::Status::not_converged;
    if (!result.converged()) continue;
    ++outcome.converged;
    const double L = scene::length_mm(rod);
    const scene::Equilibrium truth = exact_reference::solve(rod, {exact_reference::RodModel::reissner, 1e-13});
    const double error = (tip_mm(result) - tip_mm(truth)).norm() / L, estimate = result.error_estimate_mm / L;
    const double truth_estimate = truth.error_estimate_mm / L;
    if (!(error <= estimate + truth_estimate)) {
      ++outcome.broken_promises;
      std::printf("scene %d: error %.2g, estimate %.2g, of the truth %.2g\n", i, error, estimate, truth_estimate);
    }
    outcome.largest_error = std::max(outcome.largest_error, error);
    outcome.worst_estimate = std::max(outcome.worst_estimate, estimate);
    outcome.largest_ratio = std::max(outcome.largest_ratio, error / (estimate + truth_estimate));
  }
  std::printf(
      "%d scenes, loads to %g, tolerance %g: %d converged, %d at a fold, %d not; largest error %.2g L, "
      "estimate %.2g L, error over estimate %.2g\n",
      scenes, largest, tolerance, outcome.converged, outcome.limit_point, outcome.not_converged, outcome.largest_error,
      outcome.worst_estimate, outcome.largest_ratio);
  return outcome;
}

}  // namespace

TEST(ExactRobustness, ModerateLoads) {
  const Outcome outcome = run(300, 10, 1e-12);
  EXPECT_GE(outcome.converged, 290);
  EXPECT_EQ(outcome.broken_promises, 0);
}

TEST(ExactRobustness, LargeLoads) {
  const Outcome outcome = run(300, 100, 1e-12);
  EXPECT_GE(outcome.converged, 250);
  EXPECT_EQ(outcome.broken_promises, 0);
}

TEST(ExactRobustness, LooseTolerance) {
  const Outcome outcome = run(300, 30, 1e-6);
  EXPECT_EQ(outcome.broken_promises, 0);
  EXPECT_GT(outcome.largest_error, 1e-12);  // the comparison sees errors where they are
}
