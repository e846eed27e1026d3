#include "fam/path_walk.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace fam {
namespace {

using scene::PathStatus;

// Of a step; all but the smallest chosen, not measured.
constexpr double first_length = 0.02;
constexpr double longest_length = 0.35;
constexpr double smallest_length = 1e-10;
constexpr double largest_step_surprise_rad = 0.1, wanted_surprise_rad = 0.02;
constexpr double least_alignment = 0.92;  // of the tangents at its ends
// Where the determinant falls a step goes no farther than most of the way to its zero, so that no two critical points
// lie in one, as they do beside each other where a rod buckles that is next to round and straight; down to here.
constexpr double unwatched_length = 1e-9;
constexpr double first_look = 1e-4;  // of a step, where nothing is known of the determinant before
constexpr double free_turn_reach = 1e-3;  // of the step to a free turn, where the rod's turn is extrapolated; chosen

}  // namespace

PathWalk::PathWalk(const scene::PathRequest& request, const Options& options, const Settings& settings)
    : settings_(settings),
      is_turn_(request.parameter == scene::PathParameter::turn_rad),
      stepper_(request, options, settings.range),
      stops_(settings.stops) {}

void PathWalk::end(PathStatus status, const std::string& message) {
  ended_ = true;
  if (path_.points.empty() || path_.points.back().branch == 0) {
    path_.status = status;
    path_.message = message;
  }
}

void PathWalk::add(const PathPlace& place, Kind kind, int branch, int multiplicity) {
  scene::PathPoint point;
  point.parameter = place.state.parameter;
  point.tip_position_B_mm = place.tip_position_B_mm;
  point.index = place.index;
  if (place.index) point.stable = *place.index == 0;
  point.neutral = place.is_free;
  point.kind = kind;
  point.multiplicity = multiplicity;
  point.branch = branch;
  path_.points.push_back(point);
  places_.push_back(stepper_.saved(place));
}

void PathWalk::run() {
  const std::optional<PathPlace> start = stepper_.start(settings_.from, settings_.to > settings_.from);
  if (!start) return end(PathStatus::not_started, stepper_.message());
  follow(*start, 0);
  for (std::size_t i = 0; i < forks_.size(); ++i) {
    const int multiplicity = forks_[i].multiplicity;
    const PathPlace place = stepper_.restored(forks_[i].at);
    follow(stepper_.fork(place, multiplicity), static_cast<int>(i) + 1, multiplicity);
  }
}

void PathWalk::run_from(const SavedPlace& start, bool back) {
  PathPlace place = stepper_.restored(start);
  if (back) stepper_.reverse(place);
  follow(place, 0);
}

void PathWalk::follow(PathPlace place, int branch, int multiplicity) {
  ended_ = false;
  first_ = place;
  start_anew(place);
  length_ = first_length;
  steps_taken_.clear();
  add(place, Kind::start, branch, multiplicity);
  while (!ended_) {
    if (!stepper_.is_within_mesh(place) && !place.is_fork) {
      if (!stepper_.recentre(place)) return end(PathStatus::step_too_small, "the segments could not be cut anew");
      go_back(place);
    }
    const double wanted = length_;
    const std::optional<PathPlace> next = take_step(place);
    const double length = length_;
    if (!next) {
      if (length == first_look) length_ = wanted;
      continue;
    }
    std::optional<std::vector<Event>> events = events_between(place, *next);
    if (events && (!hold_on_more_arcs(place, *events) || !stops_are_accurate(place, *events))) {
      go_back(place);
      continue;
    }
    if (!events) {
      length_ /= 2;
      if (length_ >= smallest_length) continue;
      return end(PathStatus::step_too_small, "points on the path could not be located");
    }
    std::sort(events->begin(), events->end(), [](const Event& a, const Event& b) { return a.length < b.length; });
    steps_taken_.push_back({path_.points.size(), stops_.size(), forks_.size(), travelled_});
    for (const Event& event : *events) {
      if (!emit(place, event, branch)) return;
    }
    const bool is_free_turn = stepper_.is_free_turn(*next);
    if (!is_free_turn) add(*next, Kind::regular, branch);
    if (static_cast<int>(path_.points.size()) >= settings_.most_points)
      return end(PathStatus::work_limit, std::to_string(path_.points.size()) + " points");
    curvature_ = (next->tangent - place.tangent) / length;
    const double surprise = std::max(next->surprise_rad, 1e-6);
    length_ = std::min(longest_length, length * std::clamp(std::cbrt(wanted_surprise_rad / surprise), 0.5, 2.0));
    place = *next;
    place.is_fork = is_free_turn;
    travelled_ += length;
    if (length == first_look && wanted > length) length_ = wanted;
    watch(place);
  }
}

// Whether the place, on other arcs now than when its point was added, lies beyond a critical point or a stop that is
// behind or ahead of that.
bool PathWalk::is_beyond_point(const PathPlace& place) const {
  const PathPlace& point = places_.back().place;
  if (place.is_fork || point.is_fork) return false;
  const auto lies_between = [&](double stop) {
    return (place.state.parameter - stop) * (point.state.parameter - stop) < 0;
  };
  if (std::any_of(settings_.stops.begin(), settings_.stops.end(), lies_between)) return true;
  if (lies_between(settings_.range.lowest) || lies_between(settings_.range.highest)) return true;
  if (place.index && point.index) return *place.index != *point.index;
  return place.state.nodes.size() == point.state.nodes.size() &&
         place.determinant.negative != point.determinant.negative;
}

// On other arcs. What these put behind the place, a critical point or a stop, has been missed: the steps beyond it are
// undone.
void PathWalk::go_back(PathPlace& place) {
  const long long arcs = stepper_.equations().rod().arc_count();
  const auto is_coarse = [&] { return stepper_.equations().rod().arc_count() < arcs; };
  for (; is_beyond_point(place) && !steps_taken_.empty(); steps_taken_.pop_back()) {
    const Before& before = steps_taken_.back();
    const SavedPlace on_more_arcs = stepper_.saved(place);
    place = stepper_.restored(places_[before.points - 1]);
    const bool was_coarse = is_coarse();
    while (is_coarse() && (place.is_fork ? relocate(place) : stepper_.refine(place))) continue;
    if (is_coarse() || !was_coarse) {  // on as many arcs the same steps would lead here again
      place = stepper_.restored(on_more_arcs);
      break;
    }
    path_.points.resize(before.points);
    places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(before.points), places_.end());
    stops_.resize(before.stops);
    forks_.erase(forks_.begin() + static_cast<std::ptrdiff_t>(before.forks), forks_.end());
    travelled_ = before.travelled;
  }
  if (place.is_fork || is_beyond_point(place)) replace_last(place);  // the first one
  start_anew(place);
}

void PathWalk::replace_last(const PathPlace& place) {
  const scene::PathPoint point = path_.points.back();
  path_.points.pop_back();
  places_.pop_back();
  add(place, point.kind, point.branch, point.multiplicity);
  if (place.is_fork) first_ = place;
}

// On another mesh: nothing is known of the path before.
void PathWalk::start_anew(const PathPlace& place) {
  curvature_ = stepper_.equations().zero_change();
  watch_ = {};
  watched_places_ = 0;
  if (!place.is_fork) watch(place);
}

void PathWalk::watch(const PathPlace& place) {
  watch_.keep(travelled_, place.determinant);
  ++watched_places_;
}

// Where a symmetry holds the rod nothing leads it astray, and the number of unstable directions tells where it is
// known.
double PathWalk::watched_length(const PathPlace& from) {
  if (!settings_.range.is_watched || from.index || stepper_.equations().held() != scene::Symmetry::none)
    return longest_length;
  if (watched_places_ == 1) return first_look;
  return std::max(watch_.longest_step(travelled_), unwatched_length);
}

// Where a step of length_ would pass what makes the rod free to turn, the place there, or nothing and a shorter step:
// it is not to be stepped over, for beside it a rod turned about its axis is an equilibrium but for next to nothing.
std::optional<PathPlace> PathWalk::step_to_free_turn(const PathPlace& from) {
  const std::optional<double> there = stepper_.free_parameter();
  if (!there || from.slope() == 0) return std::nullopt;
  const double ahead = (*there - from.state.parameter) / (from.slope() * stepper_.unit());
  if (!(ahead > 0 && ahead <= length_)) return std::nullopt;
  const std::optional<PathPlace> place = stepper_.at(from, *there, curvature_);
  if (place && !place->is_free) return std::nullopt;
  length_ = ahead;
  if (place && ahead <= free_turn_reach) return place;
  length_ /= 2;
  return std::nullopt;
}

// A step of length_ or less. Empty: the path ends, or `from` lies on a finer mesh now, for it to be tried anew.
std::optional<PathPlace> PathWalk::take_step(PathPlace& from) {
  for (;; length_ /= 2) {
    if (const long long arcs = stepper_.equations().arcs_marched(); arcs > settings_.most_arcs) {
      end(PathStatus::work_limit, std::to_string(arcs) + " arcs marched");
      return std::nullopt;
    }
    if (length_ < smallest_length) {
      std::ostringstream message;
      message << (collapse_is_ahead() ? "a tendon's path has no length somewhere, at"
                                      : "steps fell below the smallest at")
              << " the parameter " << from.state.parameter;
      end(PathStatus::step_too_small, message.str());
      return std::nullopt;
    }
    const double slope = std::abs(from.slope()) * stepper_.unit();
    if (slope > 0) length_ = std::min(length_, 0.98 * settings_.largest_step / slope);
    length_ = std::min(length_, watched_length(from));
    std::optional<PathPlace> next = step_to_free_turn(from);
    if (!next) next = stepper_.step(from, length_, curvature_);
    if (!next && stepper_.tendon_collapsed()) collapsed_at_ = travelled_ + length_;
    if (!next || !is_fit(from, *next) || !stepper_.judge(*next)) continue;
    if (!settings_.range.is_watched && !stepper_.is_small_change(from.state.parameter, next->state.parameter)) continue;
    if (stepper_.is_accurate(*next) || from.is_fork) return next;
    if (!stepper_.refine_for(*next, from)) end(PathStatus::step_too_small, "no solution with twice the arcs");
    else go_back(from);
    return std::nullopt;
  }
}

bool PathWalk::is_fit(const PathPlace& from, const PathPlace& next) const {
  return next.surprise_rad <= largest_step_surprise_rad &&
         stepper_.inner(from.tangent, next.tangent) >= least_alignment &&
         std::abs(next.state.parameter - from.state.parameter) <= settings_.largest_step;
}

// False: the path ends here.
bool PathWalk::emit(const PathPlace& from, const Event& event, int branch) {
  std::optional<PathStatus> status = event.end;
  if (!status && settings_.ends_at && settings_.ends_at(event.place, event.kind)) status = PathStatus::reached;
  add(event.place, status ? Kind::end : event.kind, branch, event.multiplicity);
  if (event.parameter_on_more_arcs) path_.points.back().parameter = *event.parameter_on_more_arcs;
  if (event.kind == Kind::fold) stops_.push_back(event.place.state.parameter);
  if (event.kind == Kind::branch && !event.is_arrival && !event.is_free_turn &&
      static_cast<int>(forks_.size()) < settings_.branches)
    forks_.push_back({places_.back(), event.multiplicity, stepper_.saved(from), length_});
  if (status) end(*status);
  return !status;
}

}  // namespace fam
