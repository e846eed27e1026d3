#include "exact_reference/boundary_value.h"

#include "exact_reference/limit.h"
#include "exact_reference/prediction.h"
#include "exact_reference/shape.h"
#include "exact_reference/shooting.h"
#include "exact_reference/solve.h"
#include "exact_reference/stability.h"
#include "scene/branch_watch.h"
#include "scene/path.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace exact_reference {
namespace {

constexpr int initial_intervals = 16;
constexpr int max_intervals = 400'000;
constexpr double largest_miss_rad = 0.1;  // corrected against predicted rotation
// Of any section in a load step, as a chord: beyond, a rod may be wound past where it buckles. Coils take a half to a
// third of the time that they take with 0.8.
constexpr double largest_turn = 2;
constexpr double first_turn_rad = 0.1;
constexpr int most_load_steps = 3000;
constexpr double most_work = 300'000;  // intervals linearised: seconds
// Of a path back: up to 40 ms. On more intervals (cables, coils) most take as long as the exact reference itself.
constexpr double most_work_back = 3000, most_intervals_back = 32;
constexpr double stuck_step = 0.1;            // of the longest taken; chosen, not measured
constexpr double most_rest_turn_rad = 1e4;    // two intervals a radian, and so seconds, too
constexpr double longest_step_on_way = 0.05;  // loads that turn back pass where branches meet; chosen, not measured
constexpr double smallest_step = 1e-8;        // of the load reached or of the first step, whichever is larger

struct Tolerances {
  double local_error, volume_change, newton;
};
constexpr Tolerances on_the_way{1e-6, 1e-3, 1e-8};

// Largest rotation between two sets of node states; a small quaternion change is half a rotation.
double turn_between(const NodeStates& a, const NodeStates& b) {
  double turn = 0;
  for (std::size_t k = 0; k < b.size(); ++k) turn = std::max(turn, 2 * (a[k] - b[k]).head<4>().norm());
  return turn;
}

struct Path {
  Shooting shooting;
  NodeStates y;
  double load = 0, trial = 0, longest_taken = 0;  // of the steps: tried last, and taken
  int steps = 0;
  int newton_iterations = 0;
  std::size_t fewest_intervals = shooting.mesh().size();
  bool tendon_collapsed = false;  // in the last iteration
  bool watch_stability = false;   // conservative, and stable so far
  bool unloads = false;           // the loads that it ends at are none
  scene::Symmetry symmetry = scene::Symmetry::none;
  double load_size = 0;  // of ScaledRod
  double longest_step = 1;
  double most_work_at_all = most_work;
  MeshedStates far = {};  // the last state that a step of far_step led to, at far_load
  double far_load = 0;
  scene::BranchWatch branch = {};  // by the determinant of the equations' derivatives

  Convergence newton(NodeStates& states, double load_factor, double tolerance, int max_iterations) {
    const double left = std::max(0.0, most_work_here() - shooting.work()) / static_cast<double>(shooting.mesh().size());
    max_iterations = std::min(max_iterations, 1 + static_cast<int>(std::min(left, 100.0)));
    const Convergence result = shooting.newton(states, load_factor, tolerance, max_iterations);
    newton_iterations += result.iterations;
    tendon_collapsed = result.tendon_collapsed;
    return result;
  }

  double most_work_here() const { return most_work_at_all + 100 * static_cast<double>(fewest_intervals); }
  bool exhausted() const { return shooting.work() > most_work_here(); }
};

// Beside a buckling or turning point the branches lie too close to be told apart by their distance: a step whose
// determinant changes its sign is refused, too. It is that of motions which the rod's symmetry allows: a column loaded
// exactly on its axis stays on it, where none is watched, and a rod bent in a plane passes where it would leave it
// sideways. With loads that have an energy a step from a stable to an unstable equilibrium is refused as well, unless
// it is as short as this.
constexpr double smallest_bifurcation_step = 1e-5;

bool watches_determinant(const Path& path) {
  return path.symmetry != scene::Symmetry::axis;
}

// scene::Determinant::log_growth: of a taut rod the determinant is cosh(int sqrt(N_x / EI) ds) for each plane of
// bending.
double log_growth(const Path& path, const NodeStates& y) {
  double sum = 0;
  for (std::size_t k = 0; k < path.shooting.mesh().size(); ++k) {
    const Eigen::Vector3d tangent_B = rotation_of(y[k].head<4>()).col(0);
    const double tension = std::max(0.0, tangent_B.dot(y[k].segment<3>(4)));
    const Interval& interval = path.shooting.mesh()[k];
    const Eigen::Vector3d& compliance = path.shooting.rod().spans[interval.span].bending_compliance;
    sum += interval.length * std::sqrt(tension) * (std::sqrt(compliance[1]) + std::sqrt(compliance[2]));
  }
  return sum;
}

scene::Determinant determinant_of(const Path& path, const NodeStates& y, double load_factor) {
  scene::Determinant result = path.shooting.determinant(y, load_factor);
  if (path.unloads) result.log_growth = log_growth(path, y);
  return result;
}

// The determinant a little before the first load, so that the first step has two to go by.
void look_back(Path& path) {
  const double little = 0.01 / std::max(path.load_size, 1.0);
  NodeStates y = path.y;
  path.newton(y, -little, on_the_way.newton, 8);
  path.branch.keep(-little, determinant_of(path, y, -little));
  path.branch.keep(0, determinant_of(path, path.y, 0));
}

// Of the load reached. The search for a fold starts from the last state that such a step led to: where steps have
// shrunk to nothing it would start within round-off of the fold, or behind it.
constexpr double far_step = 1e-3;

// Predicts, corrects, judges one step from the state that the prediction belongs to; leaves the path as it was if it is
// refused. Returns the miss, infinite if refused.
double try_step(Path& path, const Prediction& prediction, double step) {
  const NodeStates predicted = prediction.ahead(path.y, step);
  NodeStates corrected = predicted;
  const Convergence newton = path.newton(corrected, path.load + step, on_the_way.newton, 8);
  const double miss = turn_between(corrected, predicted);
  const bool jumped = !(miss <= largest_miss_rad) || !(turn_between(corrected, path.y) <= largest_turn);
  if (!newton.converged || jumped) return HUGE_VAL;
  scene::Determinant determinant;
  if (watches_determinant(path)) determinant = determinant_of(path, corrected, path.load + step);
  if (path.branch.has_left(determinant)) return HUGE_VAL;
  if (path.watch_stability && falling_directions(path.shooting, corrected, path.load + step).value_or(0) > 0) {
    if (step > smallest_bifurcation_step) return HUGE_VAL;
    path.watch_stability = false;
  }
  path.y = std::move(corrected);
  path.branch.keep(path.load + step, determinant);
  return miss;
}

// Refines until each local error is below the tolerance; Newton's iteration after each refinement.
bool adapt(Path& path, const Tolerances& tolerances) {
  constexpr int most_rounds = 20;
  for (int round = 0; round < most_rounds; ++round) {
    path.shooting.integrate_positions(path.y, path.load);
    if (!path.shooting.refine(path.y, path.load, tolerances.local_error, tolerances.volume_change, max_intervals))
      return true;
    const Convergence newton = path.newton(path.y, path.load, tolerances.newton, 12);
    if (!newton.converged) return false;
  }
  return true;
}

bool follow_load(Path& path) {
  double first_step = 0;
  double step = 1;
  Prediction prediction;
  if (watches_determinant(path)) look_back(path);
  while (path.load < 1) {
    const std::vector<Core> tangent = path.shooting.tangent(path.y, path.load);
    prediction.start_at(path.y, path.load, tangent);
    if (first_step == 0) {
      double slope = 0;
      for (const Core& t : tangent) slope = std::max(slope, 2 * t.head<4>().norm());
      // From no loads a tangent tells nothing of critical points.
      const double longest = path.unloads ? 1 : 1 / std::max(path.load_size, 1.0);
      step = first_step = std::min(longest, first_turn_rad / std::max(slope, first_turn_rad));
      if (!(first_step > 0)) return false;  // a load or a slope overflows
    }
    step = std::min({step, path.longest_step, path.branch.longest_step(path.load)});
    double miss = HUGE_VAL;
    for (;;) {
      const bool to_the_end = path.load + 1.01 * step >= 1;
      const double trial = to_the_end ? 1 - path.load : step;
      path.trial = trial;
      miss = try_step(path, prediction, trial);
      if (miss < HUGE_VAL) {
        path.longest_taken = std::max(path.longest_taken, trial);
        path.load = to_the_end ? 1 : path.load + trial;
        step = trial;
        break;
      }
      if (path.exhausted()) return false;
      step = trial / 2;
      if (step < smallest_step * std::max(path.load, first_step)) return false;
    }
    if (++path.steps > most_load_steps || path.exhausted()) return false;
    if (!adapt(path, on_the_way)) return false;
    if (step >= far_step * path.load) {
      path.far = {path.shooting.mesh(), path.y};
      path.far_load = path.load;
    }
    step *= std::clamp(std::cbrt(largest_miss_rad / 4 / std::max(miss, 1e-6)), 0.5, 3.0);
  }
  return true;
}

// The path stands under the loads that the rod had, and will go from there to its own.
bool start_stage(Path& path, const ScaledRod& rod) {
  path.load = 0;
  path.shooting.forget();
  path.symmetry = rod.symmetry;
  path.load_size = rod.load_size();
  path.branch = {};
  path.far = {};
  if (!adapt(path, on_the_way)) return false;
  path.far = {path.shooting.mesh(), path.y};
  path.far_load = 0;
  return true;
}

// Largest error of a node's position over L, estimated by the change that halving the mesh makes; keeps the finer mesh.
// Negative: not converged.
double solve_accurately(Path& path, double tolerance) {
  const double local_tolerance = std::max(tolerance / 20, 1e-14);
  constexpr double undetermined = 1e-11;  // an update that round-off keeps from falling further
  double update = 0;
  const auto converge = [&] {
    const Convergence newton = path.newton(path.y, 1, 1e-15, 20);
    update = newton.last_update;
    path.shooting.integrate_positions(path.y, 1);
    return newton.converged;
  };
  if (!converge() || !adapt(path, {local_tolerance, 1e-6, 1e-15})) return -1;
  double change = HUGE_VAL;
  for (int halvings = 0; halvings < 3; ++halvings) {
    const NodeStates coarse = path.y;
    path.shooting.halve(path.y, 1);
    if (!converge()) return -1;
    const double last = change;
    change = 0;
    for (std::size_t k = 0; k < coarse.size(); ++k) {
      change = std::max(change, (path.y[2 * k].tail<3>() - coarse[k].tail<3>()).norm());
    }
    if (change <= tolerance || change > last / 2) break;
  }
  const double roundoff = 4e-16 * std::sqrt(static_cast<double>(path.shooting.mesh().size()));
  return change + roundoff + (update > undetermined ? update : 0);
}

void set_stability(scene::Equilibrium& result, const ScaledRod& rod, const Path& path) {
  if (!rod.has_energy()) return;  // not conservative: energy does not decide
  const std::optional<int> falling = falling_directions(path.shooting, path.y);
  if (!falling) return;
  result.stable = *falling == 0;
  result.model.emplace_back("falling_directions", *falling);
}

double rest_turn_rad(const ScaledRod& rod) {
  double turn = 0;
  for (const ScaledSpan& span : rod.spans) turn += span.length() * span.rest_curvature_S.norm();
  return turn;
}

std::string text(const char* format, double value) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::optional<double> fold_beyond(const ScaledRod& rod, const Path& path) {
  if (path.far.y.empty()) return std::nullopt;
  return fold_ahead(rod, path.far, path.far_load);
}

scene::Equilibrium stopped(const ScaledRod& rod, const Path& path) {
  scene::Equilibrium result;
  result.status = scene::Status::load_step_too_small;
  result.message =
      text("no equilibrium found next to the one at %.6g of the load: a fold, or too large a load", path.load);
  if (path.tendon_collapsed || tendon_has_collapsed(rod, path.shooting, path.y, path.load)) {
    result.status = scene::Status::tendon_collapsed;
    result.message = text("the path of a tendon has no length somewhere beyond %.6g of the load", path.load);
  } else if (path.exhausted() || path.steps > most_load_steps) {
    result.status = scene::Status::work_limit;
    result.message = text("given up at %.6g of the load: a rod that turns so much takes too many steps", path.load);
  } else if (const auto fold = fold_beyond(rod, path)) {
    result.status = scene::Status::limit_point;
    result.message = text("snaps at %.1f %% of the load", 100 * *fold);
    result.limit = {*fold, name(scene::PathPoint::Kind::fold)};
  }
  return result;
}

// The rod whose loads are its own at first and shrink to none.
ScaledRod unloading(ScaledRod rod) {
  for (ScaledSpan& span : rod.spans) {
    span.before = span;
    static_cast<SpanLoads&>(span) = {};
    for (ScaledTendon& tendon : span.tendons) tendon = {tendon.arm_S, 0, tendon.tension};
  }
  return rod;
}

}  // namespace

std::optional<bool> leads_back(const ScaledRod& rod, const MeshedStates& equilibrium) {
  if (static_cast<double>(equilibrium.mesh.size()) > most_intervals_back) return std::nullopt;
  const ScaledRod back = unloading(rod);
  Path path{Shooting(back, equilibrium.mesh), equilibrium.y};
  path.most_work_at_all = most_work_back;
  path.fewest_intervals = 0;
  if (!path.newton(path.y, 0, on_the_way.newton, 8).converged || !start_stage(path, back)) return false;
  path.load_size = rod.load_size();
  path.watch_stability = rod.has_energy();
  path.unloads = true;
  if (follow_load(path)) return true;
  const bool shrinks = path.trial < stuck_step * path.longest_taken;  // as before a fold
  if (path.exhausted() && !shrinks) return std::nullopt;
  return false;
}

scene::Equilibrium solve_boundary_value(std::span<const ScaledRod> way, double tolerance, MeshedStates* reached) {
  scene::Equilibrium result;
  ScaledRod rod = way.front();
  if (!(rest_turn_rad(rod) <= most_rest_turn_rad)) {
    result.status = scene::Status::not_converged;
    result.message = "the rest shape turns by more than 1e4 rad";
    return result;
  }
  Path path{Shooting(rod, initial_intervals), {}};
  path.y = path.shooting.unloaded();
  if (way.size() > 1) path.longest_step = longest_step_on_way;
  for (const ScaledRod& stage : way) {
    const bool first = &stage == &way.front(), had_energy = first || rod.has_energy();
    rod = stage;
    if (!start_stage(path, rod)) return stopped(rod, path);
    path.watch_stability =
        had_energy && rod.has_energy() && (first || falling_directions(path.shooting, path.y, 0).value_or(0) == 0);
    if (!follow_load(path)) return stopped(rod, path);
  }
  if (reached != nullptr) *reached = {path.shooting.mesh(), path.y};
  const double error = solve_accurately(path, tolerance);
  if (error < 0 && path.exhausted()) return stopped(rod, path);
  if (!(error >= 0 && error <= std::max(worst_error, tolerance))) {
    result.status = scene::Status::not_converged;
    result.message = text("the tip still moves by %.3g of the length when the mesh is halved", std::abs(error));
    if (error < 0) result.message = "Newton's iteration does not converge on the fine mesh";
    return result;
  }
  result.status = scene::Status::converged;
  set_shape(result, rod, path.shooting, path.y);
  result.error_estimate_mm = error * rod.length_mm;
  result.model.emplace_back("intervals", static_cast<int>(path.shooting.mesh().size()));
  result.model.emplace_back("unknowns", core_size * static_cast<int>(path.y.size()));
  result.model.emplace_back("load_steps", path.steps);
  result.model.emplace_back("newton_iterations", path.newton_iterations);
  set_stability(result, rod, path);
  return result;
}

}  // namespace exact_reference
