// What the tests share that mutants of tests/mutants.txt once survived. Each number in them is a closed form or follows
// from one scene by a rotation; where it is written out its origin stands beside it.
#pragma once

#include "exact_reference/solve.h"
#include "fem_reference/solve.h"
#include "support.h"
#include "support_fam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace survivors {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using scene::DistributedForce;
using scene::Equilibrium;
using scene::Force;
using scene::Frame;
using scene::Load;
using scene::Moment;
using scene::Scene;
using scene::Tendon;
using support::fact;
using support::slender;
using support::uniform_rod;

using Method = std::function<Equilibrium(const Scene&)>;

inline constexpr double pi = std::numbers::pi;
inline constexpr double eps = std::numeric_limits<double>::epsilon();

inline std::vector<scene::Span> spans(const Scene& scene) {
  return scene::spans_of(scene);
}

inline scene::Stiffness strip() {
  scene::Stiffness stiffness = slender(1, 1);
  stiffness.bending_Nmm2[1] = 1000;
  return stiffness;
}

// Opposite fixed forces at opposite arms: a couple, and no force.
inline std::vector<Load> couple(double at_mm, const Vector3d& force_N, const Vector2d& arm_mm) {
  return {Force{at_mm, Frame::fixed, force_N, arm_mm}, Force{at_mm, Frame::fixed, -force_N, -arm_mm}};
}

inline Equilibrium by_fam(const Scene& scene, double tolerance_mm = 1e-8) {
  return support::solved(scene, tolerance_mm);
}

inline Equilibrium by_fam(const Scene& scene, fam::Law law, int arcs) {
  fam::Options options;
  options.law = law;
  options.arcs = arcs;
  return fam::solve(scene, options);
}

inline Equilibrium by_fem(const Scene& scene, int elements = 60, int order = 3) {
  fem_reference::Options options;
  options.elements = elements;
  options.order = order;
  options.estimate_error = false;
  return fem_reference::solve(scene, options);
}

inline Equilibrium by_exact(const Scene& scene, double tolerance = 1e-12) {
  return exact_reference::solve(scene, {.tolerance = tolerance});
}

inline Vector3d tip(const Equilibrium& result) {
  EXPECT_TRUE(result.converged()) << result.message;
  return result.converged() ? result.tip().position_B_mm : Vector3d::Constant(NAN);
}

// Turn of a section about the axis of a straight rod.
inline double twist(const Matrix3d& R) {
  return std::atan2(R(2, 1), R(1, 1));
}

}  // namespace survivors
