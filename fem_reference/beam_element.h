// Residual and tangent of one element and of one nodal load.
//
// The element is the stationary point of the Hellinger-Reissner functional, dimensionless as in beam_model.h,
//   sum over Gauss points of  w [ n . (v - e_x) - 1/2 n . C n + 1/2 (u - u_rest) . K_u (u - u_rest) + sum T |v + u x r|
//   ]
//   -  load work
// with the rod's own internal force n (section frame) as an unknown at each Gauss point and the tendons' lengths as
// their energy (tendon_pull.h): the total force and moment are n + sum T d and K_u (u - u_rest) + sum r x T d. Where C
// > 0 this is the displacement element with the same integration; C = 0 is the rod that does not stretch or shear,
// without a penalty.
//
// Interpolation (Romero 2004, Comput. Mech. 34; Sander 2010, IJNME 81): r = sum N_i r_i and R = R(p), p = sum N_i q_i.
//
// Unknowns of an element, in this order: for each node displacement (base frame) and rotation vector (section frame,
// q <- q exp(rotation)), for each Gauss point the force (section frame): 6 nodes + 3 points numbers.
#pragma once

#include "fem_reference/beam_model.h"

#include <span>

namespace fem_reference {

constexpr int max_unknowns = 6 * max_nodes + 3 * max_points;

using ElementResidual = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_unknowns, 1>;

struct ElementSystem {
  ElementResidual residual;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, max_unknowns, max_unknowns> tangent;
};

// Nodal values of one element, first node to last.
struct ElementState {
  std::span<const Eigen::Vector3d> position_B;
  std::span<const Quaternion> rotation_BS;
  std::span<const Eigen::Vector3d> force_S;
};

// Element e's part of the rod's state, which must outlive it.
ElementState state_of_element(const BeamModel& model, const BeamState& state, std::size_t e);

// Internal minus external force of an element under load_factor times its loads.
void element_residual(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                      double load_factor, ElementResidual& residual);

// The same and its derivative by the unknowns.
void element_system(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                    double load_factor, ElementSystem& system);

// Strains at Gauss point g, v from the motion, not from n.
SectionStrain element_strain(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                             int g);

// A section anywhere in an element, 0 <= x <= 1, by the element's shape functions.
struct SectionState {
  Eigen::Vector3d position_B;
  Eigen::Matrix3d rotation_BS;
  SectionStrain strain;
};
SectionState section_at(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                        double x);

// Force and moment (base frame) on the two ends of an element whose residual this is, from outside of it, but for its
// distributed loads: minus the total internal ones at the start, and the total internal ones at the end. They balance
// the loads as the nodes' equilibrium does, to round-off, whatever the size of the element.
struct EndWrenches {
  Eigen::Vector3d start_force_B, start_moment_B;
  Eigen::Vector3d end_force_B, end_moment_B;
};
EndWrenches end_wrenches(const ReferenceElement& reference, const ElementState& state, const ElementResidual& residual);

// What a point load adds to the residual of its node (force; moment in the section frame) and to the tangent.
struct NodalSystem {
  Eigen::Matrix<double, 6, 1> residual;
  Eigen::Matrix<double, 6, 6> tangent;
};
NodalSystem nodal_system(const NodalLoad& load, const Quaternion& rotation_BS, double load_factor);

}  // namespace fem_reference
