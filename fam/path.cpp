#include "fam/path.h"

#include "fam/load_length.h"
#include "fam/path_walk.h"

#include <algorithm>

namespace fam {
namespace {

constexpr int most_points = 20'000;           // of a path with its branches; chosen, not measured
constexpr long long most_arcs = 100'000'000;  // minutes; chosen, not measured
constexpr int fewest_places = 60;             // of a centreline
constexpr int fewest_steps = 20;              // through the range, where the largest is not given
constexpr double largest_change = 1e4;        // of loads, in one unit of the parameter; chosen, not measured

// The range, or as much of it as changes the loads (size_of_change) by what a rod bears: steps, arcs and tolerances go
// by it, and a range of 1e300 is no measure of them.
double parameter_unit(const scene::PathRequest& request) {
  const std::vector<scene::Span> from = scene::spans_of(scene::scene_at(request, request.from));
  double way = request.to - request.from;
  while (!(size_of_change(from, scene::spans_of(scene::scene_at(request, request.from + way))) <= largest_change))
    way /= 2;
  return std::abs(way);
}

PathWalk::Settings settings_for(const scene::PathRequest& request) {
  PathWalk::Settings settings;
  const auto [low, high] = std::minmax(request.from, request.to);
  settings.range = {low, high, parameter_unit(request)};
  settings.from = request.from;
  settings.to = request.to;
  for (const double stop : request.stop_at) {
    const bool is_new = std::find(settings.stops.begin(), settings.stops.end(), stop) == settings.stops.end();
    if (is_new && stop != request.to)
      settings.stops.push_back(stop);  // a path ends there, and on other branches goes on
  }
  settings.branches = request.branches;
  settings.largest_step = request.largest_step.value_or((high - low) / fewest_steps);
  settings.most_points = most_points;
  settings.most_arcs = most_arcs;
  return settings;
}

}  // namespace

struct Path::Impl {
  scene::PathRequest request;
  Options options;
  mutable PathWalk walk;

  const SavedPlace& place(std::size_t point) const {
    if (point < walk.places().size()) return walk.places()[point];
    throw scene::SceneError("point = " + std::to_string(point) + ": the path has " +
                            std::to_string(walk.places().size()) + " points, counted from 0");
  }

  Impl(const scene::PathRequest& r, const Options& o) : request(r), options(o), walk(r, o, settings_for(r)) {}
};

Path::Path(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Path::Path(Path&&) noexcept = default;
Path& Path::operator=(Path&&) noexcept = default;
Path::~Path() = default;

Path Path::follow(const scene::PathRequest& request, const Options& options) {
  scene::validate(request);
  auto impl = std::make_unique<Impl>(request, options);
  impl->walk.run();
  return Path(std::move(impl));
}

Path Path::follow_on(const scene::PathRequest& request, const Path& from, std::size_t point, bool back,
                     const Options& options) {
  scene::validate(request);
  auto impl = std::make_unique<Impl>(request, options);
  impl->walk.run_from(from.impl_->place(point), back);
  return Path(std::move(impl));
}

const scene::Path& Path::points() const {
  return impl_->walk.path();
}

std::vector<Eigen::Vector3d> Path::centreline_mm(std::size_t point) const {
  PathStepper& stepper = impl_->walk.stepper();
  const PathPlace place = stepper.restored(impl_->place(point));
  const int arcs = stepper.equations().rod().arc_count();
  return stepper.equations().centreline_mm(place.state, 1 + fewest_places / arcs);
}

scene::Equilibrium Path::equilibrium(std::size_t point) const {
  PathStepper& stepper = impl_->walk.stepper();
  const PathPlace place = stepper.restored(impl_->place(point));
  const double parameter = stepper.parameter(place);
  scene::Equilibrium result = stepper.equations().equilibrium(place.state, scene::scene_at(impl_->request, parameter));
  result.error_estimate_mm = place.accuracy.error_mm;
  result.stable = points().points[point].stable;
  return result;
}

}  // namespace fam
