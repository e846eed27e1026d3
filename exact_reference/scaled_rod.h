// A scene made dimensionless: lengths over L, curvatures times L, forces over EI/L^2, moments over EI/L, compliances
// accordingly. EI is the length-weighted harmonic mean of each span's softer bending stiffness, so that rods of any
// size and stiffness look alike to the solvers, and absolute tolerances mean something.
#pragma once

#include "scene/span_facts.h"

#include <vector>

namespace exact_reference {

enum class RodModel {
  reissner,  // stretches and shears where the section says so
  kirchhoff  // no stretch and no shear, whatever the section says
};

// scene::Span, dimensionless. Suffix _S: section frame; _B: base frame.
struct ScaledSpan {
  double start = 0;
  double end = 0;
  Eigen::Vector3d bending_compliance;  // K_u^-1: torsion, bending y, bending z
  Eigen::Vector3d shear_compliance;    // K_v^-1: stretch, shear y, shear z; 0 = rigid
  Eigen::Vector3d rest_curvature_S;
  Eigen::Vector3d follower_density_S;  // force per length
  Eigen::Vector3d fixed_density_B;
  scene::Wrench follower_load_S;  // at the span's end
  scene::Wrench fixed_load_B;
  scene::Wrench tendon_S;

  double length() const { return end - start; }
};

struct ScaledRod {
  double length_mm = 0;
  double force_unit_N = 0;     // EI/L^2
  double moment_unit_Nmm = 0;  // EI/L
  std::vector<ScaledSpan> spans;
  scene::Symmetry symmetry = scene::Symmetry::none;

  // Sum of all loads but the tendons', times the largest compliance: below 1 nothing buckles.
  double load_size() const;
  bool has_fixed_load() const;       // any load with components in the base frame, gravity included
  bool has_fixed_moment() const;     // not conservative in space
  bool has_follower_load() const;    // not conservative
  bool shears_or_stretches() const;  // any shear compliance that is not 0
};

ScaledRod scaled_rod(const scene::Scene& scene, RodModel model);

}  // namespace exact_reference
