#include "exact_reference/path_walk.h"

#include "exact_reference/shape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace exact_reference {
namespace {

using Eigen::VectorXd;
using Kind = scene::PathPoint::Kind;
using scene::PathStatus;

// Lengths along the path, of which the parameter's whole range is at least 1. All chosen, not measured.
constexpr double first_step = 0.02, longest_step = 0.1, smallest_step = 1e-9;
constexpr double wanted_turn_rad = 0.15;  // of the path in a step
constexpr int most_points = 5000;

}  // namespace

Mark mark_of(const VectorXd& x) {
  Mark mark;
  mark << x.segment<6>(4), x[x.size() - 1];
  return mark;
}

bool same_equilibrium(const Mark& a, const Mark& b, double parameter_scale) {
  constexpr double same = 1e-6;  // branch points are known to less than 1e-8
  return std::abs(a[6] - b[6]) < same * parameter_scale && (a - b).head<6>().norm() < same * (1 + a.head<6>().norm());
}

Eigen::Vector3d tip_motion(Continuation& path, const VectorXd& x, const VectorXd& direction) {
  const double step = 1e-5 / std::sqrt(path.inner(direction, direction));
  const State after = path.states(x + step * direction).back(), before = path.states(x - step * direction).back();
  return (after - before).tail<3>() / (2 * step);
}

void PathWalk::note(const Place& place) {
  const NodeStates y = path_.states(place.x);
  scene::PathPoint point = place.point;
  point.parameter = place.x[place.x.size() - 1];
  point.tip_position_B_mm = path_.rod().length_mm * y.back().tail<3>();
  point.branch = branch_;
  if (point.index) point.stable = *point.index == 0;
  result_.points.push_back(point);
  ++points_;
  if (!visit_) return;
  scene::Equilibrium shape;
  shape.status = scene::Status::converged;
  shape.stable = point.stable;
  set_shape(shape, path_.rod(), path_.shooting(), y);
  visit_(point, shape);
}

bool PathWalk::stop(PathStatus status, const char* why) {
  status_ = status;
  char text[120];
  std::snprintf(text, sizeof text, why, path_.base().parameter());
  message_ = text;
  return true;
}

void PathWalk::from_start() {
  start_ = mark_of(path_.base().x);
  Place start{0, path_.base().x, {}};
  start.point.kind = Kind::start;
  start.point.index = path_.base().index;
  note(start);
  walk(first_step);
}

// The continuation's base is the branch point itself, its tangent the branch's direction.
void PathWalk::from_parting(const Parting& parting) {
  start_ = mark_of(parting.point.x);
  Place start{0, parting.point.x, {}};
  start.point.kind = Kind::start;
  start.point.multiplicity = parting.point.multiplicity;
  start.point.index = parting.point.index;
  for (const double s : {0.03, 0.06, 0.015, 0.12, 0.005, 0.002}) {
    const std::optional<Solution> first = path_.at(s);
    if (!first || path_.distance(first->x, path_.base().x + s * path_.base().tangent) > s) continue;
    note(start);
    if (path_.turns_freely() && !path_.is_turn_free(first->x)) path_.hold_turn();
    if (note_stretch(*first, s, {})) return;
    if (!path_.advance(*first)) break;
    walk(s);
    return;
  }
  stop(PathStatus::not_started, "no equilibrium found beside the branch point at %.8g");
}

void PathWalk::walk(double s) {
  while (!step(s)) {
  }
}

// Whether the branch has ended.
bool PathWalk::step(double& s) {
  if (points_ > most_points) return stop(PathStatus::work_limit, "given up after 5000 points, at %.8g");
  s = std::min(s, longest_step);
  const double slope = std::abs(path_.base().slope());
  if (s * slope > route_.largest_step) s = route_.largest_step / slope;
  for (; s > smallest_step; s /= 2) {
    const std::optional<Solution> next = path_.at(s);
    if (!next) continue;
    const double change = std::abs(next->parameter() - path_.base().parameter());
    const bool too_far = change > route_.largest_step * (1 + 1e-9);
    if (too_far || !path_.leads_to(*next)) continue;
    const std::optional<std::vector<CriticalPoint>> critical = critical_points(path_, *next, s);
    if (!critical) continue;
    if (note_stretch(*next, s, *critical)) return true;
    const double turn = path_.turn_to(*next);
    if (!path_.advance(*next)) return stop(PathStatus::step_too_small, "the mesh does not settle at %.8g");
    s *= std::clamp(wanted_turn_rad / std::max(turn, 1e-3), 0.5, 1.5);
    return false;
  }
  const NodeStates y = path_.states(path_.base().x);
  if (tendon_has_collapsed(path_.rod(), path_.shooting(), y, path_.load_factor())) {
    return stop(PathStatus::step_too_small, "the path of a tendon has no length somewhere beyond %.8g");
  }
  return stop(PathStatus::step_too_small, "steps along the path fell below 1e-9 of its length at %.8g");
}

// Notes what lies on a step, its end included. Whether the branch ends there.
bool PathWalk::note_stretch(const Solution& end, double s, const std::vector<CriticalPoint>& critical) {
  Place last{0, path_.base().x, {}};
  last.point.index = path_.base().index ? path_.base().index : end.index;
  last.point.neutral = path_.turns_freely();
  for (const CriticalPoint& point : critical) {
    Place place = last;
    place.s = point.s;
    place.x = point.x;
    if (note_targets(last, place)) return true;
    const bool back = point.kind == Kind::branch && is_back(point.x);
    place.point.kind = back ? Kind::end : point.kind;
    place.point.multiplicity = point.multiplicity;
    place.point.index = point.index;
    note(place);
    if (back) return stop(PathStatus::closed, "");
    if (point.kind == Kind::branch) partings_.push_back({point, path_.shooting().mesh()});
    last.s = place.s;
    last.x = place.x;
    last.point.index = end.index;
  }
  Place place = last;
  place.s = s;
  place.x = end.x;
  place.point.index = end.index;
  if (note_targets(last, place)) return true;
  note(place);
  return false;
}

bool PathWalk::is_back(const VectorXd& x) const {
  Mark mark = mark_of(x);
  if (route_.turns) mark[6] = start_[6] + std::remainder(mark[6] - start_[6], 2 * std::numbers::pi);
  return same_equilibrium(start_, mark, route_.scale());
}

// Whole turns away from the start, between two values of the parameter.
std::vector<double> PathWalk::whole_turns(double a, double b) const {
  constexpr double turn = 2 * std::numbers::pi;
  std::vector<double> values;
  if (!route_.turns || branch_ > 0) return values;
  for (double k = std::ceil((std::min(a, b) - route_.from) / turn); route_.from + k * turn <= std::max(a, b); ++k) {
    if (k != 0) values.push_back(route_.from + k * turn);
  }
  return values;
}

// The values of the parameter at which points are placed, between two places with no fold between.
bool PathWalk::note_targets(const Place& a, const Place& b) {
  const double start = a.x[a.x.size() - 1], end = b.x[b.x.size() - 1];
  std::vector<double> targets = route_.stop_at;
  const std::vector<double> turns = whole_turns(start, end);
  targets.insert(targets.end(), turns.begin(), turns.end());
  targets.push_back(route_.from);
  targets.push_back(route_.to);
  std::erase_if(targets, [&](double t) { return !((t - start) * (t - end) < 0 || (t == end && t != start)); });
  std::sort(targets.begin(), targets.end(),
            [&](double t, double u) { return std::abs(t - start) < std::abs(u - start); });
  targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
  for (const double target : targets) {
    const std::optional<Solution> at = solution_at(target, a, b);
    const bool arrives = target == route_.to || target == route_.from;
    if (!at) {
      if (arrives) return stop(PathStatus::step_too_small, "no equilibrium found at the end, after %.8g");
      continue;
    }
    const bool turned = std::find(turns.begin(), turns.end(), target) != turns.end();
    const bool closes = turned && !arrives && is_back(at->x), ends = arrives || closes;
    const bool wanted =
        !turned || std::find(route_.stop_at.begin(), route_.stop_at.end(), target) != route_.stop_at.end();
    if (!ends && !wanted) continue;
    Place place = b;
    place.x = at->x;
    place.point.kind = ends ? Kind::end : Kind::regular;
    place.point.index = at->index;
    note(place);
    if (closes) return stop(PathStatus::closed, "");
    if (ends) return stop(target == route_.to ? PathStatus::reached : PathStatus::returned, "");
  }
  return false;
}

std::optional<Solution> PathWalk::solution_at(double parameter, const Place& a, const Place& b) {
  constexpr int most_iterations = 60;
  const double close = 1e-9 * route_.scale();
  const auto off = [&](const VectorXd& x) { return x[x.size() - 1] - parameter; };
  Place low = a, high = b;
  std::optional<Solution> middle;
  double low_off = off(a.x), high_off = off(b.x);
  int kept = 0;
  for (int i = 0; i < most_iterations && high.s - low.s > 1e-15; ++i) {  // the Illinois method
    const double share = high_off == 0 ? 1 : low_off / (low_off - high_off);
    const double s = std::lerp(low.s, high.s, share);
    middle = path_.at(s, low.x + share * (high.x - low.x));
    if (!middle) return std::nullopt;
    const double middle_off = off(middle->x);
    if (std::abs(middle_off) < close) break;
    const bool on_low_side = (middle_off < 0) == (low_off < 0);
    (on_low_side ? low : high) = {s, middle->x, {}};
    (on_low_side ? low_off : high_off) = middle_off;
    if (kept == (on_low_side ? 1 : -1)) (on_low_side ? high_off : low_off) /= 2;
    kept = on_low_side ? 1 : -1;
  }
  // At a fold the parameter cannot be held.
  const std::optional<Solution> exact = path_.at_parameter(parameter, *middle);
  if (exact && path_.distance(exact->x, middle->x) < 1e-4) return exact;
  middle->x.tail<1>()[0] = parameter;
  return middle;
}

}  // namespace exact_reference
