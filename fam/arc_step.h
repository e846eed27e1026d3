// Runge-Kutta steps over one arc, from its distal to its proximal end.
#pragma once

#include "fam/screw.h"

namespace fam {

// Distributed forces on an arc, times h. Both are constant along it: one in the section frame, one in the base frame,
// of which the components in the arc's distal frame D are known when the arc is met.
template <class T, int D>
struct ArcForces {
  Vector<T, D> follower_S_N, fixed_D_N;
};

// The steps of the laws set the arc's screw, carry the wrench from its distal to its proximal end and return the arc's
// motion. Without distributed forces (the null pointer) the wrench is carried exactly, whatever the strain.
//
// Under distributed forces the wrench, carried back to the distal frame, changes along the arc: its rate is the force
// and the force's moment about the distal end. The Runge-Kutta laws advance screw and wrench together by the same
// steps, on the group SE(3) x R^6.
template <class T, int D>
BasicWrench<T, D> wrench_rate(const ArcForces<T, D>& forces, const BasicMotion<T, D>& motion) {
  const Vector<T, D> force = forces.fixed_D_N + motion.rotate_back(forces.follower_S_N);
  return {force, -arm_cross(motion.rotate_back(motion.position_mm), force)};
}

template <class Section, class T, int D>
BasicMotion<T, D> midpoint_step(Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                BasicScrew<T, D>& screw) {
  const BasicScrew<T, D> k1 = section.strain(wrench);
  const BasicMotion<T, D> half = exponential(0.5 * k1);
  BasicWrench<T, D> middle = wrench;
  if (forces) {
    middle = wrench + 0.5 * wrench_rate(*forces, exponential(BasicScrew<T, D>{}));
    wrench = wrench + wrench_rate(*forces, half);
  }
  screw = section.strain(transport(half, middle));
  BasicMotion<T, D> motion = exponential(screw);
  wrench = transport(motion, wrench);
  return motion;
}

template <class Section, class T, int D>
BasicMotion<T, D> fourth_order_step(Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                    BasicScrew<T, D>& screw) {
  const auto advanced = [&](double factor, const BasicMotion<T, D>& motion, BasicWrench<T, D>& rate) {
    if (!forces) return wrench;
    rate = wrench_rate(*forces, motion);
    return wrench + factor * rate;
  };
  BasicWrench<T, D> l1, l2, l3, l4;
  const BasicScrew<T, D> k1 = section.strain(wrench);
  const BasicMotion<T, D> to2 = exponential(0.5 * k1);
  const BasicScrew<T, D> k2 = section.strain(transport(to2, advanced(0.5, exponential(BasicScrew<T, D>{}), l1)));
  const BasicMotion<T, D> to3 = exponential(0.5 * k2 + (-1 / 8.) * bracket(k1, k2));
  const BasicScrew<T, D> k3 = section.strain(transport(to3, advanced(0.5, to2, l2)));
  const BasicMotion<T, D> to4 = exponential(k3);
  const BasicScrew<T, D> k4 = section.strain(transport(to4, advanced(1, to3, l3)));
  screw = (1 / 6.) * (k1 + 2.0 * (k2 + k3) + k4) + (-1 / 12.) * bracket(k1, k4);
  BasicMotion<T, D> motion = exponential(screw);
  if (forces) {
    l4 = wrench_rate(*forces, to4);
    wrench = wrench + (1 / 6.) * (l1 + 2.0 * (l2 + l3) + l4);
  }
  wrench = transport(motion, wrench);
  return motion;
}

}  // namespace fam
