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

// All chosen, not measured.
constexpr double start_share = 0.95;                      // of the load reached, where the path starts
constexpr double lowest_factor = -1, highest_factor = 2;  // how far the path may stray
constexpr double longest_load_step = 0.05;
constexpr double limit_tolerance = 1e-6;  // of the length: a fold's load is then right to six digits
constexpr int most_limit_points = 3000;
constexpr long long most_limit_arcs = 300'000;  // solved: some seconds

PathWalk::Settings settings_for(const scene::Scene& scene, double reached) {
  const bool pulls = std::any_of(scene.loads.begin(), scene.loads.end(),
                                 [](const scene::Load& load) { return scene::tendon_of(load) != nullptr; });
  PathWalk::Settings settings;
  settings.range = {pulls ? 0 : lowest_factor, highest_factor, 1};
  settings.from = start_share * reached;
  settings.to = highest_factor;
  settings.stops = {1};
  settings.largest_step = longest_load_step;
  settings.most_points = most_limit_points;
  settings.most_arcs = most_limit_arcs;
  return settings;
}

// The equilibrium under the full loads that a place of the path is near.
std::optional<Equilibrium> equilibrium_at(const scene::Scene& scene, const Options& options, PathStepper& stepper,
                                          const SavedPlace& saved) {
  const PathPlace place = stepper.restored(saved);
  stepper.equations().set_parameter(1);
  const std::vector<SectionState<3>> states = stepper.equations().states(place.state);
  Problem before, problem;
  before.set(scene, options);
  problem.set(scene, options, before);
  problem.leave_plane();
  Run run;
  run.set(problem, saved.mesh.arcs);
  run.status = run.engine.run_on([&](int arc) { return states[static_cast<std::size_t>(arc)]; });
  if (!run.converged()) return std::nullopt;
  std::optional<bool> stable;
  if (place.index) stable = *place.index == 0;
  Equilibrium result = success(problem, run, place.accuracy.error_mm, stable, "after the rod has snapped");
  result.model.emplace_back("after_snap", true);
  return result;
}

Equilibrium limit_at(double load_factor) {
  Equilibrium result;
  result.status = Status::limit_point;
  result.limit = scene::Limit{load_factor, scene::name(Kind::fold)};
  std::ostringstream message;
  message.precision(3);
  message << "snaps at " << 100 * load_factor << " % of the load";
  result.message = message.str();
  return result;
}

}  // namespace

std::optional<Equilibrium> beyond_growth(const scene::Scene& scene, const Options& options, double reached) {
  scene::PathRequest request;
  request.scene = scene;
  const PathWalk::Settings found = settings_for(scene, reached);
  request.from = found.from;
  request.to = found.to;
  Options on_path = options;
  const double tolerance_mm = limit_tolerance * scene::length_mm(scene);
  on_path.tolerance_mm = options.tolerance_mm > 0 ? std::min(options.tolerance_mm, tolerance_mm) : tolerance_mm;
  PathWalk::Settings settings = found;
  std::optional<double> fold;
  bool arrived = false;
  settings.ends_at = [&](const PathPlace& place, Kind kind) {
    if (kind == Kind::fold && !fold) fold = place.state.parameter;
    if (kind == Kind::fold) return !options.after_snap;
    arrived = place.state.parameter == 1 && (!fold || place.index.value_or(0) == 0);
    return arrived;
  };
  PathWalk walk(request, on_path, settings);
  walk.run();
  if (!fold) return std::nullopt;
  if (arrived) {
    if (auto landed = equilibrium_at(scene, options, walk.stepper(), walk.places().back())) return landed;
  }
  return limit_at(*fold);
}

}  // namespace fam
