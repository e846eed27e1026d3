#include "fam/shape.h"

#include <algorithm>
#include <numbers>

namespace fam {
namespace {

// The constants of a part of an arc, without its tendons.
template <int D>
BasicArcConstants<D> part_of(const BasicArcConstants<D>& arc, double part) {
  BasicArcConstants<D> result;
  result.length_mm = part * arc.length_mm;
  result.angular_compliance = part * arc.angular_compliance;
  result.rest_rotation = part * arc.rest_rotation;
  result.linear_compliance = part * arc.linear_compliance;
  result.rest_translation_mm = part * arc.rest_translation_mm;
  result.tendons = arc.tendons;
  result.straight_tendons = arc.straight_tendons;
  return result;
}

// The pose whose motion leads on to `distal`.
template <int D>
BasicPose<D> before(const BasicPose<D>& distal, const BasicMotion<double, D>& motion) {
  BasicPose<D> pose;
  for (int row = 0; row < D; ++row) {
    pose.rotation_BS.row(row) = motion.rotate(Vector<double, D>(distal.rotation_BS.row(row).transpose())).transpose();
  }
  pose.position_B_mm = distal.position_B_mm - pose.rotation_BS * motion.position_mm;
  return pose;
}

// Of the part of an arc that ends at its distal end, by the series of the whole.
template <bool with_shear>
BasicMotion<double, 2> part_of(const RodSeries<double, 2, 7>& series, double part, bool distributed,
                               BasicWrench<double, 2>& wrench) {
  return part_step<with_shear>(series, part, distributed, wrench);
}
template <bool with_shear>
RigidMotion part_of(const RodSeries<double, 3, 7>& series, double part, bool distributed, SectionWrench& wrench) {
  return step_of_part<with_shear>(series, part, distributed, wrench);
}

template <int D>
BasicWrench<double, D> turned(const Eigen::Matrix<double, D, D>& rotation, const BasicWrench<double, D>& wrench) {
  if constexpr (D == 3) return {rotation * wrench.force_N, rotation * wrench.moment_Nmm};
  else return {rotation * wrench.force_N, wrench.moment_Nmm};
}

// Of Lobatto's rule of order eight on [0, 1]; the ends of an arc are at hand. That of order six, the series' own,
// leaves the clamp of one of 9840 random scenes 2.0 times the tolerance (tests/answers_test.cpp), this one 0.3 times.
constexpr std::array<double, 3> lobatto_points{0.17267316464601143, 0.5, 0.82732683535398857};
constexpr std::array<double, 3> lobatto_weights{49. / 180, 16. / 45, 49. / 180};
constexpr double lobatto_end_weight = 1. / 20;

SectionPose pose_by_bezier(const Arc& arc, const SectionPose& proximal, double fraction) {
  SectionPose pose = proximal.then(twist(arc.twist_before_rad));
  const double angle = arc.screw.rotation.norm();
  const RigidMotion bend = exponential(fraction * arc.screw);
  Vector3d position = bend.position_mm;
  if (angle > 0 && angle < std::numbers::pi) {
    const double f = fraction, g = 1 - fraction;
    const auto points = bezier_control_points(arc.screw.translation_mm[0], angle);
    const Eigen::Vector2d at = 3 * g * g * f * points[1] + 3 * g * f * f * points[2] + f * f * f * points[3];
    const Vector3d side = (arc.screw.rotation / angle).cross(Vector3d::UnitX());
    position = at[0] * Vector3d::UnitX() + at[1] * side;
  }
  const Vector3d position_B_mm = pose.position_B_mm + pose.rotation_BS * position;
  pose = pose.then(bend).then(twist((fraction - 1) * arc.twist_before_rad + fraction * arc.twist_after_rad));
  pose.position_B_mm = position_B_mm;
  return pose;
}

}  // namespace

template <int D>
template <bool with_shear>
void ArcInterior<D>::make_series() {
  if (has_series_) return;
  has_series_ = true;
  const auto k = static_cast<std::size_t>(arc_);
  ArcForces<double, D> forces;
  if (span_->distributed) forces = span_->template forces<double>(rod_->poses[k + 1].rotation_BS.transpose());
  series_ =
      series_of<with_shear, 7, D>(span_->constants, span_->distributed ? &forces : nullptr, rod_->distal_wrenches_S[k]);
}
template <int D>
void ArcInterior<D>::make_series() {
  rod_->model == RodModel::reissner ? make_series<true>() : make_series<false>();
}

// The law's step of the part beyond the fraction: the motion, and the wrench at its proximal end.
template <int D>
template <bool with_shear>
FAM_FLATTEN BasicMotion<double, D> ArcInterior<D>::step(double fraction, BasicWrench<double, D>& wrench) {
  const auto k = static_cast<std::size_t>(arc_);
  const double part = 1 - fraction;
  wrench = rod_->distal_wrenches_S[k];
  ArcForces<double, D> forces;
  if (span_->distributed) forces = span_->template forces<double>(rod_->poses[k + 1].rotation_BS.transpose());
  const ArcForces<double, D>* distributed = span_->distributed ? &forces : nullptr;
  if (rod_->law == Law::sixth_order) {
    make_series<with_shear>();
    return part_of<with_shear>(series_, part, span_->distributed, wrench);
  }
  const BasicArcConstants<D> constants = part_of(span_->constants, part);
  if (distributed) forces = {part * forces.follower_S_N, part * forces.fixed_D_N};
  BasicScrew<double, D> screw;
  if (constants.is_elastic()) {
    return law_step(rod_->law, ElasticSection<with_shear, double, D>(constants), distributed, wrench, screw);
  }
  bool collapsed = false;
  return tendon_step<with_shear>(rod_->law, constants, distributed, wrench, screw, collapsed);
}
template <int D>
BasicMotion<double, D> ArcInterior<D>::step(double fraction, BasicWrench<double, D>& wrench) {
  return rod_->model == RodModel::reissner ? step<true>(fraction, wrench) : step<false>(fraction, wrench);
}

template <int D>
BasicPose<D> ArcInterior<D>::pose(double fraction) {
  const auto k = static_cast<std::size_t>(arc_);
  if (fraction <= 0) return rod_->poses[k];
  if (fraction >= 1) return rod_->poses[k + 1];
  if constexpr (D == 3) {
    if (!facts_of(rod_->law).coupled) return pose_by_bezier(rod_->arcs[k], rod_->poses[k], fraction);
  }
  BasicWrench<double, D> wrench;
  return before(rod_->poses[k + 1], step(fraction, wrench));
}

template <int D>
PosesAtOnce<D> ArcInterior<D>::poses(const PlacesAtOnce& fractions) {
  PosesAtOnce<D> result;
  const auto is_inside = [](double fraction) { return fraction > 0 && fraction < 1; };
  bool found = false;
  if (rod_->law == Law::sixth_order && std::any_of(fractions.begin(), fractions.end(), is_inside)) {
    make_series();
    const BasicPose<D>& distal = rod_->poses[static_cast<std::size_t>(arc_) + 1];
    found = rod_->model == RodModel::reissner ? poses_in_arc<true>(series_, fractions, distal, result)
                                              : poses_in_arc<false>(series_, fractions, distal, result);
  }
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    if (!found || !is_inside(fractions[i])) result[i] = pose(fractions[i]);
  }
  return result;
}

template <int D>
BasicWrench<double, D> ArcInterior<D>::wrench(double fraction) {
  BasicWrench<double, D> wrench = rod_->distal_wrenches_S[static_cast<std::size_t>(arc_)];
  if (fraction < 1) step(fraction, wrench);
  return wrench;
}

template <int D>
BasicScrew<double, D> ArcInterior<D>::strain_per_mm(double fraction) {
  make_series();
  BasicScrew<double, D> strain;
  for (std::size_t k = series_.rotation.size(); k-- > 0;)
    strain = (1 - fraction) * strain + BasicScrew<double, D>{series_.rotation[k], series_.translation_mm[k]};
  return (1 / span_->constants.length_mm) * strain;
}

namespace {

// v + u x r times the arc's length, by its mean strain.
template <int D>
Vector<double, D> tendon_tangent_mm(const SolvedRod<D>& rod, int arc, const BasicTendon<D>& tendon) {
  const BasicScrew<double, D>& strain = rod.arcs[static_cast<std::size_t>(arc)].screw;
  return strain.translation_mm + cross(strain.rotation, tendon.arm_mm);
}

}  // namespace

template <int D>
bool any_tendon_collapsed(const SolvedRod<D>& rod) {
  for (const SpanArcs<D>& span : rod.spans) {
    if (!span.constants.straight_tendons) continue;
    for (const BasicTendon<D>& tendon : span.constants.tendons) {
      for (int arc = span.first_arc; arc < span.end_arc; ++arc) {
        const double along_mm = tendon_tangent_mm(rod, arc, tendon)[0];
        if (!(along_mm > smallest_tendon_stretch * span.constants.length_mm)) return true;
      }
    }
  }
  return false;
}

template <int D>
double unseen_turn_rad(const SolvedRod<D>& rod) {
  double largest_rad = 0;
  for (const SpanArcs<D>& span : rod.spans) {
    if (span.constants.straight_tendons) continue;
    for (const BasicTendon<D>& tendon : span.constants.tendons) {
      for (int arc = span.first_arc + 1; arc < span.end_arc; ++arc) {
        const Vector<double, D> before = tendon_tangent_mm(rod, arc - 1, tendon);
        const Vector<double, D> here = tendon_tangent_mm(rod, arc, tendon);
        if ((here - before).norm() <= std::min(here.norm(), before.norm())) continue;
        const auto k = static_cast<std::size_t>(arc);
        largest_rad = std::max(largest_rad, (rod.arcs[k].screw.rotation - rod.arcs[k - 1].screw.rotation).norm());
      }
    }
  }
  return largest_rad;
}

// Places between a fraction and the arc's distal end, after the fraction itself.
PlacesAtOnce places_beyond(double fraction) {
  PlacesAtOnce result{fraction};
  for (std::size_t i = 0; i < lobatto_points.size(); ++i) result[i + 1] = fraction + (1 - fraction) * lobatto_points[i];
  return result;
}

// From the arc's distal end towards the clamp: the forces beyond and the moments of what lies between. With distributed
// forces `poses` are those of places_beyond(fraction), else the first is that of the fraction.
template <int D>
BasicWrench<double, D> BasicShape<D>::wrench_towards(const ArcInterior<D>& arc, double fraction,
                                                     std::span<const BasicPose<D>> poses) const {
  const BasicPose<D>& pose = poses[0];
  const SpanArcs<D>& span = arc.span();
  const auto k = static_cast<std::size_t>(arc.arc());
  const BasicWrench<double, D>& distal = distal_totals_B_[k];
  const Vector<double, D> arm = rod_.poses[k + 1].position_B_mm - pose.position_B_mm;
  BasicWrench<double, D> total{distal.force_N, distal.moment_Nmm + arm_cross(arm, distal.force_N)};
  if (!span.distributed) return total;
  const double part = 1 - fraction;
  total.force_N += part * span.fixed_force_B_N;
  Vector<double, D> mean_arm_mm = Vector<double, D>::Zero();
  const bool follows = !span.follower_force_S_N.isZero(0);
  const auto add = [&](const BasicPose<D>& at, double weight) {
    const Vector<double, D> arm_mm = weight * (at.position_B_mm - pose.position_B_mm);
    mean_arm_mm += arm_mm;
    if (!follows) return;
    const Vector<double, D> follower_N = part * (at.rotation_BS * span.follower_force_S_N);
    total.force_N += weight * follower_N;
    total.moment_Nmm += arm_cross(arm_mm, follower_N);
  };
  add(pose, lobatto_end_weight);
  add(rod_.poses[k + 1], lobatto_end_weight);
  for (std::size_t i = 0; i < lobatto_points.size(); ++i) add(poses[i + 1], lobatto_weights[i]);
  total.moment_Nmm += part * arm_cross(mean_arm_mm, span.fixed_force_B_N);
  return total;
}

template <int D>
void BasicShape<D>::reserve(std::size_t arcs) {
  span_of_arc_.reserve(arcs);
  distal_totals_B_.reserve(arcs);
}

template <int D>
void BasicShape<D>::begin(const SolvedRod<D>& rod) {
  rod_ = rod;
  distal_totals_B_.resize(rod.arcs.size());
  span_of_arc_.clear();
  for (std::size_t i = 0; i < rod.spans.size(); ++i) {
    span_of_arc_.resize(static_cast<std::size_t>(rod.spans[i].end_arc), static_cast<int>(i));
  }
}

template <int D>
void BasicShape<D>::add_point_loads(const SpanArcs<D>& span, BasicWrench<double, D>& total_B) const {
  const Eigen::Matrix<double, D, D>& R = rod_.poses[static_cast<std::size_t>(span.end_arc)].rotation_BS;
  BasicWrench<double, D> loads_S;
  span.template add_point_loads<double>(R.transpose(), loads_S);
  total_B.force_N += span.fixed_load_B.force_N + R * span.follower_load_S.force_N;
  if constexpr (D == 3) total_B.moment_Nmm += R * loads_S.moment_Nmm;
  else total_B.moment_Nmm += loads_S.moment_Nmm;
}

template <int D>
BasicWrench<double, D> BasicShape<D>::proximal_total_B(ArcInterior<D>& arc) const {
  if (arc.span().distributed) return wrench_towards(arc, 0, arc.poses(places_beyond(0)));
  return wrench_towards(arc, 0, {&rod_.poses[static_cast<std::size_t>(arc.arc())], 1});
}

// Poses and totals at up to four fractions.
template <int D>
typename BasicShape<D>::Sections BasicShape<D>::totals(ArcInterior<D>& arc, std::span<const double> fractions) const {
  Sections result;
  if (arc.span().distributed) {
    for (std::size_t i = 0; i < fractions.size(); ++i) {
      const PosesAtOnce<D> poses = arc.poses(places_beyond(fractions[i]));
      result[i] = {poses[0], wrench_towards(arc, fractions[i], poses)};
    }
    return result;
  }
  PlacesAtOnce places;
  places.fill(fractions.back());
  std::copy(fractions.begin(), fractions.end(), places.begin());
  const PosesAtOnce<D> poses = arc.poses(places);
  for (std::size_t i = 0; i < fractions.size(); ++i)
    result[i] = {poses[i], wrench_towards(arc, fractions[i], {&poses[i], 1})};
  return result;
}

template <int D>
BasicScrew<double, D> BasicShape<D>::strain_under(const SpanArcs<D>& span,
                                                  const BasicWrench<double, D>& total_S) const {
  return rod_.model == RodModel::reissner ? fam::strain_under<true>(span.constants, total_S)
                                          : fam::strain_under<false>(span.constants, total_S);
}

template <int D>
typename BasicShape<D>::Sections BasicShape<D>::sections(ArcInterior<D>& arc, std::span<const double> fractions) const {
  Sections result = totals(arc, fractions);
  for (std::size_t i = 0; i < fractions.size(); ++i) take_pulls_off(arc.span(), result[i]);
  return result;
}

template <int D>
typename BasicShape<D>::Section BasicShape<D>::section(ArcInterior<D>& arc, double fraction) const {
  if (fraction > 0 && fraction < 1) return sections(arc, {&fraction, 1})[0];
  const auto k = static_cast<std::size_t>(arc.arc());
  Section end =
      fraction <= 0 ? Section{rod_.poses[k], proximal_total_B(arc)} : Section{rod_.poses[k + 1], distal_totals_B_[k]};
  take_pulls_off(arc.span(), end);
  return end;
}

// From the total wrench.
template <int D>
void BasicShape<D>::take_pulls_off(const SpanArcs<D>& span, Section& section) const {
  const auto& tendons = span.constants.tendons;
  if (tendons.empty()) return;
  const Eigen::Matrix<double, D, D>& R = section.pose.rotation_BS;
  const BasicWrench<double, D> total_S = turned<D>(R.transpose(), section.own_B);
  section.own_B = turned<D>(R, total_S + (-1.0) * tendon_pulls(tendons, strain_under(span, total_S)));
}

template class ArcInterior<2>;
template class ArcInterior<3>;
template bool any_tendon_collapsed(const SolvedRod<2>&);
template bool any_tendon_collapsed(const SolvedRod<3>&);
template double unseen_turn_rad(const SolvedRod<2>&);
template double unseen_turn_rad(const SolvedRod<3>&);
template class BasicShape<2>;
template class BasicShape<3>;

}  // namespace fam
