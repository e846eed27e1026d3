// The step of sixth order in a section of Wide numbers, between doubles.
#pragma once

#include "fam/arc_series.h"
#include "fam/wide.h"

namespace fam {

// visit(forces), the null pointer where there are none: told apart before the step is compiled, not in it.
template <class Visit>
auto visit_wide(const ArcForces<double, 3>* forces, Visit&& visit) {
  if (!forces) return visit(static_cast<const ArcForces<Wide, 3>*>(nullptr));
  const ArcForces<Wide, 3> wide_forces{Wide3::from(forces->follower_S_N), Wide3::from(forces->fixed_D_N)};
  return visit(&wide_forces);
}

inline RigidMotion narrow(const BasicMotion<Wide, 3>& motion) {
  return {motion.rotation.narrow(), motion.position_mm.narrow(), motion.A, motion.B};
}

template <class Section>
RigidMotion wide_step(Section&& section, const ArcForces<double, 3>* forces, SectionWrench& wrench, Screw& screw) {
  BasicWrench<Wide, 3> wide_wrench = wide(wrench);
  BasicScrew<Wide, 3> wide_screw;
  const BasicMotion<Wide, 3> motion = visit_wide(forces, [&](const ArcForces<Wide, 3>* wide_forces) {
    return sixth_order_step(section, wide_forces, wide_wrench, wide_screw);
  });
  wrench = narrow(wide_wrench);
  screw = narrow(wide_screw);
  return narrow(motion);
}

template <std::size_t terms, class Section>
RodSeries<double, 3, terms> wide_series(Section&& section, const ArcForces<double, 3>* forces,
                                        const SectionWrench& wrench) {
  return visit_wide(forces, [&](const ArcForces<Wide, 3>* wide_forces) {
    const RodSeries<Wide, 3, terms> series = rod_series<terms>(section, wide_forces, wide(wrench));
    RodSeries<double, 3, terms> result;
    for (std::size_t k = 0; k < terms; ++k) {
      result.rotation[k] = series.rotation[k].narrow();
      result.moment_Nmm[k] = series.moment_Nmm[k].narrow();
      if (std::remove_cvref_t<Section>::gives_way || k == 0)
        result.translation_mm[k] = series.translation_mm[k].narrow();
      result.force_N[k] = series.force_N[k].narrow();
    }
    return result;
  });
}

template <bool with_shear, std::size_t terms>
RodSeries<Wide, 3, terms> wide(const RodSeries<double, 3, terms>& series) {
  RodSeries<Wide, 3, terms> s;
  for (std::size_t k = 0; k < terms; ++k) {
    s.rotation[k] = Wide3::from(series.rotation[k]);
    s.translation_mm[k] = with_shear || k == 0 ? Wide3::from(series.translation_mm[k]) : Wide3::Zero();
    s.force_N[k] = Wide3::from(series.force_N[k]);
    s.moment_Nmm[k] = Wide3::from(series.moment_Nmm[k]);
  }
  return s;
}

template <bool with_shear>
RigidMotion wide_part_step(const RodSeries<double, 3, 7>& series, double part, bool distributed,
                           SectionWrench& wrench) {
  BasicWrench<Wide, 3> wide_wrench = wide(wrench);
  const BasicMotion<Wide, 3> motion = part_step<with_shear>(series, Wide(part), distributed, wide_wrench);
  wrench = narrow(wide_wrench);
  return narrow(motion);
}

}  // namespace fam
