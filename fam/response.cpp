#include "fam/response.h"

#include "scene/load_visitor.h"

#include "fam/skew.h"

#include <algorithm>
#include <limits>
#include <string_view>

namespace fam {
namespace {

using Columns = Response::Columns;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

Vector3d arm_of(const scene::Force& force) {
  return {0, force.offset_mm[0], force.offset_mm[1]};
}
// Null: of another kind, or none.
template <class Kind>
const Kind* load_of(const scene::Scene& scene, std::size_t load) {
  if (load >= scene.loads.size() || std::string_view(scene::kind_name(scene.loads[load])) != scene::kind_name(Kind{}))
    return nullptr;
  return &std::get<Kind>(scene.loads[load]);
}

}  // namespace

void Response::reserve(std::size_t arcs, std::size_t spans, std::size_t tendons) {
  arcs_.resize(arcs);
  first_arcs_.reserve(spans + 1);
  tendons_.reserve(tendons);
  for (Sweep& sweep : sweeps_) sweep.nodes.resize(arcs);
}

void Response::set(const Solution& solution) {
  solution_ = solution;
  prepared_ = false;
  for (Sweep& sweep : sweeps_) sweep.source = {};
}

// The sweep of a source: one of those kept, or a new one in place of that not asked for longest.
const Response::Sweep& Response::swept(const Source& source) {
  prepare();
  Sweep* oldest = &sweeps_[0];
  for (Sweep& sweep : sweeps_) {
    if (sweep.source == source) {
      sweep.asked = ++asked_;
      return sweep;
    }
    if (sweep.asked < oldest->asked) oldest = &sweep;
  }
  arc_loads_are_asked_for_ |= source.kind == Kind::distributed || source.kind == Kind::tension;
  oldest->source = source;
  oldest->asked = ++asked_;
  set_jumps(*oldest);
  sweep_to_clamp(*oldest);
  sweep_to_tip(*oldest);
  return *oldest;
}

void Response::set_jumps(Sweep& sweep) {
  sweep.jump_span = sweep.source.index;
  sweep.wrench_jump.setZero();
  sweep.turn_jump.setZero();
  sweep.shift_jump_mm.setZero();
  if (sweep.source.kind == Kind::force) sweep.wrench_jump.topRows<3>().setIdentity();
  else if (sweep.source.kind == Kind::moment) sweep.wrench_jump.bottomRows<3>().setIdentity();
  else if (sweep.source.kind == Kind::place) set_place_jumps(sweep);
  else sweep.jump_span = solution_.spans.size() - 1;  // nothing jumps
}

// The load moves on by ds: there the rod lies as it did just beyond the load, and the load with it. With Y the turn,
// the place and the wrench, and Y_p = J(Y_d) across the load, the small motions of Y jump by J'(Y_d) Y_d' - Y_p'.
void Response::set_place_jumps(Sweep& sweep) {
  const scene::Scene& scene = *solution_.scene;
  const auto* force = load_of<scene::Force>(scene, sweep.source.index);
  const auto* moment = load_of<scene::Moment>(scene, sweep.source.index);
  const std::size_t i = sweep.jump_span = span_ending_at(force ? force->at_mm : moment->at_mm);
  const std::size_t k = first_arcs_[i + 1] - 1;
  const Matrix3d& R = solution_.poses[k + 1].rotation_BS;
  const bool follower = (force ? force->frame : moment->frame) == scene::Frame::follower;
  const Matrix3d to_section = follower ? Matrix3d::Identity() : Matrix3d(R.transpose());
  SectionWrench load_S, with_S = solution_.distal_wrenches_S[k];
  const Vector3d arm = force ? arm_of(*force) : Vector3d::Zero();
  if (force) load_S = {to_section * force->value_N, arm.cross(to_section * force->value_N)};
  else load_S.moment_Nmm = to_section * moment->value_Nmm;
  const SectionWrench without_S = with_S + (-1.0) * load_S;

  set_constants(i, arc_length_mm(i));
  const auto strain = [&](const SectionWrench& wrench) {
    return (1 / constants_.length_mm) * vary_strain(solution_.model, constants_, wrench, {}).strain;
  };
  const Screw beyond = strain(without_S), before = strain(with_S);
  const Vector3d &u = beyond.rotation, &v = beyond.translation_mm;
  Vector3d d_force = Vector3d::Zero(), d_moment = u.cross(arm).cross(load_S.force_N);  // of the load, as it turns
  if (follower) {
    d_force = u.cross(load_S.force_N);
    d_moment = u.cross(load_S.moment_Nmm);
  }
  d_moment += before.translation_mm.cross(with_S.force_N) - v.cross(without_S.force_N);
  sweep.turn_jump.col(0) = R * (u - before.rotation);
  sweep.shift_jump_mm.col(0) = R * (v - before.translation_mm);
  sweep.wrench_jump.col(0) << R * d_force, R * d_moment;
}

Columns Response::rows(const Source& source, double s_mm, What what) {
  const Sweep& sweep = swept(source);
  const Place place = place_of(s_mm);
  if (!place.valid) return Columns::Constant(no_number);
  const Arc& arc = arcs_[place.arc];
  const Node& node = sweep.nodes[place.arc];
  Section section{solution_.poses[place.arc + 1].rotation_BS, arc.force_N, arc.moment_Nmm, node.turn, node.shift_mm,
                  arc.stiffness * node.turn + node.wrench};
  if (place.part > 0) {
    section = inside(source, place, section);
  } else if (what == What::pose && source.kind == Kind::place && place.arc + 1 == first_arcs_[sweep.jump_span + 1]) {
    section.turn -= sweep.turn_jump;  // the load has left for the clamp's side
    section.shift_mm -= sweep.shift_jump_mm;
  }
  if (what == What::pose) return (Columns() << section.shift_mm, section.turn).finished();
  return strain_or_wrench(source, place, section, what);
}

// From an arc's distal end to a place inside, by the law's step over the part between.
Response::Section Response::inside(const Source& source, const Place& place, const Section& distal) {
  const double length_mm = place.part * arc_length_mm(place.span);
  const Matrix3d& R = distal.rotation_BS;
  ArcChange<3> change = distal.change_S();
  change.fixed_D_N = R.transpose() * skew(length_mm * solution_.spans[place.span].fixed_force_B_N_per_mm) * distal.turn;
  add_source(source, place.span, length_mm, R, change);
  set_constants(place.span, length_mm);
  const ArcForces<double, 3> forces = forces_on(place.span, length_mm, R);
  const bool with_forces = has_forces(place.span) || brings_forces(source, place.span);
  const ArcVariation<3> part =
      vary_arc(solution_.law, solution_.model, constants_, with_forces ? &forces : nullptr, distal.wrench_S(), change);

  Section at;
  const Vector3d way = R * part.way_D_mm, gain_N = R * part.gain_D.force_N, gain_Nmm = R * part.gain_D.moment_Nmm;
  const Matrix3d way_slopes = R * part.slopes.middleRows<3>(3) - skew(way) * distal.turn;
  for (int row = 0; row < 3; ++row) {
    at.rotation_BS.row(row) = part.motion.rotate(R.row(row).transpose()).transpose();
  }
  at.force_N = distal.force_N + gain_N;
  at.moment_Nmm = distal.moment_Nmm + gain_Nmm + way.cross(at.force_N);
  at.turn = distal.turn - R * part.slopes.topRows<3>();
  at.shift_mm = distal.shift_mm - way_slopes;
  at.wrench = distal.wrench;
  at.wrench.topRows<3>() += R * part.slopes.middleRows<3>(6) - skew(gain_N) * distal.turn;
  at.wrench.bottomRows<3>() += R * part.slopes.bottomRows<3>() - skew(gain_Nmm) * distal.turn +
                               skew(way) * at.wrench.topRows<3>() - skew(at.force_N) * way_slopes;
  return at;
}

SectionWrench Response::Section::wrench_S() const {
  return {rotation_BS.transpose() * force_N, rotation_BS.transpose() * moment_Nmm};
}

ArcChange<3> Response::Section::change_S() const {
  ArcChange<3> change;
  change.force_N = rotation_BS.transpose() * (wrench.topRows<3>() + skew(force_N) * turn);
  change.moment_Nmm = rotation_BS.transpose() * (wrench.bottomRows<3>() + skew(moment_Nmm) * turn);
  return change;
}

Columns Response::strain_or_wrench(const Source& source, const Place& place, const Section& section, What what) {
  const Matrix3d& R = section.rotation_BS;
  ArcChange<3> change = section.change_S();
  add_source(source, place.span, arc_length_mm(place.span), R, change);
  set_constants(place.span, arc_length_mm(place.span));
  const StrainVariation at = vary_strain(solution_.model, constants_, section.wrench_S(), change);
  if (what == What::strain) return at.strain_slopes / constants_.length_mm;
  Columns pulls;  // base frame
  pulls << R * at.pull_slopes.topRows<3>() - skew(R * at.pulls.force_N) * section.turn,
      R * at.pull_slopes.bottomRows<3>() - skew(R * at.pulls.moment_Nmm) * section.turn;
  return section.wrench - pulls;
}

Eigen::Matrix<double, 6, 6> Response::compliance(double s_mm, What what) {
  const std::size_t tip = solution_.spans.size() - 1;
  Eigen::Matrix<double, 6, 6> result;
  result << rows({Kind::force, tip}, s_mm, what), rows({Kind::moment, tip}, s_mm, what);
  return result;
}

Columns Response::by_load(std::size_t load, double s_mm, What what) {
  const scene::Scene& scene = *solution_.scene;
  if (load >= scene.loads.size()) return Columns::Constant(no_number);
  if (scene::tendon_of(scene.loads[load])) return by_tension(load, s_mm, what);
  const auto* force = load_of<scene::Force>(scene, load);
  const auto* moment = load_of<scene::Moment>(scene, load);
  if (!force && !moment) return rows({Kind::distributed, load}, s_mm, what);
  prepare();
  const std::size_t span = span_ending_at(force ? force->at_mm : moment->at_mm);
  const Matrix3d& R = solution_.poses[first_arcs_[span + 1]].rotation_BS;
  const bool follower = (force ? force->frame : moment->frame) == scene::Frame::follower;
  const Matrix3d to_base = follower ? R : Matrix3d::Identity();
  if (moment) return rows({Kind::moment, span}, s_mm, what) * to_base;
  Columns result = rows({Kind::force, span}, s_mm, what) * to_base;
  if (!force->offset_mm.isZero(0)) {
    result += rows({Kind::moment, span}, s_mm, what) * skew(R * arm_of(*force)) * to_base;
  }
  return result;
}

Columns Response::by_tension(std::size_t load, double s_mm, What what) {
  const auto is_tendon = [](const scene::Load& other) { return scene::tendon_of(other) != nullptr; };
  const auto first = solution_.scene->loads.begin();
  const auto ordinal =
      static_cast<std::size_t>(std::count_if(first, first + static_cast<std::ptrdiff_t>(load), is_tendon));
  Columns result = Columns::Zero();
  result.col(0) = rows({Kind::tension, ordinal / 3}, s_mm, what).col(static_cast<Eigen::Index>(ordinal % 3));
  return result;
}

Columns Response::by_rest_curvature(std::size_t section, double s_mm, What what) {
  if (section >= solution_.scene->sections.size()) return Columns::Constant(no_number);
  return rows({Kind::rest_curvature, section}, s_mm, what);
}

Columns Response::by_stiffness(std::size_t section, double s_mm, What what) {
  if (section >= solution_.scene->sections.size()) return Columns::Constant(no_number);
  return rows({Kind::stiffness, section}, s_mm, what);
}

Columns Response::by_place(std::size_t load, double s_mm, What what) {
  if (!load_of<scene::Force>(*solution_.scene, load) && !load_of<scene::Moment>(*solution_.scene, load)) {
    return Columns::Constant(no_number);
  }
  return rows({Kind::place, load}, s_mm, what);
}

}  // namespace fam
