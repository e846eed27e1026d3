// The paper's law once more, for a straight rod of one section loaded at its tip, in any scalar type and with the slips
// that a program may have. Not a part of the library. Without slips it is fam's published law, as the tests show.
#pragma once

#include "fam/published_arc.h"
#include "studies/methods/weakened_arc.h"

#include <type_traits>

namespace studies {

struct ProgramSlips {
  Weakness weakness = {};  // search, its absolute tolerance, single precision, forces not turned
  fam::TwistOrder order = fam::TwistOrder::bend_twist;
  bool without_torsion = false;
  bool distal_plane = false;  // the bending plane from the moment at the arc's distal end, not its proximal one
  bool middle_arm = false;    // the force handed on with the arm to the chord's middle

  bool has_own_search() const {
    return weakness.single_precision || weakness.search != Search::root || weakness.tolerance > 0 ||
           weakness.straight_in_arc;
  }
};

struct TipLoadedRod {
  double length_mm, bending_Nmm2, torsion_Nmm2;
  Eigen::Vector3d force_N, moment_Nmm;  // at the tip, following
};

// Turn by an angle whose sine and cosine are taken in double and rounded, about a unit vector.
template <class T>
Eigen::Matrix<T, 3, 3> turn_about(const Eigen::Matrix<T, 3, 1>& axis, T angle) {
  const T s = static_cast<T>(std::sin(static_cast<double>(angle)));
  const T c = static_cast<T>(std::cos(static_cast<double>(angle)));
  Eigen::Matrix<T, 3, 3> skew;
  skew << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
  return c * Eigen::Matrix<T, 3, 3>::Identity() + s * skew + (1 - c) * axis * axis.transpose();
}

template <class T>
bool bend_angle(T moment, T axial, T normal, T arcs, const ProgramSlips& slips, T& angle) {
  if constexpr (std::is_same_v<T, double>) {
    if (!slips.has_own_search()) return fam::published_angle({moment, axial, normal}, angle);
  }
  angle = PlanarArc<T>{moment, axial, normal, slips.weakness}.angle(arcs);
  return std::isfinite(angle);
}

// The tip in the base frame, mm; false where the angle of an arc was not found.
template <class T>
bool published_tip_in(const TipLoadedRod& rod, int arcs, const ProgramSlips& slips, Eigen::Vector3d& tip_mm) {
  using Vector = Eigen::Matrix<T, 3, 1>;
  using Matrix = Eigen::Matrix<T, 3, 3>;
  const T h = static_cast<T>(rod.length_mm / arcs), compliance = h / static_cast<T>(rod.bending_Nmm2);
  const T twist_compliance = slips.without_torsion ? T(0) : h / static_cast<T>(rod.torsion_Nmm2);
  Vector force = rod.force_N.cast<T>(), moment = rod.moment_Nmm.cast<T>(), tip = Vector::Zero();
  for (int arc = 0; arc < arcs; ++arc) {
    const T lever = slips.distal_plane ? T(0) : h;
    Vector normal(0, moment[1] - lever * force[2], moment[2] + lever * force[1]);
    const T size = normal.norm();
    normal = size > 0 ? Vector(normal / size) : Vector(0, 0, 1);
    T angle = 0;
    if (!bend_angle<T>(compliance * (moment[1] * normal[1] + moment[2] * normal[2]), compliance * h * force[0],
                       compliance * h * (force[1] * normal[2] - force[2] * normal[1]), static_cast<T>(arcs), slips,
                       angle))
      return false;
    const fam::ScrewCoefficients k = fam::screw_coefficients(static_cast<double>(angle) * static_cast<double>(angle));
    const Vector straight(h, 0, 0), across = normal.cross(straight);
    const Vector chord = static_cast<T>(k.A) * straight + static_cast<T>(k.B) * angle * across;
    const Matrix bend = turn_about<T>(normal, angle);
    const Matrix twist = turn_about<T>(Vector::UnitX(), twist_compliance * moment[0]);
    const bool bent_first = slips.order == fam::TwistOrder::bend_twist;
    const Matrix rotation = bent_first ? Matrix(bend * twist) : Matrix(twist * bend);
    const Vector position = bent_first ? chord : Vector(twist * chord);
    tip = position + rotation * tip;
    if (!slips.weakness.straight_to_next) force = rotation * force;
    const Vector arm = slips.middle_arm ? Vector(position / 2) : position;
    moment = rotation * moment + arm.cross(force);
  }
  tip_mm = tip.template cast<double>();
  return tip_mm.allFinite();
}

inline bool published_tip(const TipLoadedRod& rod, int arcs, const ProgramSlips& slips, Eigen::Vector3d& tip_mm) {
  return slips.weakness.single_precision ? published_tip_in<float>(rod, arcs, slips, tip_mm)
                                         : published_tip_in<double>(rod, arcs, slips, tip_mm);
}

}  // namespace studies
