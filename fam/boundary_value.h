// Scenes with loads in the base frame: a two-point boundary value problem over the arcs, solved by shooting
// (fam/shooting.h) while the load grows (fam/load_growth.h).
#pragma once

#include "fam/load_growth.h"
#include "fam/march.h"

#include <optional>

namespace fam {

// In space, D = 3, or for rods in the x-y plane, D = 2 (spans with nothing out of it). A planar rod may still buckle
// out of its plane, so its stability is judged in space all the same.
template <int D>
class BasicBoundaryValue {
 public:
  void reserve(const Room& room);
  // Any coupled law; every kind of load. The spans must stay where they are. Takes memory where more arcs, segments or
  // spans are asked for than ever before; nothing else here does. fewer: of the same way, whose arcs these divide, for
  // run_from().
  void set(const LoadWay& way, std::span<const int> arcs_per_span, Law law, RodModel model,
           double newton_tolerance = tightest_newton_tolerance, const BasicBoundaryValue* fewer = nullptr);

  // From no load, which the way must start with, to the full load. converged, load_step_too_small, work_limit,
  // tendon_collapsed, not_converged or not_finite; message() says why. Beside or beyond a critical point it pauses,
  // not_converged, before an arc swings by more than swing_limit_rad.
  scene::Status run(double swing_limit_rad = std::numeric_limits<double>::infinity());
  bool is_paused() const { return growth_.is_paused(); }
  // The same on from where the one with fewer arcs, that this was set by, paused. not_converged, and not paused: its
  // nodes do not lead to those of these arcs.
  scene::Status go_on_from(const BasicBoundaryValue& fewer_arcs);
  // The same without growing any load, if it is known to lead there; else not_converged.
  scene::Status run_at_once();
  // Along the way from the shape that the rod had (Shooting::start_at), if known as another one's solution, and to
  // where the tip has turned by about so much; also limit_point.
  template <class StateAt>
  scene::Status run_on(const BasicBoundaryValue* last, const Angular<double, D>& tip_turn_B, StateAt&& state_at) {
    if (loads_overflow()) return scene::Status::not_finite;
    shooting_.forget_work();
    shooting_.start_at(state_at);
    typename LoadGrowth<D>::Last solution;
    if (last) solution = {&last->shooting_, &last->growth_, last->is_surely_stable()};
    const scene::Status status = growth_.run_on(shooting_, solution, tip_turn_B);
    return status == scene::Status::converged ? place_arcs() : status;
  }
  // The full load, starting from the solution of the one with fewer arcs that this was set by.
  scene::Status run_from(const BasicBoundaryValue& fewer_arcs);

  int arc_count() const { return shooting_.rod().arc_count(); }
  const std::vector<BasicArc<D>>& arcs() const { return shooting_.marched().arcs; }
  const std::vector<BasicPose<D>>& poses() const { return poses_; }
  // What dense output needs (shape.h), after a converged run.
  SolvedRod<D> solved() const {
    const LoadedRod<D>& rod = shooting_.rod();
    const MarchedArcs<D>& marched = shooting_.marched();
    return {rod.span_arcs(), marched.arcs, poses_, marched.distal_wrenches_S, rod.law(), rod.model()};
  }
  int segment_count() const { return static_cast<int>(shooting_.segments().size()); }
  int load_steps() const { return growth_.load_steps(); }
  bool way_was_smooth() const { return growth_.was_smooth(); }
  double expected_turn_rad() const { return shooting_.expected_turn_rad(); }
  void limit_newton_steps(int most) { growth_.limit_newton_steps(most); }
  int newton_steps() const { return shooting_.newton_steps(); }  // of the last run, and of the one that it started from
  double load_factor() const { return shooting_.rod().load_factor(); }  // reached
  bool nears_fold() const { return growth_.nears_fold(); }              // there
  std::string message() const { return why_ ? why_ : growth_.message(); }

  // Of the equilibrium, a minimum of the energy if it has no conjugate point. Only for fixed forces, gravity and
  // tendons (the caller's to check).
  const Stability& stability() const {
    if (!stability_) stability_ = growth_.judge(shooting_);
    return *stability_;
  }
  // That the loads leave, of a planar rod in its plane.
  bool one_equilibrium() const { return shooting_.one_equilibrium() || shooting_.moments_are_known(); }
  // Whether the loads are too small for a second equilibrium, so that the one found is stable, or the rod was seen to
  // stay stable as they grew.
  bool is_surely_stable() const { return shooting_.is_surely_stable() || growth_.stayed_stable(); }

 private:
  // Sets why_. Their squares are summed.
  bool loads_overflow();
  scene::Status place_arcs();

  Shooting<D> shooting_;
  LoadGrowth<D> growth_;
  std::vector<BasicPose<D>> poses_;
  mutable std::optional<Stability> stability_;  // of the last run that converged, once asked for
  const char* why_ = nullptr;                   // not converged, where it is not the growth of the load that failed
};

using BoundaryValue = BasicBoundaryValue<3>;

}  // namespace fam
