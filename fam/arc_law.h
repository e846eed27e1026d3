// Arc laws: which strain does an arc get from the wrench at its distal end? One struct a law and one list of them: to
// add one takes an enumerator (fam/law.h), a struct and its place in the list.
#pragma once

#include "fam/arc_section.h"
#include "fam/arc_series.h"
#include "fam/arc_step.h"
#include "fam/law.h"
#include "fam/published_arc.h"
#include "fam/vector_unit.h"

namespace fam {

// The paper's law as reconstructed in docs/theory.md. Second order in h for planar scenes, first order
// in 3D with torsion. Kirchhoff rods with one bending stiffness, point loads that follow, in space (published_arc.h).
struct Published {
  static constexpr LawFacts facts{Law::published, "published", 1, false, false};
};

// Strain at the wrench carried half an arc towards the clamp.
struct Midpoint {
  static constexpr LawFacts facts{Law::midpoint, "midpoint", 2, true, false};
  template <class Section, class T, int D>
  static BasicMotion<T, D> step(Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                BasicScrew<T, D>& screw) {
    return midpoint_step(section, forces, wrench, screw);
  }
};

// A Runge-Kutta-Munthe-Kaas step on SE(3) (Munthe-Kaas 1999; Iserles et al., Acta Numerica 2000).
struct FourthOrder {
  static constexpr LawFacts facts{Law::fourth_order, "fourth_order", 4, true, false};
  template <class Section, class T, int D>
  static BasicMotion<T, D> step(Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                BasicScrew<T, D>& screw) {
    return fourth_order_step(section, forces, wrench, screw);
  }
};

// The strain's Taylor series at the distal end, summed up by the Magnus expansion of order six (Blanes, Casas, Ros, BIT
// 40, 2000). No more dear than fourth_order: the rod equations are quadratic, so that the series is a recursion of
// cross products, and the arc takes a single exponential.
struct SixthOrder {
  static constexpr LawFacts facts{Law::sixth_order, "sixth_order", 6, true, true};
  template <class Section, class T, int D>
  static BasicMotion<T, D> step(Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                BasicScrew<T, D>& screw) {
    return sixth_order_step(section, forces, wrench, screw);
  }
};

template <class... Laws>
struct LawList {};
using AllLaws = LawList<Published, Midpoint, FourthOrder, SixthOrder>;
using AutomaticLaw = SixthOrder;

// visit(struct of the law); the last of the list where none before it is meant. Not always_inline: GCC would then
// flatten nothing that calls it (twice the time of a boundary value problem).
template <class Visit, class First, class... Rest>
auto visit_law(Law law, Visit&& visit, LawList<First, Rest...>) {
  if constexpr (sizeof...(Rest) == 0) {
    return visit(First{});
  } else {
    if (law == First::facts.law) return visit(First{});
    return visit_law(law, visit, LawList<Rest...>{});
  }
}
template <class Visit>
auto visit_law(Law law, Visit&& visit) {
  return visit_law(law, visit, AllLaws{});
}

// The step of a coupled law.
template <class Section, class T, int D>
BasicMotion<T, D> law_step(Law law, Section&& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                           BasicScrew<T, D>& screw) {
  return visit_law(law, [&](auto chosen_law) -> BasicMotion<T, D> {
    if constexpr (chosen_law.facts.coupled) return chosen_law.step(section, forces, wrench, screw);
    else __builtin_unreachable();
  });
}

// The same in an elastic section in space. Compiled apart for AVX2 (elastic_step.cpp).
template <bool with_shear>
RigidMotion elastic_step(Law law, const ArcConstants& arc, const ArcForces<double, 3>* forces, SectionWrench& wrench,
                         Screw& screw, VectorUnit unit = widest_unit());

// The same in a section with tendons; `collapsed` is set where one has no length. Compiled apart (tendon_step.cpp):
// beside the elastic laws it would keep the compiler from inlining those, at 1.1 to 1.4 times the time of a solve.
template <bool with_shear, class T, int D>
BasicMotion<T, D> tendon_step(Law law, const BasicArcConstants<D>& arc, const ArcForces<T, D>* forces,
                              BasicWrench<T, D>& wrench, BasicScrew<T, D>& screw, bool& collapsed,
                              VectorUnit unit = widest_unit());

// The series of an arc (fam/arc_series.h) in an elastic section in space, by elastic_step.cpp.
template <bool with_shear, std::size_t terms>
RodSeries<double, 3, terms> elastic_series(const ArcConstants& arc, const ArcForces<double, 3>* forces,
                                           const SectionWrench& wrench, VectorUnit unit = widest_unit());

// part_step in space, by elastic_step.cpp.
template <bool with_shear>
RigidMotion step_of_part(const RodSeries<double, 3, 7>& series, double part, bool distributed, SectionWrench& wrench,
                         VectorUnit unit = widest_unit());

// The series of an arc in any section; where that does not give way its translation is (h, 0, 0), 0 ...
template <bool with_shear, std::size_t terms, int D>
RodSeries<double, D, terms> series_of(const BasicArcConstants<D>& arc, const ArcForces<double, D>* forces,
                                      const BasicWrench<double, D>& wrench, VectorUnit unit = widest_unit());

}  // namespace fam
