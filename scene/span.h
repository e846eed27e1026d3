// A scene cut at everything that is not smooth: section changes, point loads, ends of distributed loads and tendons.
// Bookkeeping that every method needs and none owns; there is no mechanics in it.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace scene {

// A force and a moment.
struct Wrench {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nmm = Eigen::Vector3d::Zero();

  bool is_zero() const { return force_N.isZero(0) && moment_Nmm.isZero(0); }
};

// A stretch of rod with one section and the same loads all along it.
struct Span {
  double start_mm = 0;
  double end_mm = 0;
  Stiffness stiffness;
  Eigen::Vector3d rest_curvature_per_mm = Eigen::Vector3d::Zero();

  // Point loads at end_mm, summed.
  Wrench follower_load_S;  // in the section frame at end_mm
  Wrench fixed_load_B;     // in the base frame

  // Distributed forces all along the span, gravity included.
  Eigen::Vector3d follower_force_S_N_per_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d fixed_force_B_N_per_mm = Eigen::Vector3d::Zero();

  // Internal force and moment of the tendons that run through the span; constant in the section frame.
  Wrench tendon_S;

  double length_mm() const { return end_mm - start_mm; }
};

// The spans of a valid scene, clamp to tip. Cost linear in sections + loads, but for the sort of the places and
// for distributed loads and tendons, which visit each span they cover.
std::vector<Span> spans_of(const Scene& scene);

// Shares `count` cells (arcs, elements) out over the spans, by length, at least one each, so that the sum is
// max(count, number of spans).
std::vector<int> cells_per_span(const std::vector<Span>& spans, int count);

}  // namespace scene
