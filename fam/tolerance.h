// The ladder of resolutions: runs with more and more arcs, until the error that two of them show meets the tolerance.
//
// With a fixed number of arcs N the estimate is the largest distance d between the shapes with N and with 2N arcs (at
// the arcs' ends and middles), times 2^p/(2^p - 1) for the law's order p (published: p = 1, its order in 3D). By
// tolerance: see the constants below. Both: plus the round-off 4 eps L sqrt(N). It estimates the discretisation error
// of the chosen rod model; where the automatic choice leaves out shear and stretch, the bound on what they could do is
// added.
#pragma once

#include "fam/engine.h"

#include "scene/equilibrium.h"

#include <vector>

namespace fam {

// A problem solved with some arcs, in memory that is kept from one to the next.
struct Run {
  Engine engine;
  std::vector<int> arcs;  // of each span
  scene::Status status = scene::Status::not_converged;

  void reserve(const Room& room, Law law);
  // Not solved yet.
  void set(const Problem& problem, std::span<const int> arcs_per_span, int factor = 1, const Run* fewer_arcs = nullptr);
  // With `factor` times the arcs of each span, from the solution with fewer arcs, or else from no load.
  void solve(const Problem& problem, std::span<const int> arcs_per_span, int factor = 1,
             const Run* fewer_arcs = nullptr);
  // From no load, where no load has to grow for it (Engine::run_at_once).
  bool solve_at_once(const Problem& problem, std::span<const int> arcs_per_span);
  bool converged() const { return status == scene::Status::converged; }
  bool is_paused() const { return status == scene::Status::not_converged && engine.is_paused(); }
  int arc_count() const { return engine.arc_count(); }
  ArcExtent extent(const Problem& problem) const { return extent_of_arcs(engine, problem.spans(), arcs); }
};

// Automatic choice: runs with N and r N arcs that lie d apart; the estimate is coarse_safety d for the first and
// d (fine_safety / (r^(p - 1) - 1) + distrust d / L) for the second: an order less than the law's, which few arcs do
// not show yet. Two or three arcs may agree by chance: the second's is at least unconfirmed d where no third resolution
// was solved, and at least d where d has not fallen below contraction times the distance before it. No estimate is less
// than L times the turn that Newton's method left out.
constexpr double coarse_safety = 1.5;
constexpr double fine_safety = 4;
constexpr double distrust = 4;
constexpr double unconfirmed = 0.5;
constexpr double contraction = 0.3;
// Beside a critical point the arcs' error decides to which side a rod goes. An answer whose load has passed near one
// with arcs that swing farther does not lead to the next finer one: that one's loads grow from nothing, and so do those
// of one that lies too far from it (leading_turn_rad). So the arcs of the first run are halved on the way, before they
// swing so far. Where two such answers lie within confirming_share of the length the finer one leads. Of 40 000 rods
// that buckle one was led to the other side where any answer led; chosen so, not measured more closely.
constexpr double leading_swing_rad = 1.25;
constexpr double confirming_share = 0.02;
// Two runs of a rod whose loads have an energy that tell its stability apart, by an unstable direction or by the
// logarithm of the determinant, do not show their error: beside a critical point it is as far off as that is near. The
// next one's loads grow from nothing, for more arcs may have led over the critical point. Four times what decides the
// stability (agree), so often at most. Chosen, not measured.
constexpr double apart_share = 4;
constexpr int most_apart = 3;
// Runs that fail within this of the same load, relative, fail by the rod and not by their arcs.
constexpr double same_load = 1e-3;

// What rounding may do to a run at least.
double round_off_mm(const Problem& problem, const Run& run);

// The error of a run as its own number of arcs doubled shows it, in a spare run; infinite where that one fails.
double estimate_by_doubling_mm(const Problem& problem, const Run& run, Run& spare);

// What the ladder ends with: the run that meets the tolerance (status converged), or the last; and the other one.
struct Found {
  Run* run;
  Run* other;
  scene::Status status;
  double error_mm = 0;
};
// Where a fold ends it, the first arcs that meet one do: for who then follows the path, which finds its own arcs.
Found solve_to_tolerance(const Problem& problem, Run& first, Run& second, bool fold_ends_it = false);

}  // namespace fam
