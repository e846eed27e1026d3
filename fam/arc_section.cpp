#include "fam/arc_section.h"

#include "fam/load_length.h"

namespace fam {

template <int D>
BasicArcConstants<D> arc_constants(const scene::Span& span, int arcs, RodModel model, double load_factor) {
  const scene::Stiffness& stiffness = span.stiffness;
  const double h = span.length_mm() / arcs;
  const Vector3d bending_and_torsion(stiffness.torsion_Nmm2, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1]);

  BasicArcConstants<D> arc;
  arc.length_mm = h;
  arc.angular_compliance = h * angular_part<D>(bending_and_torsion.cwiseInverse());
  arc.rest_rotation = h * angular_part<D>(span.rest_curvature_per_mm);
  arc.rest_translation_mm[0] = h;
  if (model == RodModel::reissner) {
    Vector3d compliance = Vector3d::Zero();
    if (stiffness.axial_N) compliance[0] = h / *stiffness.axial_N;
    if (stiffness.shear_N) compliance.tail<2>() = h * stiffness.shear_N->cwiseInverse();
    arc.linear_compliance = linear_part<D>(compliance);
  }
  set_tendons(arc, span, model, load_factor);
  return arc;
}

template <int D>
void set_tendons(BasicArcConstants<D>& arc, const scene::Span& span, RodModel model, double load_factor) {
  arc.straight_tendons = D == 2 && model == RodModel::kirchhoff;
  if (arc.straight_tendons) {
    arc.rest_rotation =
        arc.length_mm * angular_part<D>(span.rest_curvature_per_mm) +
        load_factor * arc.angular_compliance.cwiseProduct(angular_part<D>(straight_tendons(span).moment_Nmm));
  }
  arc.tendons.clear();
  if (load_factor == 0) return;
  for (const scene::SectionTendon& tendon : span.tendons) {
    arc.tendons.push_back({linear_part<D>(tendon.arm_S_mm), load_factor * tendon.tension_N});
  }
}

template BasicArcConstants<2> arc_constants(const scene::Span&, int, RodModel, double);
template BasicArcConstants<3> arc_constants(const scene::Span&, int, RodModel, double);
template void set_tendons(BasicArcConstants<2>&, const scene::Span&, RodModel, double);
template void set_tendons(BasicArcConstants<3>&, const scene::Span&, RodModel, double);

}  // namespace fam
