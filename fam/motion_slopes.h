// How an arc's motion, the exponential of its screw, varies with the screw, and the wrench that it carries with it.
#pragma once

#include "fam/changes.h"
#include "fam/dual.h"
#include "fam/embedding.h"
#include "fam/wide.h"

namespace fam {

// What an arc's screw makes of its own changes, and of those of the wrench at the proximal end: the turn and the way
//   turn = (1 - B [w] + C [w]^2) dw,    way_D = (1 - B [w] + C [w]^2) d,
// and the gain, that wrench carried back, less the one at the distal end.
template <int D, class T = double>
class MotionSlopes {
 public:
  explicit MotionSlopes(const BasicScrew<T, D>& screw) : w_(screw.rotation), d_(screw.translation_mm) {
    const BasicCoefficients<Dual<1>> k = screw_coefficients(Dual<1>(w_.dot(w_), Dual<1>::Slope::Ones()));
    B_ = k.B.value;
    C_ = k.C.value;
    wd_ = fam::cross(w_, d_);
    const Vector<T, D> wwd = fam::cross(w_, wd_);
    by_squared_ = T(k.C.slope[0]) * wwd - T(k.B.slope[0]) * wd_;
    motion_ = {w_, d_ + (T(B_) * wd_ + T(C_) * wwd), k.A.value, B_};
    way_ = d_ + (T(C_) * wwd - T(B_) * wd_);
  }
  RigidMotion motion() const {
    return {embedded_angular(narrow(w_)), embedded(narrow(motion_.position_mm)), motion_.A, motion_.B};
  }
  Vector3d way_mm() const { return embedded(narrow(way_)); }

  template <class V>
  Changes3<V> turn(const ScrewChanges<V>& screw) const {
    const Changes3<V> turned = cross(w_, screw.rotation);
    return screw.rotation + (C_ * cross(w_, turned) + -B_ * turned);
  }
  template <class V>
  Changes3<V> way(const ScrewChanges<V>& screw) const {
    const Changes3<V> along = cross(w_, screw.translation) + cross(screw.rotation, d_);
    return screw.translation + (C_ * (cross(w_, along) + cross(screw.rotation, wd_)) + -B_ * along) +
           by_angle(screw.rotation);
  }

  void meet(const BasicWrench<T, D>& proximal) {
    force_ = motion_.rotate_back(proximal.force_N);
    if constexpr (D == 3) moment_ = motion_.rotate_back(proximal.moment_Nmm);
    else moment_ = proximal.moment_Nmm;
  }
  SectionWrench gain(const SectionWrench& distal) const {
    const Angular<T, D> moment = moment_ - Angular<T, D>(arm_cross(way_, force_));
    return {embedded(narrow(force_)) - distal.force_N, embedded_angular(narrow(moment)) - distal.moment_Nmm};
  }
  template <class V>
  Changes3<V> carried_force(const Changes3<V>& proximal_force, const Changes3<V>& turn) const {
    return rotate_back(proximal_force) + cross(force_, turn);
  }
  template <class V>
  Changes3<V> carried_moment(const Changes3<V>& proximal_moment, const Changes3<V>& carried_force,
                             const Changes3<V>& turn, const Changes3<V>& way) const {
    return rotate_back(proximal_moment) + cross(moment_, turn) + cross(force_, way) + -1.0 * cross(way_, carried_force);
  }

 private:
  template <class V>
  Changes3<V> rotate_back(const Changes3<V>& x) const {
    const Changes3<V> wx = cross(w_, x);
    return x + (B_ * cross(w_, wx) + -motion_.A * wx);
  }

  // By the change of the angle's square.
  template <class V>
  Changes3<V> by_angle(const Changes3<V>& turn) const {
    const Vector<T, D>& by = by_squared_;
    if constexpr (D == 2) {
      const V squared = 2 * w_[0] * turn.z;
      return {by[0] * squared, by[1] * squared, V{}};
    } else {
      const V squared = 2.0 * (w_[0] * turn.x + w_[1] * turn.y + w_[2] * turn.z);
      return {by[0] * squared, by[1] * squared, by[2] * squared};
    }
  }

  Angular<T, D> w_, moment_;
  Vector<T, D> d_, wd_, by_squared_, way_, force_;
  double B_, C_;
  BasicMotion<T, D> motion_;
};

}  // namespace fam
