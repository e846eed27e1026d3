#include "fam/limit.h"

#include "fam/answer.h"
#include "fam/path_walk.h"
#include "scene/load_visitor.h"

#include <algorithm>
#include <sstream>

namespace fam {
namespace {

using scene::Equilibrium;
using scene::Status;
using Kind = scene::PathPoint::Kind;

// All but the last two chosen, not measured.
constexpr double lowest_factor = -1, highest_factor = 2;  // how far the path may stray
constexpr double longest_load_step = 0.05;
constexpr double way_tolerance = 1e-4;    // of the length, on the way to a fold
constexpr double limit_tolerance = 1e-6;  // of a fold's load, at most: six digits
// Of 22 000 random scenes 263 walks arrive or fold, within 1344 points; two creep past a tendon's kink for over 9000.
constexpr int most_limit_points = 3'000;
// Of 12 000 random scenes 154 end here: walks that arrive or fold march up to 3.1 million arcs, four more than 8.
constexpr long long most_limit_arcs = 4'000'000;  // a quarter of a minute, half a minute with tendons

PathWalk::Settings settings_for(const scene::Scene& scene) {
  const bool pulls = std::any_of(scene.loads.begin(), scene.loads.end(),
                                 [](const scene::Load& load) { return scene::tendon_of(load) != nullptr; });
  PathWalk::Settings settings;
  settings.range = {pulls ? 0 : lowest_factor, highest_factor, 1, true, limit_tolerance, false};
  settings.to = highest_factor;
  settings.stops = {1};
  settings.largest_step = longest_load_step;
  settings.most_points = most_limit_points;
  settings.most_arcs = most_limit_arcs;
  return settings;
}

// Where arcs are given there is no tolerance to be missed.
bool misses(const Problem& problem, double error_mm) {
  return problem.options().arcs == 0 && !(error_mm <= problem.tolerance_mm());
}

// The equilibrium under the full loads that a place of the path is near, on as many arcs as the tolerance takes.
std::optional<Equilibrium> equilibrium_at(const scene::Scene& scene, const Options& options, PathStepper& stepper,
                                          const SavedPlace& saved, bool after_snap) {
  const PathPlace place = stepper.restored(saved);
  stepper.equations().set_parameter(1);
  const std::vector<SectionState<3>> states = stepper.equations().states(place.state);
  Problem before, problem;
  before.set(scene, options);
  problem.set(scene, options, before);
  problem.leave_plane();
  Run run;
  run.set(problem, saved.mesh.arcs);
  run.status =
      run.engine.run_on(nullptr, Vector3d::Zero(), [&](int arc) { return states[static_cast<std::size_t>(arc)]; });
  double error_mm = place.accuracy.error_mm;
  for (Run finer; run.converged() && misses(problem, error_mm); std::swap(run, finer)) {
    error_mm = estimate_by_doubling_mm(problem, run, finer);
    if (!misses(problem, error_mm) || 2 * finer.arc_count() > max_arcs) break;
  }
  if (!run.converged()) return std::nullopt;
  if (misses(problem, error_mm)) return tolerance_not_met(problem, run, error_mm);
  std::optional<bool> stable;
  if (place.index) stable = *place.index == 0;
  Solution solution;
  Equilibrium result = success(problem, run, error_mm, stable,
                               after_snap ? "after the rod has snapped" : "its path followed by arc length", solution);
  if (after_snap) result.model.emplace_back("after_snap", true);
  return result;
}

Equilibrium stopped(Status status, const std::string& what, double load_factor) {
  Equilibrium result;
  result.status = status;
  std::ostringstream message;
  message.precision(3);
  message << what << " at " << 100 * load_factor << " % of the load";
  result.message = message.str();
  return result;
}

Equilibrium limit_at(double load_factor) {
  Equilibrium result = stopped(Status::limit_point, "snaps", load_factor);
  result.limit = scene::Limit{load_factor, scene::name(Kind::fold)};
  return result;
}

}  // namespace

std::optional<Equilibrium> beyond_growth(const scene::Scene& scene, const Options& options) {
  scene::PathRequest request;
  request.scene = scene;
  const PathWalk::Settings found = settings_for(scene);
  request.from = found.from;
  request.to = found.to;
  Options on_path = options;
  const double tolerance_mm = way_tolerance * scene::length_mm(scene);
  on_path.tolerance_mm = options.tolerance_mm > 0 ? std::min(options.tolerance_mm, tolerance_mm) : tolerance_mm;
  PathWalk::Settings settings = found;
  std::optional<double> fold;
  bool arrived = false;
  const PathStepper* stepper = nullptr;
  settings.ends_at = [&](const PathPlace& place, Kind kind) {
    // Of a rod without symmetry: the walk has left the branch beside a near one.
    if (kind == Kind::branch && !place.index && stepper->equations().held() == scene::Symmetry::none) return true;
    if (kind == Kind::fold && !fold) fold = place.state.parameter;
    if (kind == Kind::fold) return !options.after_snap;
    arrived = place.state.parameter == 1 && (!fold || place.index.value_or(0) == 0);
    return arrived;
  };
  PathWalk walk(request, on_path, settings);
  stepper = &walk.stepper();
  walk.run();
  if (arrived) {
    if (auto there = equilibrium_at(scene, options, walk.stepper(), walk.places().back(), fold.has_value()))
      return there;
  }
  if (fold) return limit_at(*fold);
  if (walk.tendon_collapsed()) {
    const double reached = walk.path().points.back().parameter;
    return stopped(Status::tendon_collapsed, "a tendon's path has no length somewhere, |v + u x r| = 0,", reached);
  }
  return std::nullopt;
}

}  // namespace fam
