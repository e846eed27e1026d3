#include "fam/path_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace fam {
namespace {

using scene::PathStatus;

// Of a step; all but the smallest chosen, not measured.
constexpr double first_length = 0.02;
constexpr double longest_length = 0.35;
constexpr double smallest_length = 1e-10;
constexpr double largest_surprise_rad = 0.1, wanted_surprise_rad = 0.02;
constexpr double least_alignment = 0.92;     // of the tangents at its ends
constexpr double unexplained_length = 1e-8;  // where changes of the index are taken as they are
constexpr int most_secants = 60;
constexpr double located_to = 1e-12;  // of the parameter
constexpr double is_zero = 1e-4;      // of a test's larger value at the ends of the step; chosen, not measured
// A place and the first one are the same; beside what the arcs leave out, of which rotations and the parameter were
// seen 3 times as far apart as places (heavy curl).
constexpr double closed_to = 1e-5, inaccuracies_apart = 10;
constexpr double together = 0.01;  // of a step: a fold and a branch point that are one; chosen, not measured

double sign_of(const PathPlace& place) {
  return place.negative ? -1 : 1;
}

// Of the turn across, over that at another place.
double cross_ratio(const PathPlace& place, const PathPlace& other) {
  const double size = std::exp(std::clamp(place.cross->log_size - other.cross->log_size, -700.0, 700.0));
  return size * (place.cross->direction * std::conj(other.cross->direction)).real();
}

double determinant_ratio(const PathPlace& place, const PathPlace& other) {
  const double size = std::exp(std::clamp(place.log_determinant - other.log_determinant, -700.0, 700.0));
  return sign_of(place) * size;
}

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
  curvature_ = stepper_.equations().zero_change();
  length_ = first_length;
  steps_ = 0;
  add(place, Kind::start, branch, multiplicity);
  while (!ended_) {
    if (!stepper_.is_within_mesh(place) && !place.is_fork) {
      if (!stepper_.recentre(place)) return end(PathStatus::step_too_small, "the segments could not be cut anew");
      curvature_ = stepper_.equations().zero_change();
    }
    const std::optional<PathPlace> next = take_step(place);
    if (!next) return;
    const double length = length_;
    std::optional<std::vector<Event>> events = events_between(place, *next);
    if (!events) {
      length_ /= 2;
      if (length_ >= smallest_length) continue;
      return end(PathStatus::step_too_small, "points on the path could not be located");
    }
    std::sort(events->begin(), events->end(), [](const Event& a, const Event& b) { return a.length < b.length; });
    for (const Event& event : *events) {
      if (!emit(event, branch)) return;
    }
    add(*next, Kind::regular, branch);
    if (static_cast<int>(path_.points.size()) >= settings_.most_points)
      return end(PathStatus::work_limit, std::to_string(path_.points.size()) + " points");
    curvature_ = (next->tangent - place.tangent) / length;
    const double surprise = std::max(next->surprise_rad, 1e-6);
    length_ = std::min(longest_length, length * std::clamp(std::cbrt(wanted_surprise_rad / surprise), 0.5, 2.0));
    place = *next;
    place.is_fork = false;
    ++steps_;
  }
}

// A step of length_ or less, on a mesh that is fine enough for it.
std::optional<PathPlace> PathWalk::take_step(PathPlace& from) {
  for (;; length_ /= 2) {
    if (length_ < smallest_length) {
      std::ostringstream message;
      message << (stepper_.tendon_collapsed() ? "a tendon's path has no length somewhere, at"
                                              : "steps fell below the smallest at")
              << " the parameter " << from.state.parameter;
      end(PathStatus::step_too_small, message.str());
      return std::nullopt;
    }
    const double slope = std::abs(from.slope()) * stepper_.unit();
    if (slope > 0) length_ = std::min(length_, 0.98 * settings_.largest_step / slope);
    std::optional<PathPlace> next = stepper_.step(from, length_, curvature_);
    if (!next || !is_fit(from, *next)) continue;
    if (!stepper_.is_small_change(from.state.parameter, next->state.parameter)) continue;
    if (stepper_.is_accurate(*next) || from.is_fork) return next;
    if (!stepper_.refine(from)) {
      end(PathStatus::step_too_small, "no solution with twice the arcs");
      return std::nullopt;
    }
    curvature_ = stepper_.equations().zero_change();
  }
}

bool PathWalk::is_fit(const PathPlace& from, const PathPlace& next) const {
  return next.surprise_rad <= largest_surprise_rad && stepper_.inner(from.tangent, next.tangent) >= least_alignment &&
         std::abs(next.state.parameter - from.state.parameter) <= settings_.largest_step;
}

// Empty: the step must be shorter.
std::optional<std::vector<PathWalk::Event>> PathWalk::events_between(const PathPlace& from, const PathPlace& next) {
  std::vector<Event> events;
  if (!from.is_fork) {
    add_turning_points(from, next, events);
    int explained = 0;
    for (const Event& event : events) {
      if (event.length < 0) return std::nullopt;
      explained += event.multiplicity;
    }
    if (from.index && next.index) {
      const int change = std::abs(*next.index - *from.index);
      if (change > explained || (explained - change) % 2 != 0) {
        if (length_ > unexplained_length) return std::nullopt;
        if (change > explained && steps_ > 0)
          events.push_back({length_ / 2, from, Kind::branch, std::min(2, change), std::nullopt});
      }
    }
    if (events.size() == 2 && std::abs(events[0].length - events[1].length) < together * length_) {
      events.erase(events.begin());
      events.front().is_arrival = true;
      if (is_first_again(events.front().place)) events.front().end = scene::PathStatus::closed;
    }
  }
  add_stops(from, next, events);
  add_closure(from, next, events);
  for (const Event& event : events) {
    if (event.length < 0) return std::nullopt;
  }
  return events;
}

void PathWalk::add_turning_points(const PathPlace& from, const PathPlace& next, std::vector<Event>& events) {
  const auto add_located = [&](Kind kind, int multiplicity, const Test& test) {
    std::optional<Event> event = located(from, next, kind, test);
    const double small = is_zero * std::max(std::abs(test(from)), std::abs(test(next)));
    if (!event || std::abs(test(event->place)) > small) event = Event{-1, from, kind, 0, std::nullopt};
    event->multiplicity = multiplicity;
    if (from.index && next.index) event->place.index = std::min(*from.index, *next.index);
    events.push_back(*event);
  };
  if (from.slope() * next.slope() < 0) add_located(Kind::fold, 1, [](const PathPlace& p) { return p.slope(); });
  if (from.cross && next.cross) {
    if (cross_ratio(next, from) < 0)
      add_located(Kind::branch, 2, [&](const PathPlace& p) { return cross_ratio(p, from); });
  } else if (from.negative != next.negative) {
    add_located(Kind::branch, 1, [&](const PathPlace& p) { return determinant_ratio(p, from) * sign_of(from); });
  }
}

void PathWalk::add_stops(const PathPlace& from, const PathPlace& next, std::vector<Event>& events) {
  const auto passes = [&](double value) {
    return (from.state.parameter - value) * (next.state.parameter - value) < 0 || next.state.parameter == value;
  };
  const auto add_located = [&](double value, std::optional<PathStatus> status) {
    if (!passes(value)) return;
    std::optional<Event> event = located(from, next, status ? Kind::end : Kind::regular,
                                         [&](const PathPlace& p) { return p.state.parameter - value; });
    if (event) {
      if (const auto exact = stepper_.at(event->place, value)) event->place = *exact;
    } else {
      event = Event{-1, from, Kind::regular, 0, std::nullopt};
    }
    event->end = status;
    events.push_back(*event);
  };
  for (const double stop : stops_) add_located(stop, std::nullopt);
  for (const double limit : {settings_.range.lowest, settings_.range.highest}) {
    const PathStatus status = limit == settings_.to ? PathStatus::reached : PathStatus::returned;
    const double outwards = limit == settings_.range.lowest ? -1 : 1;
    if (from.state.parameter == limit && outwards * (next.state.parameter - limit) > 0)
      events.push_back({0, from, Kind::end, 0, status});
    else add_located(limit, status);
  }
}

// Tip and parameter, as they differ from the first place's.
Eigen::Matrix<double, 13, 1> PathWalk::away_from_start(const PathPlace& place) const {
  Eigen::Matrix<double, 13, 1> away;
  const Matrix3d rotation = place.state.nodes.back().rotation_SB - first_.state.nodes.back().rotation_SB;
  double change = place.state.parameter - first_.state.parameter;
  if (is_turn_) change = std::remainder(change, 2 * std::numbers::pi);
  const double length = first_.tip_position_B_mm.norm() + place.tip_position_B_mm.norm();
  away << (place.tip_position_B_mm - first_.tip_position_B_mm) / std::max(length, 1e-300), rotation.reshaped(),
      change / stepper_.unit();
  return away;
}

// On more arcs, too, than the first place.
bool PathWalk::is_first_again(const PathPlace& place) {
  const double inaccuracy_mm = first_.accuracy.error_mm + place.accuracy.error_mm;
  const double near = closed_to + inaccuracies_apart * inaccuracy_mm / stepper_.equations().length_mm();
  return away_from_start(place).norm() <= near;
}

void PathWalk::add_closure(const PathPlace& from, const PathPlace& next, std::vector<Event>& events) {
  if (steps_ < 3 || std::any_of(events.begin(), events.end(), [](const Event& e) { return e.end.has_value(); })) return;
  const Eigen::Matrix<double, 13, 1> before = away_from_start(from), after = away_from_start(next);
  const Eigen::Matrix<double, 13, 1> way = after - before;
  if (!(before.dot(way) < 0 && after.dot(way) >= 0) || before.norm() > 2 * way.norm()) return;
  const auto event = located(from, next, Kind::end, [&](const PathPlace& p) { return away_from_start(p).dot(way); });
  if (!event || !is_first_again(event->place)) return;
  events.push_back(*event);
  events.back().end = PathStatus::closed;
}

// The zero of a test between two places, by secants (Illinois) from the place before it: near it, where the equations
// may be singular, Newton's method then has next to nothing to do. Lengths from different places are not quite the
// same, so the end of the bracket may come out as if it were the zero.
std::optional<PathWalk::Event> PathWalk::located(const PathPlace& from, const PathPlace& next, Kind kind,
                                                 const Test& test) {
  PathPlace low = from, high = next;
  double f_low = test(low), f_high = test(high), length = length_, done = 0;
  if (f_high == 0) return Event{length, next, kind, 0, std::nullopt};
  int side = 0;
  for (int secant = 0; secant < most_secants; ++secant) {
    const double share = f_low / (f_low - f_high);
    double ahead = std::clamp(share, 0.0, 1.0) * length;
    const double size = std::clamp(std::abs(low.state.parameter) / stepper_.unit(), 1e-4, 1.0);
    const PathChange curvature = (high.tangent - low.tangent) / length;
    std::optional<PathPlace> at = stepper_.step(low, ahead, curvature, PathStepper::Newton::tight);
    if (!at) at = stepper_.step(low, ahead = length / 2, curvature, PathStepper::Newton::tight);
    if (!at) return std::nullopt;
    const double f = test(*at);
    if (f == 0 || std::min(ahead, length - ahead) < located_to * size)
      return Event{done + ahead, *at, kind, 0, std::nullopt};
    if (f * f_low > 0) {
      low = *at;
      f_low = f;
      done += ahead;
      length -= ahead;
      if (side == -1) f_high /= 2;
      side = -1;
    } else {
      high = *at;
      f_high = f;
      length = ahead;
      if (side == 1) f_low /= 2;
      side = 1;
    }
  }
  return std::nullopt;
}

// False: the path ends here.
bool PathWalk::emit(const Event& event, int branch) {
  std::optional<PathStatus> status = event.end;
  if (!status && settings_.ends_at && settings_.ends_at(event.place, event.kind)) status = PathStatus::reached;
  add(event.place, status ? Kind::end : event.kind, branch, event.multiplicity);
  if (event.kind == Kind::fold) stops_.push_back(event.place.state.parameter);
  if (event.kind == Kind::branch && !event.is_arrival && static_cast<int>(forks_.size()) < settings_.branches)
    forks_.push_back({places_.back(), event.multiplicity});
  if (status) end(*status);
  return !status;
}

}  // namespace fam
