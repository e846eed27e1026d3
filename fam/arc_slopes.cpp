#include "fam/arc_slopes.h"

#include "fam/arc_law.h"
#include "fam/dual.h"
#include "fam/series_slopes.h"

namespace fam {
namespace {

template <int N>
Vector3<Dual<N>> with_slopes(const Vector3d& value, const Slopes3<N>& slopes) {
  Vector3<Dual<N>> result;
  for (int i = 0; i < 3; ++i) result[i] = {value[i], slopes.row(i).transpose().array()};
  return result;
}
template <int N>
Vector3d value(const Vector3<Dual<N>>& v) {
  return {v[0].value, v[1].value, v[2].value};
}
template <int N>
Slopes3<N> slopes_of(const Vector3<Dual<N>>& v) {
  Slopes3<N> slopes;
  for (int i = 0; i < 3; ++i) slopes.row(i) = v[i].slope.matrix().transpose();
  return slopes;
}

// For the laws that ask a section for nothing but its strain under a wrench.
template <bool with_shear, int N>
class DualSection {
 public:
  DualSection(const BasicArcConstants<3>& arc, const ArcChange<N>& change) : arc_(arc), change_(change) {}

  BasicScrew<Dual<N>, 3> strain(const BasicWrench<Dual<N>, 3>& wrench) const {
    const Screw screw = strain_under<with_shear, 3>(arc_, {value<N>(wrench.force_N), value<N>(wrench.moment_Nmm)});
    const std::array<Vector3d, 1> rotation{screw.rotation}, translation{screw.translation_mm};
    const SectionSlopes<with_shear, 1> section(arc_, rotation, translation);
    std::array<Slopes3<N>, 1> moment{slopes_of<N>(wrench.moment_Nmm)}, force{slopes_of<N>(wrench.force_N)};
    section.add_constant(change_, 0, moment[0], force[0]);
    ScrewSlopes<N> slopes{Slopes3<N>::Zero(), Slopes3<N>::Zero()};
    section.strain(0, moment, force, slopes.rotation, slopes.translation);
    return {with_slopes<N>(screw.rotation, slopes.rotation), with_slopes<N>(screw.translation_mm, slopes.translation)};
  }

 private:
  const BasicArcConstants<3>& arc_;
  const ArcChange<N>& change_;
};

// An arc's screw, and with distributed forces the wrench at its proximal end.
template <int N>
struct StepVariation {
  Screw screw;
  ScrewSlopes<N> screw_slopes;
  SectionWrench proximal;
  Slopes3<N> force_slopes, moment_slopes;
};

template <bool with_shear>
StepVariation<3> vary_by_numbers(Law law, const BasicArcConstants<3>& arc, const ArcForces<double, 3>* forces,
                                 const SectionWrench& wrench, const ArcChange<3>& change) {
  constexpr int N = 3;
  const DualSection<with_shear, N> section(arc, change);
  BasicWrench<Dual<N>, 3> w{with_slopes<N>(wrench.force_N, change.force_N),
                            with_slopes<N>(wrench.moment_Nmm, change.moment_Nmm)};
  ArcForces<Dual<N>, 3> varied;
  if (forces) {
    varied = {with_slopes<N>(forces->follower_S_N, change.follower_S_N),
              with_slopes<N>(forces->fixed_D_N, change.fixed_D_N)};
  }
  const ArcForces<Dual<N>, 3>* distributed = forces ? &varied : nullptr;
  BasicScrew<Dual<N>, 3> screw;
  if (law == Law::midpoint) midpoint_step(section, distributed, w, screw);
  else fourth_order_step(section, distributed, w, screw);
  return {{value<N>(screw.rotation), value<N>(screw.translation_mm)},
          {slopes_of<N>(screw.rotation), slopes_of<N>(screw.translation_mm)},
          {value<N>(w.force_N), value<N>(w.moment_Nmm)},
          slopes_of<N>(w.force_N),
          slopes_of<N>(w.moment_Nmm)};
}

template <bool with_shear, std::size_t terms>
RodSeries<double, 3, terms> series_of(const BasicArcConstants<3>& arc, const ArcForces<double, 3>* forces,
                                      const SectionWrench& wrench) {
  RodSeries<double, 3, terms> series;
  if (arc.is_elastic()) {
    series = rod_series<terms>(ElasticSection<with_shear, double, 3>(arc), forces, wrench);
  } else {
    series = rod_series<terms>(TendonSection<with_shear, double, 3>(arc), forces, wrench);
  }
  if constexpr (!with_shear) {
    for (std::size_t k = 1; k < terms; ++k) series.translation_mm[k].setZero();
  }
  return series;
}

template <bool with_shear, std::size_t terms, int N>
FAM_FLATTEN StepVariation<N> vary_by_series(const BasicArcConstants<3>& arc, const ArcForces<double, 3>* forces,
                                            const SectionWrench& wrench, const ArcChange<N>& change) {
  const RodSeries<double, 3, terms> s = series_of<with_shear, terms>(arc, forces, wrench);
  const SectionSlopes<with_shear, terms> section(arc, s.rotation, s.translation_mm);
  const SeriesSlopes<N, terms> d = series_slopes<with_shear, N, terms>(s, section, forces, change);
  StepVariation<N> result;
  result.screw = magnus<with_shear>(s);
  result.screw_slopes = magnus_slopes<with_shear, N, terms>(s, d);
  if (forces) {
    result.force_slopes = d.force_N[0];
    result.moment_slopes = d.moment_Nmm[0];
    for (std::size_t k = 0; k < terms; ++k) {
      result.proximal = result.proximal + SectionWrench{s.force_N[k], s.moment_Nmm[k]};
      if (k == 0) continue;
      result.force_slopes += d.force_N[k];
      result.moment_slopes += d.moment_Nmm[k];
    }
  }
  return result;
}

// The inverse exponential's factors, differentiated: with w and d of the screw
//   turn = (1 - B [w] + C [w]^2) dw,    way_D = (1 - B [w] + C [w]^2) d.
template <int N>
void vary_motion(const Screw& screw, const ScrewSlopes<N>& slopes, ArcVariation<N>& result) {
  const Vector3d &w = screw.rotation, &d = screw.translation_mm;
  const BasicCoefficients<Dual<1>> k = screw_coefficients(Dual<1>(w.dot(w), Dual<1>::Slope::Ones()));
  const double A = k.A.value, B = k.B.value, C = k.C.value;
  const Vector3d wd = w.cross(d), wwd = w.cross(wd);
  result.motion = {w, d + (B * wd + C * wwd), A, B};
  result.way_D_mm = d + (C * wwd - B * wd);

  const Slopes3<N> turned = cross<N>(w, slopes.rotation);
  result.slopes.template topRows<3>() = slopes.rotation + (C * cross<N>(w, turned) - B * turned);
  Slopes3<N> along = cross<N>(w, slopes.translation);
  add_cross<N>(along, -d, slopes.rotation);
  Slopes3<N> twice = cross<N>(w, along);
  add_cross<N>(twice, -wd, slopes.rotation);
  const Eigen::Matrix<double, 1, N> squared = 2 * w.transpose() * slopes.rotation;
  const Vector3d by_squared = k.C.slope[0] * wwd - k.B.slope[0] * wd;
  result.slopes.template middleRows<3>(3) = slopes.translation + (C * twice - B * along) + by_squared * squared;
}

// The wrench at the proximal end, carried back: what distributed forces added.
template <int N>
void vary_gain(const StepVariation<N>& step, const SectionWrench& distal, const ArcChange<N>& change,
               ArcVariation<N>& result) {
  const auto rotate_back = [&result](const Slopes3<N>& v) {
    Slopes3<N> back;
    for (int i = 0; i < N; ++i) back.col(i) = result.motion.rotate_back(v.col(i));
    return back;
  };
  const Slopes3<N> turn = result.slopes.template topRows<3>(), way = result.slopes.template middleRows<3>(3);
  const Vector3d force = result.motion.rotate_back(step.proximal.force_N);
  const Vector3d moment = result.motion.rotate_back(step.proximal.moment_Nmm);
  result.gain_D = {force - distal.force_N, moment - result.way_D_mm.cross(force) - distal.moment_Nmm};
  Slopes3<N> force_slopes = rotate_back(step.force_slopes), moment_slopes = rotate_back(step.moment_slopes);
  add_cross<N>(force_slopes, force, turn);
  add_cross<N>(moment_slopes, moment, turn);
  add_cross<N>(moment_slopes, force, way);
  add_cross<N>(moment_slopes, -result.way_D_mm, force_slopes);
  result.slopes.template middleRows<3>(6) = force_slopes - change.force_N;
  result.slopes.template bottomRows<3>() = moment_slopes - change.moment_Nmm;
}

// Three changes at a time: one more instance of the laws takes long to compile.
template <bool with_shear, int N>
StepVariation<N> vary_by_threes(Law law, const BasicArcConstants<3>& arc, const ArcForces<double, 3>* forces,
                                const SectionWrench& wrench, const ArcChange<N>& change) {
  StepVariation<N> result;
  for (int first = 0; first < N; first += 3) {
    const ArcChange<3> three{change.force_N.template middleCols<3>(first),
                             change.moment_Nmm.template middleCols<3>(first),
                             change.follower_S_N.template middleCols<3>(first),
                             change.fixed_D_N.template middleCols<3>(first),
                             change.constant,
                             change.tendon_arm_mm};
    const StepVariation<3> step = vary_by_numbers<with_shear>(law, arc, forces, wrench, three);
    result.screw = step.screw;
    result.proximal = step.proximal;
    result.screw_slopes.rotation.template middleCols<3>(first) = step.screw_slopes.rotation;
    result.screw_slopes.translation.template middleCols<3>(first) = step.screw_slopes.translation;
    result.force_slopes.template middleCols<3>(first) = step.force_slopes;
    result.moment_slopes.template middleCols<3>(first) = step.moment_slopes;
  }
  return result;
}

template <bool with_shear, int N>
ArcVariation<N> vary(Law law, const BasicArcConstants<3>& arc, const ArcForces<double, 3>* forces,
                     const SectionWrench& wrench, const ArcChange<N>& change) {
  StepVariation<N> step;
  if (law != Law::sixth_order) step = vary_by_threes<with_shear, N>(law, arc, forces, wrench, change);
  else if (N == 9 || (N == 3 && forces))
    step = vary_by_series < with_shear, N == 6 ? 6 : 7, N > (arc, forces, wrench, change);
  else step = vary_by_series < with_shear, N == 9 ? 7 : 6, N > (arc, forces, wrench, change);
  ArcVariation<N> result;
  vary_motion<N>(step.screw, step.screw_slopes, result);
  if (forces) vary_gain<N>(step, wrench, change, result);
  else result.slopes.template bottomRows<6>().setZero();
  return result;
}

template <bool with_shear>
StrainVariation strain_slopes(const BasicArcConstants<3>& arc, const SectionWrench& wrench,
                              const ArcChange<3>& change) {
  StrainVariation result;
  result.strain = strain_under<with_shear>(arc, wrench);
  result.pulls = tendon_pulls(arc.tendons, result.strain);
  const std::array<Vector3d, 1> rotation{result.strain.rotation}, translation{result.strain.translation_mm};
  const SectionSlopes<with_shear, 1> section(arc, rotation, translation);
  std::array<Slopes3<3>, 1> moment{change.moment_Nmm}, force{change.force_N};
  section.add_constant(change, 0, moment[0], force[0]);
  ScrewSlopes<3> slopes{Slopes3<3>::Zero(), Slopes3<3>::Zero()};
  section.strain(0, moment, force, slopes.rotation, slopes.translation);
  result.strain_slopes << slopes.rotation, slopes.translation;

  const SectionSlopes<true, 1> pulls(arc, rotation, translation);
  result.pull_slopes.setZero();
  if (!arc.tendons.empty()) {
    const Eigen::Matrix<double, 6, 3> by_strain = pulls.tendon_stiffness() * result.strain_slopes;
    result.pull_slopes << by_strain.bottomRows<3>(), by_strain.topRows<3>();
  }
  if (change.constant == Constant::tension) {
    result.pull_slopes.topRows<3>() -= force[0] - change.force_N;
    result.pull_slopes.bottomRows<3>() -= moment[0] - change.moment_Nmm;
  }
  return result;
}

}  // namespace

template <int N>
ArcVariation<N> vary_arc(Law law, scene::RodModel model, const BasicArcConstants<3>& arc,
                         const ArcForces<double, 3>* distributed, const SectionWrench& wrench,
                         const ArcChange<N>& change) {
  if (model == scene::RodModel::reissner) return vary<true, N>(law, arc, distributed, wrench, change);
  return vary<false, N>(law, arc, distributed, wrench, change);
}

StrainVariation vary_strain(scene::RodModel model, const BasicArcConstants<3>& arc, const SectionWrench& wrench,
                            const ArcChange<3>& change) {
  return model == scene::RodModel::reissner ? strain_slopes<true>(arc, wrench, change)
                                            : strain_slopes<false>(arc, wrench, change);
}

template ArcVariation<3> vary_arc(Law, scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                  const SectionWrench&, const ArcChange<3>&);
template ArcVariation<6> vary_arc(Law, scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                  const SectionWrench&, const ArcChange<6>&);

template ArcVariation<9> vary_arc(Law, scene::RodModel, const BasicArcConstants<3>&, const ArcForces<double, 3>*,
                                  const SectionWrench&, const ArcChange<9>&);

}  // namespace fam
