// How the step of a coupled law over one arc varies: with the wrench and the forces that it meets at its distal end,
// and with its section's constants.
#pragma once

#include "fam/arc_step.h"
#include "fam/dual.h"
#include "fam/law.h"
#include "fam/tendon.h"

#include "scene/rod_model.h"
#include "scene/span.h"

#include <array>
#include <span>

namespace fam {

// A vector with slopes, a row for each of its components, and its parts.
template <int N>
using Slopes3 = Eigen::Matrix<double, 3, N>;
template <int N>
Vector3<Dual<N>> with_slopes(const Vector3d& value, const Slopes3<N>& slopes) {
  Vector3<Dual<N>> result;
  for (int i = 0; i < 3; ++i) result[i] = {value[i], slopes.row(i).transpose().array()};
  return result;
}
template <int N>
Vector3d value(const Vector3<Dual<N>>& v) {
  return {v[0].value, v[1].value, v[2].value};
}
template <int N>
Slopes3<N> slopes_of(const Vector3<Dual<N>>& v) {
  Slopes3<N> slopes;
  for (int i = 0; i < 3; ++i) slopes.row(i) = v[i].slope.matrix().transpose();
  return slopes;
}

// BasicArcConstants<3> in numbers that may vary, whose tendons another keeps.
template <class Parameter>
struct VariedConstants {
  double length_mm = 0;
  Vector3<Parameter> angular_compliance, rest_rotation, linear_compliance;
  Vector3d rest_translation_mm = Vector3d::Zero();
  std::span<const BasicTendon<3, Parameter>> tendons;
};

// Of a length of a span.
template <class Parameter>
VariedConstants<Parameter> varied_constants(const scene::Span& span, double length_mm, scene::RodModel model);

// What an arc does, in its distal frame: Q, from the distal end's axes to the proximal one's; the way from the proximal
// end to the distal one; the force and the moment about the distal end that distributed forces add. Slopes of a small
// turn of the distal end from the proximal one, of the way, and of that force and moment (rows 0-2, 3-5, 6-8, 9-11).
template <int N>
struct ArcVariation {
  RigidMotion motion;  // Q
  Vector3d way_D_mm;
  SectionWrench gain_D;
  Eigen::Matrix<double, 12, N> slopes;
};

// The wrench is that at the distal end; `distributed`: null without such forces.
template <int N, class Parameter>
ArcVariation<N> vary_arc(Law law, scene::RodModel model, const VariedConstants<Parameter>& constants,
                         const ArcForces<Dual<N>, 3>* distributed, const BasicWrench<Dual<N>, 3>& wrench);

// Strain times the arc's length.
BasicScrew<Dual<3>, 3> varied_strain(scene::RodModel model, const VariedConstants<Dual<3>>& constants,
                                     const BasicWrench<Dual<3>, 3>& wrench);

}  // namespace fam
