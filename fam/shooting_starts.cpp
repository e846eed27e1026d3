// What Newton's method starts from: the rest shape, the march from the clamp, or a solution at hand.
#include "fam/rotation.h"
#include "fam/shooting.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace fam {
namespace {

// Of what leaves one equilibrium: where a step with a rigid rod's derivatives leaves 0.3 of the way, 1 - cos(sqrt(2.4
// share)). With 1 in its place random scenes beyond it take 0.94 of the time, spatial ones of
// Study I 1.05 of the instructions.
constexpr double rigid_share = 0.25;

bool has_same_section(const scene::Span& a, const scene::Span& b) {
  return a.stiffness.torsion_Nmm2 == b.stiffness.torsion_Nmm2 && a.stiffness.bending_Nmm2 == b.stiffness.bending_Nmm2 &&
         a.stiffness.axial_N == b.stiffness.axial_N && a.stiffness.shear_N == b.stiffness.shear_N &&
         std::abs(a.length_mm() - b.length_mm()) <= 1e-3 * a.length_mm();
}

// The arc from its proximal end to its distal one, as if its tendons ran along it.
template <int D>
BasicArcConstants<D> backwards(BasicArcConstants<D> arc) {
  for (const BasicTendon<D>& tendon : arc.straight_tendons ? std::span<const BasicTendon<D>>() : arc.tendons) {
    const Vector<double, D> pull_N = tendon.tension_N * Vector<double, D>::Unit(0);
    arc.rest_rotation -= arc.angular_compliance.cwiseProduct(arm_cross(tendon.arm_mm, pull_N));
  }
  arc.length_mm *= -1;
  arc.angular_compliance *= -1;
  arc.rest_rotation *= -1;
  arc.linear_compliance *= -1;
  arc.rest_translation_mm *= -1;
  return arc;
}

template <int D>
BasicMotion<double, D> elastic_arc(Law law, const BasicArcConstants<D>& arc, const ArcForces<double, D>* forces,
                                   BasicWrench<double, D>& wrench, BasicScrew<double, D>& screw) {
  if constexpr (D == 3) return elastic_step<false>(law, arc, forces, wrench, screw);
  else return flat_step(law, ElasticSection<false, double, D>(arc), forces, wrench, screw);
}

// A moment in the base's axes.
Vector3d turned_back(const Matrix3d& rotation_SB, const Vector3d& moment_S) {
  return rotation_SB.transpose() * moment_S;
}
Angular<double, 2> turned_back(const Eigen::Matrix2d&, const Angular<double, 2>& moment_S) {
  return moment_S;
}

template <int D>
BasicWrench<double, D> loads_at_end(const SpanArcs<D>& span, const Eigen::Matrix<double, D, D>& rotation_SB) {
  BasicWrench<double, D> loads;
  span.add_point_loads(rotation_SB, loads);
  return loads;
}

}  // namespace

// March without load from a tip turned so that the clamp has R = I.
template <int D>
void Shooting<D>::start_unloaded() {
  set_load(0);
  Node tip{Rotation::Identity(), {}};
  Node clamp = tip;
  rod_.march({0, rod_.arc_count()}, clamp);
  tip.rotation_SB = clamp.rotation_SB.transpose();
  for (std::size_t k = segments_.size(); k-- > 0;) {
    nodes_[k] = tip;
    if (k > 0) rod_.march(segments_[k], tip);
  }
}

// Shear and stretch are left out.
template <int D>
BasicWrench<double, D> Shooting<D>::march_outwards(const BasicWrench<double, D>* clamp) {
  Node at{Rotation::Identity(), clamp ? *clamp : BasicWrench<double, D>{}};
  Vector<double, D> position_B_mm = Vector<double, D>::Zero();
  BasicWrench<double, D> loads_B;  // about the clamp
  const auto meet = [&](const BasicWrench<double, D>& load_S, const Vector<double, D>& where_B_mm) {
    const Vector<double, D> force_N = at.rotation_SB.transpose() * load_S.force_N;
    loads_B.force_N += force_N;
    loads_B.moment_Nmm += arm_cross(where_B_mm, force_N) + turned_back(at.rotation_SB, load_S.moment_Nmm);
  };
  std::size_t segment = 0;
  for (const SpanArcs<D>& span : rod_.span_arcs()) {
    const BasicArcConstants<D> back = backwards(span.constants);
    for (int arc = span.first_arc; arc < span.end_arc; ++arc) {
      const ArcForces<double, D> forces = span.forces(at.rotation_SB);
      const ArcForces<double, D> against{-forces.follower_S_N, -forces.fixed_D_N};
      BasicScrew<double, D> screw{back.rest_rotation, back.rest_translation_mm};
      const BasicMotion<double, D> motion =
          clamp ? elastic_arc(rod_.law(), back, span.distributed ? &against : nullptr, at.wrench, screw)
                : exponential(screw);
      marched_.arcs[static_cast<std::size_t>(arc)].screw.rotation = -screw.rotation;
      for (int axis = 0; axis < D; ++axis)
        at.rotation_SB.col(axis) = motion.rotate(Vector<double, D>(at.rotation_SB.col(axis)));
      const Vector<double, D> way_B_mm = -(at.rotation_SB.transpose() * motion.position_mm);
      if (span.distributed)
        meet({forces.follower_S_N + forces.fixed_D_N, Angular<double, D>::Zero()}, position_B_mm + way_B_mm / 2);
      position_B_mm += way_B_mm;
      if (arc + 1 == span.end_arc) {
        const BasicWrench<double, D> loads_S = loads_at_end(span, at.rotation_SB);
        at.wrench = at.wrench + -1.0 * loads_S;
        meet(loads_S, position_B_mm);
      }
      if (arc + 1 == segments_[segment].end_arc) nodes_[segment++] = at;
    }
  }
  nodes_.back().wrench = {};
  return loads_B;
}

template <int D>
double Shooting<D>::start_from_clamp() {
  set_load(1);
  BasicWrench<double, D> clamp = march_outwards(nullptr);
  const auto missed_Nmm = [&] { return Angular<double, D>(march_outwards(&clamp).moment_Nmm - clamp.moment_Nmm); };
  Angular<double, D> missed = missed_Nmm();
  const double share = missed.dot(clamp.moment_Nmm) / clamp.moment_Nmm.squaredNorm();
  if (std::abs(share) > 1e-3 && share < 0.5) {
    clamp.moment_Nmm += 1 / (1 - share) * missed;
    missed = missed_Nmm();
  }
  return missed.isZero(0) ? 0 : missed.norm() / clamp.moment_Nmm.norm();
}

template <int D>
bool Shooting<D>::solve_known_moments() {
  start_from_clamp();
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    if (!equations(k, false).mismatch_is_small) return false;
  }
  return solve_from_start();
}

// Under small loads the first derivatives of one segment are those of a rigid rod, which a turn of the tip turns as a
// whole: a march with others costs as much as ten without, and the march from the clamp leads so near that these do.
template <int D>
bool Shooting<D>::solve_from_start() {
  if (segments_.size() > 1 || !one_equilibrium() || bounds_.unique_share > rigid_share) return solve_from_here();
  set_load(1);
  return newton_from_rigid(1, 0);
}

template <int D>
bool Shooting<D>::solve_few_arcs() {
  few_counts_.assign(rod_.arcs_per_span().begin(), rod_.arcs_per_span().end());
  for (int& count : few_counts_) count = std::max(1, count / 4);
  few_arcs_->set(rod_.way(), few_counts_, rod_.law(), rod_.model(), 1e-3);
  few_arcs_->forget_work();
  return few_arcs_->segments_.size() == 1 && few_arcs_->solve_at_once();
}

template <int D>
bool Shooting<D>::solve_at_once() {
  if (loads_all_but_follow()) return solve_from_tip();
  if (has_few_arcs() && solve_few_arcs()) {
    set_load(1);
    nodes_ = few_arcs_->nodes_;
    slope_ = few_arcs_->slope_;
    has_own_derivatives_ = few_arcs_->has_own_derivatives_;
    newton_steps_ += few_arcs_->newton_steps_;
    return newton_one_segment(true, newton_tolerance_);
  }
  start_from_clamp();
  return solve_from_start();
}

// All but a rigid turn of the tip away: the step back leaves what the clamp strays of it, and so does the next.
template <int D>
bool Shooting<D>::solve_from_tip() {
  set_load(1);
  Node state{Rotation::Identity(), {}};
  rod_.march({0, rod_.arc_count()}, state);
  nodes_[0] = {state.rotation_SB.transpose(), {}};
  return newton_from_rigid(bounds_.clamp_straying, std::min(bounds_.clamp_straying, 0.1));
}

template <int D>
bool Shooting<D>::newton_from_rigid(double first_shrinkage, double least_shrinkage) {
  has_own_derivatives_ = false;
  if constexpr (D == 3) slope_ = -nodes_[0].rotation_SB.transpose();
  else slope_(0, 0) = -1;
  return newton_one_segment(true, newton_tolerance_, nullptr, first_shrinkage, least_shrinkage);
}

template <int D>
bool Shooting<D>::solve_from_here() {
  set_load(1);
  return newton(newton_tolerance_);
}

template <int D>
bool Shooting<D>::solve_near(const Shooting* other, const Angular<double, D>& tip_turn_B) {
  if (!other || segments_.size() > 1 || other->segments_.size() > 1) return solve_from_here();
  set_load(1);
  Rotation& tip_SB = nodes_[0].rotation_SB;
  tip_SB = tip_SB * rotation_matrix(tip_turn_B).transpose();
  slope_ = other->slope_;
  has_own_derivatives_ = false;
  return newton_one_segment(true, newton_tolerance_);
}

template <int D>
bool Shooting<D>::solve_from(const Shooting& fewer) {
  nodes_ = fewer.nodes_;
  newton_steps_ = fewer.newton_steps_;
  set_load(fewer.rod_.load_factor());
  const scene::Determinant determinant = fewer.determinant();
  const OnTheWay way{determinant, leading_turn_rad * std::min(1.0, std::exp(determinant.log_size / 2))};
  copy_derivatives(fewer);
  return newton(newton_tolerance_, &way, true);
}

template <int D>
void Shooting<D>::copy_derivatives(const Shooting& other) {
  slope_ = other.slope_;
  if (segments_.size() > 1) system_ = other.system_;
  has_own_derivatives_ = false;
}

// Of the same rod in the same segments.
template <int D>
bool Shooting<D>::take_derivatives(const Shooting& other) {
  const auto alike = [](const auto& a, const auto& b, auto same) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
  };
  const auto same_arcs = [](ArcRange a, ArcRange b) { return a.first_arc == b.first_arc && a.end_arc == b.end_arc; };
  const LoadedRod<D>& rod = other.rod_;
  if (rod_.model() != rod.model() || !alike(rod_.arcs_per_span(), rod.arcs_per_span(), std::equal_to<>()) ||
      !alike(rod_.way().to, rod.way().to, has_same_section) || !alike(segments_, other.segments_, same_arcs))
    return false;
  copy_derivatives(other);
  return true;
}

template void Shooting<2>::start_unloaded();
template void Shooting<3>::start_unloaded();
template double Shooting<2>::start_from_clamp();
template double Shooting<3>::start_from_clamp();
template bool Shooting<2>::solve_known_moments();
template bool Shooting<3>::solve_known_moments();
template bool Shooting<2>::solve_at_once();
template bool Shooting<3>::solve_at_once();
template bool Shooting<2>::solve_from_here();
template bool Shooting<3>::solve_from_here();
template bool Shooting<2>::solve_near(const Shooting<2>*, const Angular<double, 2>&);
template bool Shooting<3>::solve_near(const Shooting<3>*, const Angular<double, 3>&);
template bool Shooting<2>::solve_from(const Shooting<2>&);
template bool Shooting<3>::solve_from(const Shooting<3>&);
template bool Shooting<2>::take_derivatives(const Shooting<2>&);
template bool Shooting<3>::take_derivatives(const Shooting<3>&);

}  // namespace fam
