// What a solve is asked for.
#pragma once

#include "fam/law.h"
#include "fam/published_arc.h"

#include "scene/rod_model.h"

namespace fam {

constexpr int max_arcs = 1'000'000;
constexpr int most_unreserved_arcs = 65'536;
constexpr int most_newton_steps = 3000;  // while loads grow (load_growth.h)

struct Options {
  Law law = Law::automatic;                         // automatic: sixth_order
  // automatic: Kirchhoff unless the scene, or a Solver's derivatives, stretch or shear visibly (model_choice.h)
  RodModel model = RodModel::automatic;
  TwistOrder twist_order = TwistOrder::bend_twist;  // of the published law

  // Number of arcs, 1..max_arcs; 0: as many as the tolerance asks for. Each span between section changes and loads
  // gets at least one, whatever is asked for.
  int arcs = 0;
  // Largest error wanted of any place along the rod, mm; 0: 1e-3 of its length. Where arcs are given it only tells a
  // Solver where to end Newton's method.
  double tolerance_mm = 0;

  // With a fixed number of arcs the error estimate takes a second march of twice as many; false leaves it out (0).
  bool estimate_error = true;

  // Of fam::solve. False: of the stations the clamp's and the tip's alone, neither shortenings of tendons nor facts of
  // the model; then the answer costs little beside the solve.
  bool whole_rod = true;

  // Of fam::solve, where the growing load meets a fold: true, the next equilibrium under the full load on the rod's
  // path that is stable (the next at all where the loads have no energy), in place of limit_point.
  bool after_snap = false;

  // Of fam::solve, where the growing load gets stuck: false leaves out the search for the fold (up to seconds), and the
  // status is the growth's own. Without effect where after_snap asks for more.
  bool locate_limit = true;

  // Of a Solver: arcs that memory is taken for, those of the estimate's finer run included, 1..max_arcs. 0: for none;
  // solves take what they need, for 65 536 arcs at most unless more are asked for. A single solve is faster so.
  int reserved_arcs = 1024;

  // Of fam::solve_batch: threads that share the rows; 0: as many as the machine runs at once.
  int threads = 1;
};

// What is asked of a rod of this length.
inline double tolerance_mm(const Options& options, double length_mm) {
  return options.tolerance_mm > 0 ? options.tolerance_mm : 1e-3 * length_mm;
}

}  // namespace fam
