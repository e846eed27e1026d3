// Residual and tangent of one element and of one nodal load.
//
// The element is the stationary point of the Hellinger-Reissner functional, dimensionless as in beam_model.h,
//   sum over Gauss points of  w [ n . (v - e_x) - 1/2 n . C n + 1/2 (u - u_rest) . K_u (u - u_rest) ]  -  load work
// with the internal force n (section frame) as an unknown of its own at each Gauss point. Where C > 0 this is the
// displacement element with the same integration; C = 0 is the rod that does not stretch or shear, without a penalty.
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

struct ElementSystem {
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_unknowns, 1> residual;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_unknowns, max_unknowns> tangent;
};

// Nodal values of one element, first node to last.
struct ElementState {
  std::span<const Eigen::Vector3d> position_B;
  std::span<const Quaternion> rotation_BS;
  std::span<const Eigen::Vector3d> force_S;
};

// Element e's part of the rod's state, which must outlive it.
ElementState state_of_element(const BeamModel& model, const BeamState& state, std::size_t e);

// Internal minus external force of an element under load_factor times its loads, and its derivative by the unknowns.
void element_system(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                    double load_factor, ElementSystem& system);

// Strains at Gauss point g: v (before any compliance) and u, section frame.
struct SectionStrain {
  Eigen::Vector3d v;
  Eigen::Vector3d u;
};
SectionStrain element_strain(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                             int g);

// What a point load adds to the residual of its node (force; moment in the section frame) and to the tangent.
struct NodalSystem {
  Eigen::Matrix<double, 6, 1> residual;
  Eigen::Matrix<double, 6, 6> tangent;
};
NodalSystem nodal_system(const NodalLoad& load, const Quaternion& rotation_BS, double load_factor);

}  // namespace fem_reference
