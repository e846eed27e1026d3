// What the tests of the finite element beam share. Limits are at most twice what is measured, which stands beside them;
// each has a twin of 5 % more stiffness that must miss it.
#pragma once

#include "fem_benchmark.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace fem_beam {

using Eigen::Vector3d;
using fem_benchmark::bare;
using fem_benchmark::solved;
using fem_reference::Options;
using scene::Frame;
using support::fact;
using support::uniform_rod;

constexpr double pi = std::numbers::pi;

// Where nothing but Newton's tolerance and round-off is left of the error.
constexpr double round_off_mm = 1e-11;  // measured 1e-13 at most

inline scene::Stiffness stiffness(double torsion_Nmm2, double bending_Nmm2) {
  scene::Stiffness result;
  result.torsion_Nmm2 = torsion_Nmm2;
  result.bending_Nmm2.setConstant(bending_Nmm2);
  return result;
}

inline scene::Stiffness stiffness(double torsion_Nmm2, double bending_Nmm2, double axial_N, double shear_N) {
  scene::Stiffness result = stiffness(torsion_Nmm2, bending_Nmm2);
  result.axial_N = axial_N;
  result.shear_N = Eigen::Vector2d::Constant(shear_N);
  return result;
}

inline Eigen::Vector3d tip_mm(const scene::Scene& scene, const fem_reference::Options& options) {
  return fem_benchmark::solved(scene, options).tip().position_B_mm;
}

inline scene::Scene two_sections(std::vector<scene::Load> loads) {
  scene::Stiffness proximal = stiffness(600, 800, 400, 120);
  proximal.bending_Nmm2[1] = 1200;
  (*proximal.shear_N)[1] = 90;
  proximal.mass_per_length_kg_per_m = 0.5;
  scene::Stiffness distal = stiffness(200, 300);
  distal.mass_per_length_kg_per_m = 0.2;
  scene::Scene scene;
  scene.sections = {{25, proximal, Eigen::Vector3d::Zero()}, {15, distal, Eigen::Vector3d(0.01, -0.02, 0.03)}};
  scene.loads = std::move(loads);
  return scene;
}

inline std::vector<scene::Load> mixed_loads() {
  return {scene::Force{18, scene::Frame::follower, {0.1, 0.4, -0.3}},
          scene::Moment{18, scene::Frame::follower, {4, -6, 5}},
          scene::Force{33, scene::Frame::fixed, {-0.2, 0.3, 0.2}},
          scene::Moment{33, scene::Frame::fixed, {-3, 2, 4}},
          scene::Force{40, scene::Frame::fixed, {0.1, -0.1, 0.25}},
          scene::Moment{40, scene::Frame::follower, {2, 1, -3}}};
}

// Tip force on a straight cantilever of length 1 and EI = 1 (consistent units).
inline scene::Scene cantilever(scene::Frame frame, double force_N, double bending_Nmm2 = 1) {
  return support::uniform_rod(1, stiffness(1, bending_Nmm2), {scene::Force{1, frame, Eigen::Vector3d(0, force_N, 0)}});
}

inline scene::Scene bend_45_degrees(double force_N, double stiffer = 1) {
  const double R = 100, L = R * pi / 4, E = stiffer * 1e7, G = stiffer * 5e6;
  scene::Scene scene =
      support::uniform_rod(L, stiffness(G / 6, E / 12, E, G), {scene::Force{L, scene::Frame::fixed, {0, 0, force_N}}});
  scene.sections[0].rest_curvature_per_mm = {0, 0, 1 / R};
  return scene;
}

}  // namespace fem_beam
