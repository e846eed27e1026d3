// The arc laws in elastic sections in space.
#include "fam/arc_law.h"
#include "fam/wide_step.h"

namespace fam {
namespace {

template <bool with_shear>
FAM_FLATTEN [[gnu::noinline]] RigidMotion step(Law law, const ArcConstants& arc, const ArcForces<double, 3>* forces,
                                               SectionWrench& wrench, Screw& screw) {
  return law_step(law, ElasticSection<with_shear, double, 3>(arc), forces, wrench, screw);
}

}  // namespace

template <bool with_shear>
RigidMotion elastic_step(Law law, const ArcConstants& arc, const ArcForces<double, 3>* forces, SectionWrench& wrench,
                         Screw& screw, [[maybe_unused]] VectorUnit unit) {
#ifdef FAM_HAS_AVX2_UNIT
  if (unit == VectorUnit::avx2 && law == Law::sixth_order)
    return call_by_avx2([&] { return wide_step(ElasticSection<with_shear, Wide, 3>(arc), forces, wrench, screw); });
#endif
  return step<with_shear>(law, arc, forces, wrench, screw);
}

template <bool with_shear, std::size_t terms>
RodSeries<double, 3, terms> elastic_series(const ArcConstants& arc, const ArcForces<double, 3>* forces,
                                           const SectionWrench& wrench, [[maybe_unused]] VectorUnit unit) {
#ifdef FAM_HAS_AVX2_UNIT
  if (unit == VectorUnit::avx2)
    return call_by_avx2([&] { return wide_series<terms>(ElasticSection<with_shear, Wide, 3>(arc), forces, wrench); });
#endif
  return rod_series<terms>(ElasticSection<with_shear, double, 3>(arc), forces, wrench);
}

template <bool with_shear>
RigidMotion step_of_part(const RodSeries<double, 3, 7>& series, double part, bool distributed, SectionWrench& wrench,
                         [[maybe_unused]] VectorUnit unit) {
#ifdef FAM_HAS_AVX2_UNIT
  if (unit == VectorUnit::avx2)
    return call_by_avx2([&] { return wide_part_step<with_shear>(series, part, distributed, wrench); });
#endif
  return part_step<with_shear>(series, part, distributed, wrench);
}

#define FAM_ELASTIC(with_shear)                                                                                        \
  template RigidMotion elastic_step<with_shear>(Law, const ArcConstants&, const ArcForces<double, 3>*, SectionWrench&, \
                                                Screw&, VectorUnit);                                                   \
  template RodSeries<double, 3, 6> elastic_series<with_shear, 6>(const ArcConstants&, const ArcForces<double, 3>*,     \
                                                                 const SectionWrench&, VectorUnit);                    \
  template RodSeries<double, 3, 7> elastic_series<with_shear, 7>(const ArcConstants&, const ArcForces<double, 3>*,     \
                                                                 const SectionWrench&, VectorUnit);                    \
  template RigidMotion step_of_part<with_shear>(const RodSeries<double, 3, 7>&, double, bool, SectionWrench&,          \
                                                VectorUnit);
FAM_ELASTIC(true)
FAM_ELASTIC(false)

}  // namespace fam
