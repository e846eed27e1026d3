// How the step of a coupled law over one arc varies: with the wrench and the forces that it meets at its distal end,
// and with its section's constants. Derivatives of the step itself, not of the rod: exact to round-off.
#pragma once

#include "fam/arc_section.h"
#include "fam/arc_step.h"
#include "fam/law.h"
#include "fam/vector_unit.h"

#include "scene/rod_model.h"

#include <array>
#include <optional>

namespace fam {

// N changes of a vector, a row for each of its components.
template <int N>
using Slopes3 = Eigen::Matrix<double, 3, N, Eigen::RowMajor>;

// N changes of what an arc meets: the wrench at its distal end, its distributed forces (times h, as ArcForces), and of
// its section either nothing, or in the last three changes its rest curvature, its stiffness (GJ, EI_y, EI_z), or the
// tensions of up to three tendons (which need not be among the section's; one that is not given changes nothing).
enum class Constant { none, rest_curvature, stiffness, tension };
using TendonArms = std::array<std::optional<Vector3d>, 3>;  // mm
template <int N>
struct ArcChange {
  Slopes3<N> force_N = Slopes3<N>::Zero(), moment_Nmm = Slopes3<N>::Zero();
  Slopes3<N> follower_S_N = Slopes3<N>::Zero(), fixed_D_N = Slopes3<N>::Zero();
  Constant constant = Constant::none;
  TendonArms tendon_arms{};
};

// One of each component of the wrench, six; N = 9: and of a fixed distributed force. N = 8: room for two of that;
// N = 12: and for three of a constant.
template <int N>
const ArcChange<N>& unit_changes() {
  static const ArcChange<N> changes = [] {
    ArcChange<N> change;
    change.force_N.template leftCols<3>().setIdentity();
    change.moment_Nmm.template middleCols<3>(3).setIdentity();
    if constexpr (N >= 9) change.fixed_D_N.template middleCols<3>(6).setIdentity();
    return change;
  }();
  return changes;
}

// What an arc does, in its distal frame: Q, from the distal end's axes to the proximal one's; the way from the proximal
// end to the distal one; the force and the moment about the distal end that distributed forces add. Slopes of a small
// turn of the distal end from the proximal one, of the way, and of that force and moment (rows 0-2, 3-5, 6-8, 9-11; the
// last six are zero without distributed forces).
template <int N>
struct ArcVariation {
  RigidMotion motion;  // Q
  Vector3d way_D_mm;
  SectionWrench gain_D;
  Eigen::Matrix<double, 12, N> slopes;
};

// `distributed`: null without such forces. N: 3; 6 without, 8, 9 and 12 with them.
template <int N>
ArcVariation<N> vary_arc(Law law, scene::RodModel model, const BasicArcConstants<3>& arc,
                         const ArcForces<double, 3>* distributed, const SectionWrench& wrench,
                         const ArcChange<N>& change, VectorUnit unit = widest_unit());

// By the unit changes, for an arc in the x-y plane by the law of sixth order; the section, in space, has no tendons and
// principal axes along the plane.
template <int N>
ArcVariation<N> vary_planar_arc(scene::RodModel model, const BasicArcConstants<3>& arc,
                                const ArcForces<double, 3>* distributed, const SectionWrench& wrench,
                                VectorUnit unit = widest_unit());

// The section's strain (times h) under a wrench and the tendons' pulls; slopes of (u, v) h and of the pulls' force and
// moment.
struct StrainVariation {
  Screw strain;
  SectionWrench pulls;
  Eigen::Matrix<double, 6, 3> strain_slopes, pull_slopes;
};
StrainVariation vary_strain(scene::RodModel model, const BasicArcConstants<3>& arc, const SectionWrench& wrench,
                            const ArcChange<3>& change);

}  // namespace fam
