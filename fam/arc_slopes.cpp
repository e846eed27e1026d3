#include "fam/arc_slopes.h"

#include "fam/arc_law.h"

namespace fam {
namespace {

// An elastic section whose constants may vary.
template <bool with_shear, class T, class Parameter>
class VariedSection {
 public:
  static constexpr bool gives_way = with_shear;
  explicit VariedSection(const VariedConstants<Parameter>& arc) : arc_(arc) {}

  BasicScrew<T, 3> strain(const BasicWrench<T, 3>& wrench) const {
    BasicScrew<T, 3> screw{arc_.rest_rotation.template cast<T>(), arc_.rest_translation_mm.template cast<T>()};
    screw.rotation += arc_.angular_compliance.template cast<T>().cwiseProduct(wrench.moment_Nmm);
    if constexpr (with_shear) {
      screw.translation_mm += arc_.linear_compliance.template cast<T>().cwiseProduct(wrench.force_N);
    }
    return screw;
  }
  void begin_series(const BasicScrew<T, 3>&) const {}
  void next(std::size_t, const Vector3<T>& moment_Nmm, const Vector3<T>& force_N, Vector3<T>& rotation,
            Vector3<T>& translation_mm) const {
    rotation = arc_.angular_compliance.template cast<T>().cwiseProduct(moment_Nmm);
    if constexpr (with_shear) translation_mm = arc_.linear_compliance.template cast<T>().cwiseProduct(force_N);
  }

 private:
  const VariedConstants<Parameter>& arc_;
};

template <int N>
Slopes3<N> cross(const Vector3d& a, const Slopes3<N>& b) {
  Slopes3<N> result;
  result.row(0) = a[1] * b.row(2) - a[2] * b.row(1);
  result.row(1) = a[2] * b.row(0) - a[0] * b.row(2);
  result.row(2) = a[0] * b.row(1) - a[1] * b.row(0);
  return result;
}
template <int N>
Slopes3<N> cross(const Slopes3<N>& a, const Vector3d& b) {
  return -cross<N>(b, a);
}

// The inverse exponential's factors and those of the way back, differentiated by hand: with w and d of the screw,
//   turn = (1 - B [w] + C [w]^2) dw,    way_D = (1 - B [w] + C [w]^2) d.
template <int N>
void vary_motion(const Vector3d& w, const Vector3d& d, const Slopes3<N>& dw, const Slopes3<N>& dd,
                 ArcVariation<N>& result) {
  const double squared = w.dot(w);
  const BasicCoefficients<Dual<1>> k =
      screw_coefficients(Dual<1>(squared, Dual<1>::Slope::Constant(1)));  // slopes by the angle squared
  const double A = k.A.value, B = k.B.value, C = k.C.value;
  const Vector3d wd = w.cross(d), wwd = w.cross(wd);
  result.motion = {w, d + (B * wd + C * wwd), A, B};
  result.way_D_mm = d + (C * wwd - B * wd);

  const Slopes3<N> turned = cross<N>(w, dw);
  result.slopes.template topRows<3>() = dw + (C * cross<N>(w, turned) - B * turned);
  const Slopes3<N> along = cross<N>(dw, d) + cross<N>(w, dd);
  const Eigen::Matrix<double, 1, N> d_squared = 2 * w.transpose() * dw;
  result.slopes.template middleRows<3>(3) = dd - B * along + C * (cross<N>(dw, wd) + cross<N>(w, along)) +
                                            (k.C.slope[0] * wwd - k.B.slope[0] * wd) * d_squared;
}

// The wrench at the proximal end, carried back: what distributed forces added.
template <int N>
void vary_gain(const SectionWrench& distal, const Slopes3<N>& d_force, const Slopes3<N>& d_moment,
               const BasicWrench<Dual<N>, 3>& proximal, ArcVariation<N>& result) {
  const auto rotate_back = [&result](const Slopes3<N>& v) {
    Slopes3<N> back;
    for (int i = 0; i < N; ++i) back.col(i) = result.motion.rotate_back(v.col(i));
    return back;
  };
  const Slopes3<N> turn = result.slopes.template topRows<3>(), way = result.slopes.template middleRows<3>(3);
  const Vector3d force = result.motion.rotate_back(value<N>(proximal.force_N));
  const Vector3d moment = result.motion.rotate_back(value<N>(proximal.moment_Nmm));
  result.gain_D = {force - distal.force_N, moment - result.way_D_mm.cross(force) - distal.moment_Nmm};
  const Slopes3<N> force_slopes = rotate_back(slopes_of<N>(proximal.force_N)) - cross<N>(turn, force);
  const Slopes3<N> moment_slopes = rotate_back(slopes_of<N>(proximal.moment_Nmm)) - cross<N>(turn, moment);
  result.slopes.template middleRows<3>(6) = force_slopes - d_force;
  result.slopes.template bottomRows<3>() =
      moment_slopes - cross<N>(way, force) - cross<N>(result.way_D_mm, force_slopes) - d_moment;
}

template <bool with_shear, int N, class Parameter>
ArcVariation<N> vary(Law law, const VariedConstants<Parameter>& constants, const ArcForces<Dual<N>, 3>* distributed,
                     const BasicWrench<Dual<N>, 3>& distal) {
  BasicWrench<Dual<N>, 3> wrench = distal;
  BasicScrew<Dual<N>, 3> screw;
  if (constants.tendons.empty()) {
    law_step(law, VariedSection<with_shear, Dual<N>, Parameter>(constants), distributed, wrench, screw);
  } else {
    TendonSection<with_shear, Dual<N>, 3, Parameter> section(constants);
    law_step(law, section, distributed, wrench, screw);
  }
  ArcVariation<N> result;
  vary_motion<N>(value<N>(screw.rotation), value<N>(screw.translation_mm), slopes_of<N>(screw.rotation),
                 slopes_of<N>(screw.translation_mm), result);
  if (distributed) {
    vary_gain<N>({value<N>(distal.force_N), value<N>(distal.moment_Nmm)}, slopes_of<N>(distal.force_N),
                 slopes_of<N>(distal.moment_Nmm), wrench, result);
  } else {
    result.slopes.template bottomRows<6>().setZero();
  }
  return result;
}

}  // namespace

template <class Parameter>
VariedConstants<Parameter> varied_constants(const scene::Span& span, double length_mm, scene::RodModel model) {
  const scene::Stiffness& stiffness = span.stiffness;
  const Vector3d angular(stiffness.torsion_Nmm2, stiffness.bending_Nmm2[0], stiffness.bending_Nmm2[1]);
  Vector3d linear = Vector3d::Zero();
  if (model == scene::RodModel::reissner) {
    if (stiffness.axial_N) linear[0] = length_mm / *stiffness.axial_N;
    if (stiffness.shear_N) linear.tail<2>() = length_mm * stiffness.shear_N->cwiseInverse();
  }
  VariedConstants<Parameter> constants;
  constants.length_mm = length_mm;
  constants.angular_compliance = (length_mm * angular.cwiseInverse()).cast<Parameter>();
  constants.rest_rotation = (length_mm * span.rest_curvature_per_mm).cast<Parameter>();
  constants.linear_compliance = linear.cast<Parameter>();
  constants.rest_translation_mm[0] = length_mm;
  return constants;
}

template <int N, class Parameter>
ArcVariation<N> vary_arc(Law law, scene::RodModel model, const VariedConstants<Parameter>& constants,
                         const ArcForces<Dual<N>, 3>* distributed, const BasicWrench<Dual<N>, 3>& wrench) {
  if (model == scene::RodModel::reissner) return vary<true>(law, constants, distributed, wrench);
  return vary<false>(law, constants, distributed, wrench);
}

BasicScrew<Dual<3>, 3> varied_strain(scene::RodModel model, const VariedConstants<Dual<3>>& constants,
                                     const BasicWrench<Dual<3>, 3>& wrench) {
  using Number = Dual<3>;
  const bool with_shear = model == scene::RodModel::reissner;
  if (constants.tendons.empty()) {
    return with_shear ? VariedSection<true, Number, Number>(constants).strain(wrench)
                      : VariedSection<false, Number, Number>(constants).strain(wrench);
  }
  return with_shear ? TendonSection<true, Number, 3, Number>(constants).strain(wrench)
                    : TendonSection<false, Number, 3, Number>(constants).strain(wrench);
}

template VariedConstants<double> varied_constants(const scene::Span&, double, scene::RodModel);
template VariedConstants<Dual<3>> varied_constants(const scene::Span&, double, scene::RodModel);
template ArcVariation<6> vary_arc(Law, scene::RodModel, const VariedConstants<double>&, const ArcForces<Dual<6>, 3>*,
                                  const BasicWrench<Dual<6>, 3>&);
template ArcVariation<3> vary_arc(Law, scene::RodModel, const VariedConstants<Dual<3>>&, const ArcForces<Dual<3>, 3>*,
                                  const BasicWrench<Dual<3>, 3>&);

}  // namespace fam
