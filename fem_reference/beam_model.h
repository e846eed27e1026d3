// The rod as the finite elements see it: dimensionless, cut into elements, with nodal loads.
//
// Units: lengths in rod lengths L, forces in EI / L^2, moments in EI / L, curvatures in 1 / L, with EI the largest
// bending stiffness of the rod. All unknowns are then of order one and the linear systems well scaled.
#pragma once

#include "fem_reference/reference_element.h"
#include "fem_reference/rotation.h"
#include "scene/span.h"
#include "scene/span_facts.h"

#include <vector>

namespace fem_reference {

// What is constant along an element. S: section frame, B: base frame.
struct ElementData {
  double length = 0;
  Eigen::Vector3d moment_stiffness;  // K_u = (GJ, EI_y, EI_z)
  Eigen::Vector3d force_compliance;  // 1 / K_v = 1 / (EA, kGA_y, kGA_z); 0: does not stretch, shear
  Eigen::Vector3d rest_curvature;    // u_rest
  // The rest is multiplied by the load factor.
  std::vector<scene::SectionTendon> tendons;  // arms in L, tensions in EI / L^2
  Eigen::Vector3d follower_force_S;           // per length
  Eigen::Vector3d fixed_force_B;              // per length
};

// v = (1 + stretch, shear y, shear z), u = (torsion, bending y, bending z), section frame.
struct SectionStrain {
  Eigen::Vector3d v;
  Eigen::Vector3d u;
};

struct NodalLoad {
  int node = 0;
  scene::Wrench follower_S;
  scene::Wrench fixed_B;
  Eigen::Matrix3d fixed_force_arms_BS = Eigen::Matrix3d::Zero();  // as in scene::Span
};

struct BeamModel {
  double length_unit_mm = 1;
  double force_unit_N = 1;
  ReferenceElement reference;
  std::vector<ElementData> elements;  // clamp to tip
  std::vector<NodalLoad> loads;
  bool conservative = false;      // these as in scene/span_facts.h
  bool all_loads_follow = false;  // then there is one equilibrium
  scene::Symmetry symmetry = scene::Symmetry::none;

  double moment_unit_Nmm() const { return force_unit_N * length_unit_mm; }
  int nodes() const { return static_cast<int>(elements.size()) * reference.order() + 1; }
};

// Unknowns. Node i of element e is number e * order + i; force at point g of element e is number e * points + g.
// Quaternions are followed continuously from the rest shape, so their signs agree along the rod without alignment.
struct BeamState {
  std::vector<Eigen::Vector3d> position_B;
  std::vector<Quaternion> rotation_BS;
  std::vector<Eigen::Vector3d> force_S;  // the rod's own internal force (total less tendons), section frame
};

// Displacements (base frame), rotation vectors (section frame, rad), force increments; numbered as in BeamState.
struct BeamIncrement {
  std::vector<Eigen::Vector3d> displacement_B;
  std::vector<Eigen::Vector3d> rotation_S;
  std::vector<Eigen::Vector3d> force_S;
};

// cells[i] elements of equal length on span i. `kirchhoff` sets the compliance to stretch and shear to zero.
BeamModel beam_model(const std::vector<scene::Span>& spans, const std::vector<int>& cells,
                     const ReferenceElement& reference, bool kirchhoff);

// The unloaded rod, its rest curvature integrated exactly, element by element.
BeamState rest_state(const BeamModel& model);

// state + factor * increment; rotations q <- q exp(factor * rotation_S).
void advance(BeamState& state, const BeamIncrement& increment, double factor = 1);

// The increment that leads from one state to another.
BeamIncrement difference(const BeamState& from, const BeamState& to);

// Largest rotation of any node from one state to another, rad.
double largest_rotation(const BeamState& from, const BeamState& to);

double largest_entry(const std::vector<Eigen::Vector3d>& vectors);  // of their components' sizes

bool all_finite(const BeamState& state);

}  // namespace fem_reference
