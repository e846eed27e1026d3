// The arc laws in sections with tendons, for all numbers that are marched.
#include "fam/arc_law.h"
#include "fam/several_tendons.h"
#include "fam/wide_step.h"

namespace fam {
namespace {

// A section whose Newton's method is compiled once, not wherever a law asks for a strain.
template <class Section>
struct StrainApart : Section {
  using Section::Section;
  [[gnu::noinline]] auto strain(const auto& wrench) { return Section::strain(wrench); }
};

// As flat_step; sections with several tendons would take the compiler minutes.
template <bool with_shear, class T, int D>
FAM_FLATTEN [[gnu::noinline]] BasicMotion<T, D> step(Law law, StrainApart<OneTendonSection<with_shear, T, D>>& section,
                                                     const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                                                     BasicScrew<T, D>& screw) {
  return law_step(law, section, forces, wrench, screw);
}
template <class Section, class T, int D>
BasicMotion<T, D> step(Law law, Section& section, const ArcForces<T, D>* forces, BasicWrench<T, D>& wrench,
                       BasicScrew<T, D>& screw) {
  return law_step(law, section, forces, wrench, screw);
}

template <bool with_shear, class T, int D>
using SeveralSection =
    std::conditional_t<D == 3, SeveralTendonsSection<with_shear, T>, TendonSection<with_shear, T, D>>;

// visit(section) with an arc's tendons.
template <bool with_shear, class T, int D, class Visit>
auto visit_section(const BasicArcConstants<D>& arc, Visit&& visit) {
  if (arc.tendons.size() == 1) {
    StrainApart<OneTendonSection<with_shear, T, D>> section(arc);
    return visit(section);
  }
  SeveralSection<with_shear, T, D> section(arc);
  return visit(section);
}

#ifdef FAM_HAS_AVX2_UNIT
// visit(section) by AVX2.
template <bool with_shear, class Visit>
auto visit_wide_section(const ArcConstants& arc, const Visit& visit) {
  if (arc.tendons.size() == 1) {
    return call_by_avx2([&] {
      OneTendonSection<with_shear, Wide, 3> section(arc);
      return visit(section);
    });
  }
  return call_by_avx2([&] {
    SeveralTendonsSection<with_shear, Wide> section(arc);
    return visit(section);
  });
}
#endif

}  // namespace

template <bool with_shear, class T, int D>
BasicMotion<T, D> tendon_step(Law law, const BasicArcConstants<D>& arc, const ArcForces<T, D>* forces,
                              BasicWrench<T, D>& wrench, BasicScrew<T, D>& screw, bool& collapsed,
                              [[maybe_unused]] VectorUnit unit) {
  const auto collapsing = [&collapsed](const BasicMotion<T, D>& motion, const auto& section) {
    collapsed = collapsed || section.collapsed();
    return motion;
  };
  if constexpr (std::is_same_v<T, double>) {
    // What nothing but its tendons loads has one strain.
    if (!forces && wrench.force_N.isZero(0) && wrench.moment_Nmm.isZero(0)) {
      return visit_section<with_shear, T>(arc, [&](auto& section) {
        screw = section.strain(wrench);
        return collapsing(exponential(screw), section);
      });
    }
  }
#ifdef FAM_HAS_AVX2_UNIT
  if constexpr (D == 3) {
    if (unit == VectorUnit::avx2 && law == Law::sixth_order) {
      return visit_wide_section<with_shear>(
          arc, [&](auto& section) { return collapsing(wide_step(section, forces, wrench, screw), section); });
    }
  }
#endif
  return visit_section<with_shear, T>(
      arc, [&](auto& section) { return collapsing(step(law, section, forces, wrench, screw), section); });
}

template <bool with_shear, std::size_t terms, int D>
RodSeries<double, D, terms> series_of(const BasicArcConstants<D>& arc, const ArcForces<double, D>* forces,
                                      const BasicWrench<double, D>& wrench, [[maybe_unused]] VectorUnit unit) {
  RodSeries<double, D, terms> series;
  if (arc.is_elastic()) {
    if constexpr (D == 3) series = elastic_series<with_shear, terms>(arc, forces, wrench, unit);
    else series = rod_series<terms>(ElasticSection<with_shear, double, D>(arc), forces, wrench);
#ifdef FAM_HAS_AVX2_UNIT
  } else if (D == 3 && unit == VectorUnit::avx2) {
    if constexpr (D == 3) {
      series = visit_wide_section<with_shear>(
          arc, [&](auto& section) { return wide_series<terms>(section, forces, wrench); });
    }
#endif
  } else {
    series = visit_section<with_shear, double>(
        arc, [&](auto& section) { return rod_series<terms>(section, forces, wrench); });
  }
  if constexpr (!with_shear) {
    for (std::size_t k = 1; k < terms; ++k) series.translation_mm[k].setZero();
  }
  return series;
}

template <bool with_shear, int D>
BasicScrew<double, D> strain_under(const BasicArcConstants<D>& arc, const BasicWrench<double, D>& wrench) {
  if (arc.is_elastic()) return ElasticSection<with_shear, double, D>(arc).strain(wrench);
  return visit_section<with_shear, double>(arc, [&](auto& section) { return section.strain(wrench); });
}

#define FAM_TENDON_STEP(with_shear, T, D)                                                                            \
  template BasicMotion<T, D> tendon_step<with_shear, T, D>(Law, const BasicArcConstants<D>&, const ArcForces<T, D>*, \
                                                           BasicWrench<T, D>&, BasicScrew<T, D>&, bool&, VectorUnit);
FAM_TENDON_STEP(true, double, 2)
FAM_TENDON_STEP(true, Dual<1>, 2)
FAM_TENDON_STEP(true, Dual<4>, 2)
FAM_TENDON_STEP(false, double, 2)
FAM_TENDON_STEP(false, Dual<1>, 2)
FAM_TENDON_STEP(false, Dual<4>, 2)
FAM_TENDON_STEP(true, double, 3)
FAM_TENDON_STEP(false, double, 3)
#undef FAM_TENDON_STEP

#define FAM_SERIES(with_shear, terms, D)                                \
  template RodSeries<double, D, terms> series_of<with_shear, terms, D>( \
      const BasicArcConstants<D>&, const ArcForces<double, D>*, const BasicWrench<double, D>&, VectorUnit);
FAM_SERIES(true, 6, 3)
FAM_SERIES(false, 6, 3)
FAM_SERIES(true, 7, 3)
FAM_SERIES(false, 7, 3)
FAM_SERIES(true, 6, 2)
FAM_SERIES(false, 6, 2)
FAM_SERIES(true, 7, 2)
FAM_SERIES(false, 7, 2)
#undef FAM_SERIES

template BasicScrew<double, 2> strain_under<true>(const BasicArcConstants<2>&, const BasicWrench<double, 2>&);
template BasicScrew<double, 2> strain_under<false>(const BasicArcConstants<2>&, const BasicWrench<double, 2>&);
template BasicScrew<double, 3> strain_under<true>(const BasicArcConstants<3>&, const BasicWrench<double, 3>&);
template BasicScrew<double, 3> strain_under<false>(const BasicArcConstants<3>&, const BasicWrench<double, 3>&);

}  // namespace fam
