#include "fam/arc_section.h"

#include "fam/load_length.h"

namespace fam {

namespace {

double tension_N(const scene::Span& span, const Vector3d& arm_S_mm) {
  for (const scene::SectionTendon& tendon : span.tendons) {
    if (tendon.arm_S_mm == arm_S_mm) return tendon.tension_N;
  }
  return 0;
}

template <int D>
void set_tendons(std::vector<BasicTendon<D>>& tendons, const SpanOnWay& span) {
  tendons.clear();
  const auto add = [&](const Vector3d& arm_S_mm, double from_N, double to_N) {
    const double tension = span.between(from_N, to_N);
    if (tension > 0) tendons.push_back({linear_part<D>(arm_S_mm), tension});
  };
  for (const scene::SectionTendon& tendon : span.to.tendons) {
    add(tendon.arm_S_mm, tension_N(span.from, tendon.arm_S_mm), tendon.tension_N);
  }
  if (span.share == 1) return;
  for (const scene::SectionTendon& tendon : span.from.tendons) {
    if (tension_N(span.to, tendon.arm_S_mm) == 0) add(tendon.arm_S_mm, tendon.tension_N, 0);
  }
}

Vector3d angular_compliance(const scene::Span& span) {
  const scene::Stiffness& K = span.stiffness;
  return Vector3d(K.torsion_Nmm2, K.bending_Nmm2[0], K.bending_Nmm2[1]).cwiseInverse();
}

}  // namespace

template <int D>
void set_constants(BasicArcConstants<D>& arc, std::vector<BasicTendon<D>>& tendons, const SpanOnWay& span,
                   double length_mm, RodModel model) {
  const scene::Stiffness& stiffness = span.to.stiffness;
  const double h = length_mm;
  arc.length_mm = h;
  arc.rest_translation_mm = h * Vector<double, D>::Unit(0);
  Vector3d compliance = Vector3d::Zero();
  if (model == RodModel::reissner) {
    if (stiffness.axial_N) compliance[0] = h / *stiffness.axial_N;
    if (stiffness.shear_N) compliance.tail<2>() = h * stiffness.shear_N->cwiseInverse();
  }
  arc.linear_compliance = linear_part<D>(compliance);
  set_share(arc, tendons, span, model);
}

template <int D>
void set_share(BasicArcConstants<D>& arc, std::vector<BasicTendon<D>>& tendons, const SpanOnWay& span, RodModel model) {
  arc.angular_compliance =
      arc.length_mm * angular_part<D>(span.between(angular_compliance(span.from), angular_compliance(span.to)));
  arc.straight_tendons = D == 2 && model == RodModel::kirchhoff;
  arc.rest_rotation =
      arc.length_mm * angular_part<D>(span.between(span.from.rest_curvature_per_mm, span.to.rest_curvature_per_mm));
  set_tendons(tendons, span);
  arc.tendons = tendons;
  if (arc.straight_tendons && !(span.from.tendons.empty() && span.to.tendons.empty())) {
    const auto turn = [&](const scene::Span& loaded) -> Angular<double, D> {
      return arc.angular_compliance.cwiseProduct(angular_part<D>(straight_tendons(loaded).moment_Nmm));
    };
    arc.rest_rotation += span.between(turn(span.from), turn(span.to));
  }
}

template void set_constants(BasicArcConstants<2>&, std::vector<BasicTendon<2>>&, const SpanOnWay&, double, RodModel);
template void set_constants(BasicArcConstants<3>&, std::vector<BasicTendon<3>>&, const SpanOnWay&, double, RodModel);
template void set_share(BasicArcConstants<2>&, std::vector<BasicTendon<2>>&, const SpanOnWay&, RodModel);
template void set_share(BasicArcConstants<3>&, std::vector<BasicTendon<3>>&, const SpanOnWay&, RodModel);

}  // namespace fam
