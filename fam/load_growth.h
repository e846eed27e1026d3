// How the load of a boundary value problem grows from zero, and which steps keep to the branch.
//
// Where the loads are too small for a second equilibrium or all but follow (Shooting::one_equilibrium), or there is
// none because the moments are known beforehand, the full load is solved for at once. So it is where that ends beside
// the rest shape, without a critical point on the way (ends_beside_rest). Elsewhere it grows from zero in steps; a step
// is taken only if Newton converges as it does near a solution (Contraction), and no segment end turns by more than
// largest_turn_rad in it nor lies farther than largest_surprise_rad, or than a share of the turn, from where the last
// steps, or the tangent at the start, pointed (the limits are wider where no critical point is near), nor in the plane
// from where the tangents at both its ends lead. Beside a buckling or turning point the branches lie too close to be
// told apart by their distance, but the sign of the equations' determinant differs from one to the next: a step that
// changes it is shortened as well, or one that leads on to where it vanishes (scene/branch_watch.h). Where the loads
// have an energy one that ends unstable is shortened as well, but passes below smallest_bifurcation_step if its
// symmetry can hold the rod there: in the plane, whose determinant is that of motions in it alone, and on the axis (a
// column loaded exactly on its axis stays straight), where none is watched. Whether it does is asked beside a critical
// point, and in space where Newton's derivatives met conjugate points: two that are passed at once leave the
// determinant its sign. Of 30 000 strips two passed them so, and ended unstable. Past a critical point arcs that swing
// far may lead a rod to another side than it goes to, so that the growth can be paused before they do and go on with
// more (tolerance.h). So the answer is the equilibrium that the rod reaches when its loads grow together from zero; a
// snap-through ends in load_step_too_small, soon where scene/branch_watch.h foretells its fold (fam/limit.h).
#pragma once

#include "fam/options.h"
#include "fam/shooting.h"
#include "fam/stability.h"

#include "scene/branch_watch.h"
#include "scene/equilibrium.h"

#include <optional>
#include <string>
#include <vector>

namespace fam {

// Growing the load ends in work_limit after most_newton_steps (options.h), or this many arcs marched, or most_passes
// times the rod's arcs, if that is more. Nearly all random scenes that are solved need up to 900 steps and 250 000 arcs;
// fam/limit.h goes on.
constexpr long long most_arcs_marched = 300'000;

template <int D>
class LoadGrowth {
 public:
  void reserve(const Room& room);
  // For a rod whose loads are to grow; takes memory where more arcs, segments or spans are asked for than ever before.
  void set(const Shooting<D>& shooting);
  void limit_newton_steps(int most) { most_newton_steps_ = most; }

  // From no load to the full load. converged, load_step_too_small, not_converged, work_limit or tendon_collapsed; where
  // the moments are known converged or arc_not_converged. Where a critical point is near, or was before, it pauses at
  // the last load at which no arc swings by more than the limit (load_length.h): not_converged.
  scene::Status run(Shooting<D>& shooting, double swing_limit_rad);
  // On from the load at which that of a rod with fewer arcs paused, whose nodes there led to those of this one.
  scene::Status go_on(Shooting<D>& shooting, const LoadGrowth& fewer_arcs);
  bool is_paused() const { return is_paused_; }
  // The same without growing any load. False: that is left.
  bool run_at_once(Shooting<D>& shooting);
  // The solution at which a way starts; null where it is not known. stable: surely.
  struct Last {
    const Shooting<D>* shooting = nullptr;
    const LoadGrowth* growth = nullptr;
    bool stable = false;
  };
  // From the shape that the nodes hold at the start of the way, and to where the tip has turned by about so much; also
  // limit_point.
  scene::Status run_on(Shooting<D>& shooting, const Last& last, const Angular<double, D>& tip_turn_B);
  // Why not converged.
  std::string message() const;

  // Of the nodes at the present load; only for fixed forces, gravity and tendons.
  Stability judge(const Shooting<D>& shooting) const {
    return judge_(shooting.rod(), shooting.segments(), shooting.nodes());
  }
  // Whether the way ends before the full loads, at a fold: the square of the determinant foretells its load.
  bool nears_fold() const { return way_.watches_determinant && way_.branch.nears_fold_before(1); }
  int load_steps() const { return way_.load_steps; }
  // Whether no critical point was near on the way.
  bool was_smooth() const { return way_.was_smooth; }
  // Whether the rod was stable at the start of such a way, on which the determinant of its motions in space was
  // watched: then it is at the end.
  bool stayed_stable() const { return D == 3 && way_.was_smooth && way_.watches_determinant && way_.watches_stability; }
  // At the solution with more arcs, whose determinant is this.
  void take_over(const LoadGrowth& fewer_arcs, const scene::Determinant& now) {
    way_ = fewer_arcs.way_;
    if (way_.watches_determinant && scene::has_fallen(way_.start, now)) way_.was_smooth = false;
  }

 private:
  using Nodes = std::vector<SectionState<D>>;
  using Tangent = std::vector<Fields<D, 1>>;  // of the nodes by the load factor

  void forget_way();
  scene::Status solve_known_moments(Shooting<D>& shooting);
  // The full load at once, from the march from the clamp, to a shape so near to the rest shape that no critical point
  // is taken to lie between them. Only for loads with an energy.
  bool ends_beside_rest(Shooting<D>& shooting);
  // size: of the change of the loads; 1 is too little to make a straight rod critical.
  scene::Status grow_from(Shooting<D>& shooting, const Last& last, double size);
  // From the start of the way, whose derivatives are at hand.
  scene::Status grow(Shooting<D>& shooting, double size);
  scene::Status grow_on(Shooting<D>& shooting);
  // After a step in which a node turned by so much.
  bool swings_too_far(Shooting<D>& shooting, double turn_rad);
  // stable: known to be.
  void start_watch(const Shooting<D>& shooting, bool stable);
  // How many times the nodes change by what they did since the last loads but one and two, and by the tangent.
  struct Shares {
    double previous = 0, earlier = 0, tangent = 0;
  };
  Shares predicted_shares(double factor) const;
  void predict(const Shooting<D>& shooting, const Shares& shares);
  // Before or after a step to where the determinant is this.
  bool nears_critical(const scene::Determinant& now) const {
    return way_.near_critical || scene::has_fallen(way_.start, now);
  }
  // The largest turn in a step, the largest rotation that was not predicted, and this as a share of the former, in
  // units of what is allowed.
  struct StepSize {
    double turn = 0, surprise = 0, unled = 0;
  };
  double growth_after(const StepSize& size) const;
  // After a step of this length in which a node turned by so much; sets next_tangent_.
  bool follows_tangents(Shooting<D>& shooting, double step, double turn_rad);
  std::optional<StepSize> try_step(Shooting<D>& shooting, double to);
  bool is_unstable(const Shooting<D>& shooting) { return judge(shooting).conjugate_points > 0; }
  bool stays_on_branch(Shooting<D>& shooting, double step);
  bool gives_up(const Shooting<D>& shooting, double step);

  Nodes start_, guess_;       // of a step
  Nodes previous_, earlier_;  // at the last loads but one and two
  Tangent tangent_;           // where the way starts, in the plane at the present load
  Tangent next_tangent_;      // in the plane where a step leads
  // What is known of the way so far.
  struct Way {
    double load_factor = 0, previous_factor = 0, earlier_factor = 0, first_step = 1, next_step = 1;
    scene::BranchWatch branch;
    scene::Determinant start;
    bool near_critical = false;  // now; where it is not, the way is taken for smooth
    bool was_smooth = true;
    bool watches_determinant = false;
    bool watches_stability = false;  // the loads have an energy, and the rod was stable so far
    bool may_fall = false;           // where its symmetry can hold it
    int load_steps = 0;
    // Of the changes of the loads since another solve took the derivatives that this one started with.
    double size_since_derivatives = std::numeric_limits<double>::infinity();
    bool keeps_derivatives = false;  // those serve for the first step
    double swing_limit_rad = std::numeric_limits<double>::infinity();
    double swing_rad = 0;  // of an arc: measured, and the turns of the nodes since then
  } way_;
  bool is_paused_ = false;
  int most_newton_steps_ = most_newton_steps;
  int conjugate_points_ = 0;  // in space, met where Newton took its last derivatives
  mutable StabilityJudge<D> judge_;
  struct {
    scene::Status status = scene::Status::converged;
    double smallest_step = 0;  // where steps fell below it
    int newton_steps = 0;      // where the work was used up
  } end_;
};

}  // namespace fam
