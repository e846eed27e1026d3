#include "fem_reference/path_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fem_reference {

namespace {

// How a section turns when the rod is turned about the x axis and all sections back about their tangents, so that the
// clamp stays.
Eigen::Vector3d free_turn(const Quaternion& rotation_BS) {
  return rotated(conjugate(rotation_BS), Eigen::Vector3d::UnitX()) - Eigen::Vector3d::UnitX();
}

}  // namespace

PathSystem::PathSystem(ParametricModel parametric, const SteppingOptions& options)
    : parametric_(std::move(parametric)),
      slope_(parametric_),
      facts_(path_facts(parametric_)),
      options_(options),
      reach_(parametric_.reach()),
      model_(parametric_.at(parametric_.from)),
      system_(model_) {}

bool PathSystem::failed(const char* why) {
  failure_ = why;
  return false;
}

// A rod that is bent less than this has no mode to pin: round-off of a straight one is 1e-16.
constexpr double straight = 1e-7;

void PathSystem::place_pin(const BeamState& state) {
  if (!facts_.turns_freely) return;
  const auto order = static_cast<std::size_t>(model_.reference.order());
  const auto turn_at = [&](const Pin& pin) { return free_turn(state.rotation_BS[pin.vertex * order])[pin.component]; };
  Pin best;
  for (std::size_t vertex = 1; vertex <= model_.elements.size(); ++vertex) {
    for (const int component : {0, 1, 2}) {
      const Pin pin{vertex, component};
      if (std::abs(turn_at(pin)) > std::abs(turn_at(best))) best = pin;
    }
  }
  const double most = std::abs(turn_at(best));
  if (most <= straight) pin_.reset();
  else if (!pin_ || std::abs(turn_at(*pin_)) < 0.5 * most) pin_ = best;
  pinned_turn_ = pin_ ? turn_at(*pin_) : 1;
  system_.set_pin(pin_);
}

bool PathSystem::bordered_increment(const BeamState& state, double parameter, const Direction& fixed,
                                    Direction& increment) {
  if (!system_.newton_increment(increment.motion)) return failed("the tangent is singular");
  BeamIncrement by_parameter;
  system_.increment(slope_.at(state, parameter), by_parameter);
  const double reach2 = reach_ * reach_;
  const double slope = product(fixed.motion, by_parameter) + fixed.parameter / reach2;
  increment.parameter = -product(fixed.motion, increment.motion) / slope;
  add(increment.motion, by_parameter, increment.parameter);
  return true;
}

Residual PathSystem::assemble(const BeamState& state, double parameter) {
  model_ = parametric_.at(parameter);
  place_pin(state);
  return system_.assemble(state, 1);
}

// Elsewhere Newton's next increment is its square.
constexpr double round_off_of_modes = 1e-7;

bool PathSystem::correct(BeamState& state, double& parameter, const Direction& fixed) {
  const BeamState start = state;
  Direction increment;
  double last_increment = 0, to_come = INFINITY;
  for (int iteration = 0;; ++iteration) {
    const Residual residual = assemble(state, parameter);
    if (!residual.finite() || !all_finite(state) || !std::isfinite(parameter)) {
      return failed("a value is not finite");
    }
    if (is_converged(to_come, residual, largest_entry(state.force_S), options_.tolerance)) return true;
    if (iteration == options_.max_newton_iterations) return failed("Newton's iteration does not converge");
    if (!bordered_increment(state, parameter, fixed, increment)) return false;
    ++newton_iterations_;
    advance(state, increment.motion);
    parameter += increment.parameter;
    if (largest_rotation(start, state) > options_.largest_rotation_rad) return failed("a node turns too far");
    const double this_increment =
        std::max({largest_entry(increment.motion.displacement_B), largest_entry(increment.motion.rotation_S),
                  std::abs(increment.parameter) / reach_});
    // Near a branch point the last increments are round-off along its mode.
    to_come = this_increment <= round_off_of_modes ? 0 : next_increment(last_increment, this_increment);
    last_increment = this_increment;
  }
}

std::optional<PathState> PathSystem::judged(BeamState state, double parameter, const Direction& ahead) {
  PathState result;
  const std::optional<scene::Determinant> determinant = system_.determinant_in_space();
  if (!determinant) return failed("the tangent is singular"), std::nullopt;
  result.determinant = *determinant;
  result.determinant.log_size -= 2 * std::log(std::abs(pinned_turn_));
  result.neutral = pin_.has_value();
  if (facts_.planes_apart && !pin_) result.planar = system_.determinant_in_xy();
  if (facts_.conservative) {
    const std::optional<Inertia> inertia = system_.inertia();
    if (!inertia) return failed("the tangent is singular"), std::nullopt;
    result.index = inertia->negative;
  }
  system_.increment(slope_.at(state, parameter), result.tangent.motion);
  result.tangent.parameter = 1;
  normalise(result.tangent, ahead, reach_);
  result.state = std::move(state);
  result.parameter = parameter;
  return result;
}

std::optional<PathState> PathSystem::solve(BeamState guess, double parameter, const Direction& fixed,
                                           const Direction& ahead) {
  if (!correct(guess, parameter, fixed)) return {};
  return judged(std::move(guess), parameter, ahead);
}

std::optional<PathState> PathSystem::at(const BeamState& state, double parameter, const Direction& ahead) {
  assemble(state, parameter);
  return judged(state, parameter, ahead);
}

std::optional<PathState> PathSystem::step(const PathState& from, const Direction& direction, double length) {
  BeamState guess = from.state;
  advance(guess, direction.motion, length);
  return solve(std::move(guess), from.parameter + length * direction.parameter, direction, direction);
}

// Inverse iteration; the loads that stand for a mode act on the elements' ends alone.
std::optional<Direction> PathSystem::buckling_mode(bool is_double) {
  const auto order = static_cast<std::size_t>(model_.reference.order());
  Imbalance push;
  push.elements.assign(model_.elements.size(),
                       ElementResidual::Zero(6 * model_.reference.nodes() + 3 * model_.reference.points()));
  // Some of all, and of nothing the same on all nodes; of two equal modes the one in the x-y plane.
  for (std::size_t i = 0; i <= model_.elements.size(); ++i) {
    const auto x = static_cast<double>(i);
    Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
    load[1] = -1;
    if (!is_double) load << 0.3 * std::sin(x), -1, -0.9, 0.4 * std::cos(2 * x), 0.1, 0.2 * std::sin(3 * x);
    push.vertices.push_back(load);
  }
  Direction mode;
  mode.motion = no_motion(model_);
  for (int iteration = 0; iteration < 5; ++iteration) {  // by the ratio of two eigenvalues each, 1e-4 or less
    if (!system_.increment(push, mode.motion)) return {};
    normalise(mode, mode, reach_);
    for (std::size_t i = 0; i < push.vertices.size(); ++i) {
      push.vertices[i] << -mode.motion.displacement_B[i * order], -mode.motion.rotation_S[i * order];
    }
  }
  return mode;
}

std::optional<Direction> PathSystem::off_the_path(const PathState& at, bool is_double) {
  assemble(at.state, at.parameter);
  const auto mode = buckling_mode(is_double);
  if (!mode) return {};
  Direction other{{}, 1};
  system_.increment(slope_.at(at.state, at.parameter), other.motion);
  add(other, *mode, -dot(other, *mode));
  normalise(other, other, reach_);
  const double along_mode = dot(at.tangent, *mode), along_other = dot(at.tangent, other);
  scale(other, along_mode);
  add(other, *mode, -along_other);
  normalise(other, other, reach_);
  return other;
}

Direction PathSystem::along_parameter(double sign) const {
  return {no_motion(model_), sign * reach_};
}

}  // namespace fem_reference
