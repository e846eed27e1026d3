// What happens in a step of a path: folds, branch points, stops, the end.
#include "fam/path_walk.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace fam {
namespace {

using scene::PathStatus;

constexpr double stops_to = 1e-9;            // of the unit, where a stop is singular; else to round-off
constexpr double unexplained_length = 1e-8;  // where changes of the index are taken as they are
constexpr int most_secants = 60;
constexpr double is_zero = 1e-3;  // of a test's larger value at the ends of the step; chosen, not measured
// A place and the first one are the same; beside what the arcs leave out, of which rotations and the parameter were
// seen 3 times as far apart as places (heavy curl).
constexpr double closed_to = 1e-5, inaccuracies_apart = 10;
constexpr double crossing_apart = 0.02;  // of a step, chosen: with a tenth of it round-off is as large as the error
constexpr double one_crossing = 0.01;    // of a step: a fold and a branch point that are one; chosen, not measured

double sign_of(const PathPlace& place) {
  return place.determinant.negative ? -1 : 1;
}

// Of the turn across, over that at another place.
double cross_ratio(const PathPlace& place, const PathPlace& other) {
  const double size = std::exp(std::clamp(place.cross->log_size - other.cross->log_size, -700.0, 700.0));
  return size * (place.cross->direction * std::conj(other.cross->direction)).real();
}

double determinant_ratio(const PathPlace& place, const PathPlace& other) {
  const double size = std::exp(std::clamp(place.determinant.log_size - other.determinant.log_size, -700.0, 700.0));
  return sign_of(place) * size;
}

}  // namespace

// Empty: the step must be shorter.
std::optional<std::vector<PathWalk::Event>> PathWalk::events_between(const PathPlace& from, const PathPlace& next) {
  std::vector<Event> events;
  if (!from.is_fork) {
    add_free_turn(from, next, events);
    if (events.empty()) add_turning_points(from, next, events);
    int explained = 0;
    for (const Event& event : events) {
      if (event.length < 0) return std::nullopt;
      explained += event.multiplicity;
    }
    if (from.index && next.index && !stepper_.is_free_turn(next)) {
      const int change = std::abs(*next.index - *from.index);
      if (change > explained || (explained - change) % 2 != 0) {
        if (length_ > unexplained_length) return std::nullopt;
        if (change > explained && !steps_taken_.empty())
          events.push_back({length_ / 2, from, Kind::branch, std::min(2, change)});
      }
    }
    if (events.size() == 2 && std::abs(events[0].length - events[1].length) < one_crossing * length_) {
      events = {crossing(from, events[1])};
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

// Whether twice the arcs put the folds and branch points of a step where these arcs do, to the tolerance; else `from`
// gets them. Of a rod on its axis nothing but its critical points tells how many arcs they take.
bool PathWalk::hold_on_more_arcs(PathPlace& from, std::vector<Event>& events) {
  const auto critical = [](std::vector<Event>& all) {
    std::vector<Event*> those;
    for (Event& e : all) {
      if (e.kind == Kind::fold || (e.kind == Kind::branch && !e.is_free_turn) || e.is_arrival) those.push_back(&e);
    }
    return those;
  };
  const std::vector<Event*> coarse = critical(events);
  if (coarse.empty() || !stepper_.may_double()) return true;
  const SavedPlace before = stepper_.saved(from);
  const PathChange curvature = curvature_;
  PathPlace finer = from;
  const bool refined = stepper_.refine(finer);
  const double allowed = stepper_.parameter_tolerance(coarse.front()->place.state.parameter);
  located_to_ = std::max(located_to, 0.01 * allowed / stepper_.unit());
  bool hold = !refined;
  if (auto found = refined ? events_anew(finer) : std::nullopt) {
    const std::vector<Event*> fine = critical(*found);
    hold = fine.size() == coarse.size();
    for (std::size_t i = 0; hold && i < fine.size(); ++i) {
      const double there = fine[i]->place.state.parameter, here = coarse[i]->place.state.parameter;
      hold = std::abs(there - here) <= stepper_.parameter_tolerance(here);
      if (coarse[i]->kind == Kind::branch && !coarse[i]->is_arrival) coarse[i]->parameter_on_more_arcs = there;
    }
  }
  located_to_ = located_to;
  from = hold ? stepper_.restored(before) : finer;
  if (hold) curvature_ = curvature;
  return hold;
}

// Of a step of length_ from a place on other arcs than before.
std::optional<std::vector<PathWalk::Event>> PathWalk::events_anew(const PathPlace& from) {
  curvature_ = stepper_.equations().zero_change();
  auto next = stepper_.step(from, length_, curvature_);
  return next && stepper_.judge(*next) ? events_between(from, *next) : std::nullopt;
}

// Whether the rod is within the tolerance at the parameters that the path stops at, and not only near those; else
// `from` gets more arcs.
bool PathWalk::stops_are_accurate(PathPlace& from, const std::vector<Event>& events) {
  for (const Event& event : events) {
    const bool is_stop = event.kind == Kind::regular || event.kind == Kind::end || event.is_free_turn;
    if (is_stop && !stepper_.is_accurate(event.place) && stepper_.may_double())
      return from.is_fork ? !relocate(from) : !stepper_.refine_for(event.place, from);
  }
  return true;
}

// A branch's start on twice the arcs: as they have its branch point, for carried over from fewer arcs it would lie on
// the path that the branch leaves. False: not found.
bool PathWalk::relocate(PathPlace& start) {
  const int branch = path_.points.back().branch;
  if (branch == 0) return false;  // a path that goes on from there
  Fork& fork = forks_[static_cast<std::size_t>(branch) - 1];
  const SavedPlace coarse = stepper_.saved(start);
  PathPlace from = stepper_.restored(fork.before);
  const double tried = std::exchange(length_, fork.length);
  const auto events = stepper_.refine(from) ? events_anew(from).value_or(std::vector<Event>()) : std::vector<Event>();
  length_ = tried;
  const auto found = std::find_if(events.begin(), events.end(), [&](const Event& event) {
    return event.kind == Kind::branch && event.multiplicity == fork.multiplicity;
  });
  if (found == events.end()) {
    start = stepper_.restored(coarse);
    return false;
  }
  fork.before = stepper_.saved(from);
  start = stepper_.fork(found->place, fork.multiplicity);
  return true;
}

// The stiffness against a turn about the axis goes through zero there: steps end there (take_step).
void PathWalk::add_free_turn(const PathPlace& from, const PathPlace& next, std::vector<Event>& events) {
  if (stepper_.is_free_turn(next)) {
    events.push_back({length_, next, Kind::branch, 1});
    events.back().is_free_turn = true;
    return;
  }
  const std::optional<double> there = stepper_.free_parameter();
  if (!there || (from.state.parameter - *there) * (next.state.parameter - *there) >= 0) return;
  const auto place = stepper_.at(from, *there, curvature_);
  if (!place || place->is_free) events.push_back({-1, from, Kind::branch});
}

void PathWalk::add_turning_points(const PathPlace& from, const PathPlace& next, std::vector<Event>& events) {
  const auto add_located = [&](Kind kind, int multiplicity, const Test& test) {
    std::optional<Event> event = located(whole(from, next), kind, test);
    const double small = is_zero * std::max(std::abs(test(from)), std::abs(test(next)));
    if (!event || std::abs(test(event->place)) > small) event = Event{-1, from, kind, 0};
    event->multiplicity = multiplicity;
    if (from.index && next.index) event->place.index = std::min(*from.index, *next.index);
    events.push_back(*event);
  };
  if (from.slope() * next.slope() < 0) add_located(Kind::fold, 1, [](const PathPlace& p) { return p.slope(); });
  if (from.cross && next.cross) {
    if (cross_ratio(next, from) < 0)
      add_located(Kind::branch, 2, [&](const PathPlace& p) { return cross_ratio(p, from); });
  } else if (from.determinant.negative != next.determinant.negative) {
    add_located(Kind::branch, 1, [&](const PathPlace& p) { return determinant_ratio(p, from) * sign_of(from); });
  }
}

// Where the step has a fold, on either side of that: there the parameter turns back.
void PathWalk::add_stops(const PathPlace& from, const PathPlace& next, std::vector<Event>& events) {
  std::vector<Stretch> stretches{whole(from, next)};
  for (const Event& fold : std::vector<Event>(events)) {
    if (fold.kind != Kind::fold) continue;
    stretches.push_back({fold.place, next, fold.length, length_});
    Stretch& before = stretches[stretches.size() - 2];
    before.next = fold.place;
    before.end = fold.length;
  }
  for (const Stretch& stretch : stretches) add_stops(stretch, events);
}

void PathWalk::add_stops(const Stretch& within, std::vector<Event>& events) {
  const double low = within.from.state.parameter, high = within.next.state.parameter;
  const auto add_located = [&](double value, std::optional<PathStatus> status) {
    if (!((low - value) * (high - value) < 0 || high == value)) return;
    const auto free = std::find_if(events.begin(), events.end(), [&](const Event& event) {
      return event.is_free_turn && event.place.state.parameter == value;
    });
    if (free != events.end()) {
      free->end = status;
      if (status) free->kind = Kind::end;
      return;
    }
    std::optional<Event> event = located(within, status ? Kind::end : Kind::regular,
                                         [&](const PathPlace& p) { return p.state.parameter - value; });
    if (const auto exact = event ? stepper_.at(event->place, value, stepper_.equations().zero_change()) : std::nullopt)
      event->place = *exact;
    if (event && std::abs(event->place.state.parameter - value) <= stops_to * stepper_.unit())
      event->place.state.parameter = value;
    else event = Event{-1, within.from, Kind::regular, 0};
    event->end = status;
    events.push_back(*event);
  };
  for (const double stop : stops_) add_located(stop, std::nullopt);
  for (const double limit : {settings_.range.lowest, settings_.range.highest}) {
    const PathStatus status = limit == settings_.to ? PathStatus::reached : PathStatus::returned;
    const double outwards = limit == settings_.range.lowest ? -1 : 1;
    if (outwards * (high - limit) < 0) continue;  // a start on new arcs may lie outside by round-off
    if (outwards * (low - limit) >= 0) events.push_back({within.start, within.from, Kind::end, 0, status});
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

// On more arcs, too, than the first place; which a branch has from fewer arcs, as accurately as these tell its
// parameter.
bool PathWalk::is_first_again(const PathPlace& place) {
  const double inaccuracy_mm = first_.accuracy.error_mm + place.accuracy.error_mm;
  double near = closed_to + inaccuracies_apart * inaccuracy_mm / stepper_.equations().length_mm();
  if (first_.is_fork) near += 2 * stepper_.parameter_tolerance(first_.state.parameter) / stepper_.unit();
  return away_from_start(place).norm() <= near;
}

void PathWalk::add_closure(const PathPlace& from, const PathPlace& next, std::vector<Event>& events) {
  if (steps_taken_.size() < 3 ||
      std::any_of(events.begin(), events.end(), [](const Event& e) { return e.end.has_value(); }))
    return;
  const Eigen::Matrix<double, 13, 1> before = away_from_start(from), after = away_from_start(next);
  const Eigen::Matrix<double, 13, 1> way = after - before;
  if (!(before.dot(way) < 0 && after.dot(way) >= 0) || before.norm() > 2 * way.norm()) return;
  const auto event = located(whole(from, next), Kind::end, [&](PathPlace p) {
    stepper_.judge(p);  // for its tip
    return away_from_start(p).dot(way);
  });
  if (!event || !is_first_again(event->place)) return;
  events.push_back(*event);
  events.back().end = PathStatus::closed;
}

// The zero of a test between two places, by secants (Illinois) from the place before it: near it, where the equations
// may be singular, Newton's method then has next to nothing to do. Lengths from different places are not quite the
// same, so the end of the bracket may come out as if it were the zero.
std::optional<PathWalk::Event> PathWalk::located(const Stretch& within, Kind kind, const Test& test) {
  PathPlace low = within.from, high = within.next;
  double f_low = test(low), f_high = test(high), done = within.start, length = within.end - done;
  if (f_high == 0) return Event{within.end, high, kind, 0};
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
    const double near = located_to_ * size,
                 slope = std::min(std::abs(f - f_low) / ahead, std::abs(f - f_high) / (length - ahead));
    if (std::abs(f) <= slope * near || std::min(ahead, length - ahead) < near) {
      if (!stepper_.judge(*at)) return std::nullopt;
      return Event{done + ahead, *at, kind, 0};
    }
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

// Where another path crosses this one at a turning point the equations are singular: the place is interpolated between
// three on either side. Length below 0: not found.
PathWalk::Event PathWalk::crossing(const PathPlace& from, const Event& near) {
  constexpr std::array offsets{-3.0, -2.0, -1.0, 1.0, 2.0, 3.0};
  const double apart = crossing_apart * length_;
  std::array<PathPlace, offsets.size()> places;
  std::array<double, offsets.size()> slopes;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto at = stepper_.step(from, near.length + offsets[i] * apart, curvature_, PathStepper::Newton::tight);
    if (!at) return {-1, from, Kind::branch};
    places[i] = *at;
    places[i].tip_position_B_mm = stepper_.equations().positions_mm(at->state).back();
    slopes[i] = at->slope();
  }
  const double rise = slopes.back() - slopes.front();  // but where Newton's method met the other path
  for (std::size_t i = 1; i < slopes.size(); ++i) {
    if (!((slopes[i] - slopes[i - 1]) * rise > 0)) return {-1, from, Kind::branch};
  }
  const auto share = [](const auto& nodes, std::size_t i, double x) {  // Lagrange's
    double product = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != i) product *= (x - nodes[j]) / (nodes[i] - nodes[j]);
    }
    return product;
  };
  double zero = 0;
  for (std::size_t i = 0; i < offsets.size(); ++i) zero += share(slopes, i, 0) * offsets[i];
  Event event{near.length + zero * apart, places[2], Kind::branch, 1};
  event.is_arrival = true;
  PathPlace& place = event.place;
  place.index = near.place.index;
  place.accuracy = near.place.accuracy;
  place.state.parameter = 0;
  place.tip_position_B_mm.setZero();
  for (SectionState<3>& node : place.state.nodes) node = {Matrix3d::Zero(), {}};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const double part = share(offsets, i, zero);
    place.state.parameter += part * places[i].state.parameter;
    place.tip_position_B_mm += part * places[i].tip_position_B_mm;
    for (std::size_t k = 0; k < place.state.nodes.size(); ++k) {
      const SectionState<3>& node = places[i].state.nodes[k];
      place.state.nodes[k].rotation_SB += part * node.rotation_SB;
      place.state.nodes[k].wrench = place.state.nodes[k].wrench + part * node.wrench;
    }
  }
  for (SectionState<3>& node : place.state.nodes)
    node.rotation_SB = Eigen::Quaterniond(node.rotation_SB).normalized().toRotationMatrix();
  return event;
}

}  // namespace fam
