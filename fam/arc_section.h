// What an arc knows of its section, and the strain there under a wrench.
#pragma once

#include "fam/tendon.h"

#include "scene/rod_model.h"
#include "scene/span.h"

#include <span>
#include <vector>

namespace fam {

// What an arc of one span needs to know; products with the arc length h are taken once. In the plane (D = 2) the
// bending is about z.
template <int D>
struct BasicArcConstants {
  double length_mm = 0;                                                // h
  Angular<double, D> angular_compliance = Angular<double, D>::Zero();  // h / (GJ, EI_y, EI_z)
  Angular<double, D> rest_rotation = Angular<double, D>::Zero();      // h (u0 + moment of straight tendons / stiffness)
  Vector<double, D> linear_compliance = Vector<double, D>::Zero();    // h / (EA, kGA_y, kGA_z); 0: does not give way
  Vector<double, D> rest_translation_mm = Vector<double, D>::Zero();  // h e_x
  std::span<const BasicTendon<D>> tendons;                            // of the span that the arc lies in (SpanArcs)
  bool straight_tendons = false;  // along e_x whatever the strain: their moment is in rest_rotation

  bool is_elastic() const { return tendons.empty() || straight_tendons; }
};
using ArcConstants = BasicArcConstants<3>;

// The components of a vector in space, or of a turn, that a rod in the x-y plane has.
template <int D>
Vector<double, D> linear_part(const Vector3d& v) {
  return v.head<D>();
}
template <int D>
Angular<double, D> angular_part(const Vector3d& w) {
  return w.tail<rotations_of(D)>();
}

using scene::RodModel;

// A span's loads, rest curvature and compliances 1/GJ, 1/EI on the straight line from those that it had to those that
// it gets; all else of the two is the same. share: 0 to 1.
struct SpanOnWay {
  const scene::Span& from;
  const scene::Span& to;
  double share = 1;

  template <class V>
  V between(const V& a, const V& b) const {
    return share == 1 ? b : V(a + share * (b - a));
  }
};

// Constants of an arc of this length, whose tendons stand in a list of the caller's.
template <int D>
void set_constants(BasicArcConstants<D>& arc, std::vector<BasicTendon<D>>& tendons, const SpanOnWay& span,
                   double length_mm, RodModel model);
// Of those, what depends on the share.
template <int D>
void set_share(BasicArcConstants<D>& arc, std::vector<BasicTendon<D>>& tendons, const SpanOnWay& span, RodModel model);

// What a law asks of a section: the strain times h under a wrench, and the coefficients of its series along an arc.
// This one is elastic, without tendons (theirs: fam/tendon.h); a Kirchhoff rod keeps the rest translation.
template <bool with_shear, class T, int D>
class ElasticSection {
 public:
  static constexpr bool gives_way = with_shear;
  explicit ElasticSection(const BasicArcConstants<D>& arc) : arc_(arc) {}

  BasicScrew<T, D> strain(const BasicWrench<T, D>& wrench) const {
    BasicScrew<T, D> screw{as<T>(arc_.rest_rotation) + give(arc_.angular_compliance, wrench.moment_Nmm),
                           as<T>(arc_.rest_translation_mm)};
    if constexpr (with_shear) {
      screw.translation_mm += give(arc_.linear_compliance, wrench.force_N);
    }
    return screw;
  }
  void begin_series(const BasicScrew<T, D>&) const {}
  void next(std::size_t, const Angular<T, D>& moment_Nmm, const Vector<T, D>& force_N, Angular<T, D>& rotation,
            Vector<T, D>& translation_mm) const {
    rotation = give(arc_.angular_compliance, moment_Nmm);
    if constexpr (with_shear) translation_mm = give(arc_.linear_compliance, force_N);
  }
  bool collapsed() const { return false; }

 private:
  template <class Compliance, class V>
  static V give(const Compliance& compliance, const V& by) {
    return as<Factor<T>>(compliance).cwiseProduct(by);
  }

  const BasicArcConstants<D>& arc_;
};

// Strain times h in any section under a wrench.
template <bool with_shear, int D>
BasicScrew<double, D> strain_under(const BasicArcConstants<D>& arc, const BasicWrench<double, D>& wrench);

}  // namespace fam
