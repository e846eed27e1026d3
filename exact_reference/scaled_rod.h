// A scene made dimensionless: lengths over L, curvatures times L, forces over EI/L^2, moments over EI/L, compliances
// accordingly. EI is the length-weighted harmonic mean of each span's softer bending stiffness, so that rods of any
// size and stiffness look alike to the solvers, and absolute tolerances mean something.
#pragma once

#include "exact_reference/tendon_strains.h"
#include "scene/rod_model.h"
#include "scene/span_facts.h"

#include <optional>
#include <span>
#include <vector>

namespace exact_reference {

using scene::RodModel;

// Loads of a span. Suffix _S: section frame; _B: base frame.
struct SpanLoads {
  Eigen::Vector3d follower_density_S = Eigen::Vector3d::Zero();  // force per length
  Eigen::Vector3d fixed_density_B = Eigen::Vector3d::Zero();
  scene::Wrench follower_load_S;  // at the span's end
  scene::Wrench fixed_load_B;
  // Sum F r^T of the fixed forces off the centreline at the span's end.
  Eigen::Matrix3d fixed_force_arms_BS = Eigen::Matrix3d::Zero();
};

// scene::Span, dimensionless.
struct ScaledSpan : SpanLoads {
  double start = 0;
  double end = 0;
  Eigen::Vector3d bending_compliance;  // K_u^-1: torsion, bending y, bending z
  Eigen::Vector3d shear_compliance;    // K_v^-1: stretch, shear y, shear z; 0 = rigid
  Eigen::Vector3d rest_curvature_S;
  std::vector<ScaledTendon> tendons;
  SpanLoads before;  // that the loads grow from

  double length() const { return end - start; }
};

// One of the scene's tendons, slack ones included.
struct TendonPath {
  std::size_t arm = 0;    // of ScaledRod::tendon_arms_S
  std::size_t spans = 0;  // that it runs through, from the clamp
};

struct ScaledRod {
  double length_mm = 0;
  double force_unit_N = 0;     // EI/L^2
  double moment_unit_Nmm = 0;  // EI/L
  std::vector<ScaledSpan> spans;
  std::vector<Eigen::Vector3d> tendon_arms_S;  // different ones
  std::vector<TendonPath> tendon_paths;        // in the order of the scene's loads
  scene::Symmetry symmetry = scene::Symmetry::none;
  std::optional<Eigen::Vector3d> plane_normal_B;  // of a planar scene, in the scene's base frame
  // From the scene's frames, base and section alike, to those here. The identity but for a rod that bends in an oblique
  // plane: it is turned about its axis, that plane to x-y, so that the symmetry is exact in rounded numbers, too.
  Eigen::Matrix3d turn_about_axis = Eigen::Matrix3d::Identity();

  // Sum of all forces and moments, the tendons' bending included, times the largest compliance: below 1 nothing
  // buckles.
  double load_size() const;
  bool has_fixed_load() const;  // any load with components in the base frame, gravity included
  // Moments fixed in space are the only loads, so that the internal ones are known in the base frame before the shape
  // is, and there is one equilibrium. Told apart here and not by scene::moments_are_known, which FAM goes by.
  bool moments_are_known() const;
  bool has_tendon() const;
  bool has_fixed_moment() const;                                                   // not conservative in space
  bool has_follower_load() const;                                                  // not conservative
  bool has_energy() const { return !has_follower_load() && !has_fixed_moment(); }  // loads are conservative
  bool shears_or_stretches() const;                                                // any shear compliance that is not 0
};

ScaledRod scaled_rod(const scene::Scene& scene, RodModel model);
// One of scenes that differ in the values of their loads or in their rest curvatures: with the cuts that the cutter has
// made in one of them, in the scene's own axes.
ScaledRod scaled_rod(const scene::Scene& scene, const scene::SpanCutter& cutter, RodModel model);
// Scenes that differ in their loads alone, not in their kinds: each rod's loads grow from those of the one before, the
// first one's from none. With one scene's cuts as with all's.
std::vector<ScaledRod> scaled_way(std::span<const scene::Scene> scenes, RodModel model);

}  // namespace exact_reference
