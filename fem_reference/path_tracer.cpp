#include "fem_reference/path_tracer.h"

#include "fem_reference/state_checks.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fem_reference {

namespace {

using Kind = scene::PathPoint::Kind;

// Chosen, not measured, but for `together`.
constexpr double rotation_limit_rad = 0.2;   // of any node in a step
constexpr double surprise_limit_rad = 0.02;  // between where the tangent pointed and where the step ends
constexpr double smallest_cosine = 0.95;     // of the angle between the tangents at both ends
constexpr double smallest_step = 1e-7;
constexpr double together = 0.05;
constexpr std::size_t most_places = 6;  // that are interpolated

bool turns_back(const PathState& from, const PathState& to) {
  return (from.tangent.parameter < 0) != (to.tangent.parameter < 0);
}

// The product of the multiplicity's eigenvalues as a multiple of that at `from`, without its sign.
double ratio(const scene::Determinant& from, const scene::Determinant& to, int multiplicity) {
  return std::exp((to.log_size - from.log_size) / multiplicity);
}

template <typename Places>
double interpolated_zero(const Places& places, const std::vector<double>& values) {
  const std::size_t n = values.size(), first = n > most_places ? n - most_places : 0;
  double zero = 0;
  for (std::size_t i = first; i < n; ++i) {
    double share = 1;
    for (std::size_t j = first; j < n; ++j) {
      if (j != i) share *= values[j] / (values[j] - values[i]);
    }
    zero += share * places[i].length;
  }
  return zero;
}

}  // namespace

PathTracer::PathTracer(PathSystem& system, PathState start, double first_step, double largest_step)
    : system_(system), last_(std::move(start)), step_(first_step), largest_step_(largest_step) {}

bool PathTracer::refused(const std::string& why) {
  failure_ = why;
  step_ *= 0.5;
  return false;
}

double PathTracer::longest_step() const {
  const double by_rotation = rotation_limit_rad / std::max(largest_rotation(last_.tangent.motion), 1e-12);
  const double by_parameter = largest_step_ / std::max(std::abs(last_.tangent.parameter), 1e-12);
  return std::min({step_, 0.9 * by_rotation, by_parameter});
}

bool PathTracer::is_short_enough(const PathState& next) {
  BeamState guess = last_.state;
  advance(guess, last_.tangent.motion, step_);
  rotation_rad_ = fem_reference::largest_rotation(last_.state, next.state);
  surprise_rad_ = fem_reference::largest_rotation(guess, next.state);
  if (rotation_rad_ > rotation_limit_rad) return refused("a node turns too far in one step");
  if (surprise_rad_ > surprise_limit_rad) return refused("a node turns far from where the path pointed");
  if (std::abs(next.parameter - last_.parameter) > 1.01 * largest_step_) {
    return refused("the parameter changes too much in one step");
  }
  if (system_.dot(last_.tangent, next.tangent) < smallest_cosine) return refused("the path turns too sharply");
  if (tendon_collapses(system_.model(), last_.state, next.state)) {
    return refused("a tendon's path has no length somewhere, |v + u x r| -> 0");
  }
  if (const auto element = turned_over(system_.model(), next.state)) {
    return refused("element " + std::to_string(*element) + " turns by pi or more: the mesh is too coarse");
  }
  return true;
}

PathTracer::Event PathTracer::event(const PathState& next) const {
  const bool back = turns_back(last_, next);
  const bool has_energy = last_.index && next.index;
  const int change = has_energy ? std::abs(*next.index - *last_.index) : 0;
  // Pinned and free rods have determinants of different motions.
  const bool flips = last_.neutral == next.neutral && last_.determinant.negative != next.determinant.negative;
  const bool both_planes = last_.planar && next.planar && last_.planar->negative != next.planar->negative;
  if (both_planes) return {Kind::branch, 2, !back && (!has_energy || change == 2)};
  if (!back && !flips && change == 0) return {};
  if (flips) return {back ? Kind::fold : Kind::branch, 1, !has_energy || change == 1};
  const bool free_turn = system_.facts().turns_freely && !last_.neutral && !next.neutral;
  return {Kind::branch, std::max(change, 1), !back && free_turn && change == 2};
}

PathTracer::Function PathTracer::event_function(const Event& event, const PathState& next) const {
  if (turns_back(last_, next)) return [](const PathState& at) { return at.tangent.parameter; };
  if (event.multiplicity == 2 && last_.planar && next.planar) {
    return [from = *last_.planar](const PathState& at) {
      return (at.planar->negative != from.negative ? -1 : 1) * ratio(from, *at.planar, 1);
    };
  }
  if (event.multiplicity == 1) {
    return [from = last_.determinant](const PathState& at) {
      return (at.determinant.negative != from.negative ? -1 : 1) * ratio(from, at.determinant, 1);
    };
  }
  return [from = last_.determinant, index = *last_.index, change = event.multiplicity](const PathState& at) {
    return (2 * std::abs(at.index.value_or(index) - index) >= change ? -1 : 1) * ratio(from, at.determinant, change);
  };
}

// At a branch point the equations are singular: none is solved closer to it than about `apart` of the distance between
// the two places, and the zero, like the state there, is interpolated between those found.
std::optional<PathTracer::Place> PathTracer::zero(const Function& function, const Place& from, const Place& to,
                                                  double apart) {
  constexpr int max_tries = 60;
  const double away = apart * (to.length - from.length);
  std::vector<Place> places{from, to};
  std::vector<double> values{function(from.state), function(to.state)};
  const double size = std::max(std::abs(values[0]), std::abs(values[1]));
  double low = from.length, high = to.length, last_guess = INFINITY;
  bool is_close = false;
  for (int i = 0; i < max_tries; ++i) {
    double guess = interpolated_zero(places, values);
    if (!(guess > low && guess < high) || i % 8 == 7) guess = 0.5 * (low + high);
    if (is_close) {
      const std::size_t n = values.size();
      const bool is_jump = std::max(std::abs(values[n - 1]), std::abs(values[n - 2])) > 8 * apart * size;
      return is_jump ? std::nullopt : std::optional(interpolated(places, guess));
    }
    is_close = std::abs(guess - last_guess) <= 0.5 * away;
    last_guess = guess;
    const double length = guess + (places.back().length > guess ? -away : away);
    auto state = system_.step(last_, last_.tangent, length);
    if (!state) return {};
    values.push_back(function(*state));
    places.push_back({length, std::move(*state)});
    double& end = (values.back() < 0) == (values[0] < 0) ? low : high;
    if (length > low && length < high) end = length;
  }
  return {};
}

// By the polynomial through the places found last.
PathTracer::Place PathTracer::interpolated(const std::vector<Place>& places, double length) {
  const std::size_t n = places.size(), first = n > most_places ? n - most_places : 0;
  const Place& base = places.back();
  Place result{length, base.state};
  BeamIncrement from_base = difference(base.state.state, base.state.state);
  for (std::size_t i = first; i + 1 < n; ++i) {
    double share = 1;
    for (std::size_t j = first; j < n; ++j) {
      if (j != i) share *= (length - places[j].length) / (places[i].length - places[j].length);
    }
    add(from_base, difference(base.state.state, places[i].state.state), share);
    result.state.parameter += share * (places[i].state.parameter - base.state.parameter);
  }
  advance(result.state.state, from_base);
  return result;
}

std::optional<Landmark> PathTracer::landmark(const Event& event, const PathState& next, double& length) {
  // Where a branch crosses, both the parameter's slope and the determinant's are zero.
  const bool crosses = turns_back(last_, next) && event.kind == Kind::branch;
  auto found = zero(event_function(event, next), {0, last_}, {step_, next}, crosses ? 0.05 : 1e-3);
  if (!found) return {};
  length = found->length;
  Landmark result{std::move(found->state), event.kind, event.multiplicity, {}};
  // The eigenvalue that is zero here is none that is negative.
  if (last_.index) result.state.index = std::min(*last_.index, *next.index);
  return result;
}

std::optional<Landmark> PathTracer::at_target(double target, const Place& from, const Place& to) {
  const auto distance = [target](const PathState& at) { return at.parameter - target; };
  auto found = distance(to.state) == 0 ? std::optional(to) : zero(distance, from, to, 1e-3);
  if (!found) return {};
  const Direction ahead = found->state.tangent;
  const auto exact = system_.solve(found->state.state, target, system_.along_parameter(1), ahead);
  return Landmark{exact ? *exact : found->state, Kind::regular, 0, target};
}

// Those between two places, the second included, between which the parameter goes one way.
bool PathTracer::add_targets(const Place& from, const Place& to, const std::vector<double>& targets,
                             std::vector<Landmark>& landmarks) {
  const double a = from.state.parameter, b = to.state.parameter;
  std::vector<double> between;
  for (const double target : targets) {
    if ((a < target && target <= b) || (b <= target && target < a)) between.push_back(target);
  }
  std::sort(between.begin(), between.end(), [up = a < b](double x, double y) { return up ? x < y : x > y; });
  between.erase(std::unique(between.begin(), between.end()), between.end());
  for (const double target : between) {
    auto found = at_target(target, from, to);
    if (!found) return false;
    landmarks.push_back(std::move(*found));
  }
  return true;
}

std::optional<std::vector<Landmark>> PathTracer::next(const std::vector<double>& targets) {
  while (true) {
    step_ = longest_step();
    if (step_ < smallest_step) return {};
    auto next = system_.step(last_, last_.tangent, step_);
    if (!next) {
      refused(system_.failure());
      continue;
    }
    if (!is_short_enough(*next)) continue;
    const Event happens = event(*next);
    if (!happens.is_one && step_ > together) {
      refused("a fold and branch points lie together");
      continue;
    }
    std::vector<Landmark> landmarks;
    Place from{0, last_};
    const Place to{step_, *next};
    if (happens.multiplicity > 0) {
      double length = 0;
      auto found = landmark(happens, *next, length);
      if (!found) {
        refused("the step leads to another branch");
        continue;
      }
      const Place there{length, found->state};
      const bool complete = add_targets(from, there, targets, landmarks);
      landmarks.push_back(std::move(*found));
      from = there;
      if (!complete) {
        refused("a point that is asked for was not found");
        continue;
      }
    }
    if (!add_targets(from, to, targets, landmarks)) {
      refused("a point that is asked for was not found");
      continue;
    }
    if (landmarks.empty() || landmarks.back().target != next->parameter)
      landmarks.push_back({*next, Kind::regular, 0, {}});
    const double growth = std::min(0.8 * rotation_limit_rad / std::max(rotation_rad_, 1e-12),
                                   std::sqrt(0.5 * surprise_limit_rad / std::max(surprise_rad_, 1e-12)));
    step_ *= std::clamp(growth, 0.5, 2.0);
    last_ = std::move(*next);
    return landmarks;
  }
}

}  // namespace fem_reference
