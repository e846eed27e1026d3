#include "fem_reference/limit.h"

#include "fem_reference/path_tracer.h"

#include <cstdio>
#include <utility>

namespace fem_reference {

namespace {

constexpr int max_path_steps = 2000;  // chosen, not measured
constexpr double first_path_step = 0.01;
constexpr double largest_load_step = 0.04;

std::string snap_message(double load_factor) {
  char text[60];
  std::snprintf(text, sizeof text, "snaps at %.1f %% of the load", 100 * load_factor);
  return text;
}

}  // namespace

void look_for_a_limit(const BeamModel& full_load, const SteppingOptions& options, SteppingResult& result) {
  PathSystem system(parametric_model(full_load), options);
  const Direction along = system.along_parameter(1);
  auto start = system.solve(rest_state(full_load), 0, along, along);
  if (!start) return;
  PathTracer tracer(system, std::move(*start), first_path_step, largest_load_step);
  for (int step = 0; step < max_path_steps; ++step) {
    auto landmarks = tracer.next({1});
    if (!landmarks) break;
    ++result.load_steps;
    for (Landmark& landmark : *landmarks) {
      const bool is_fold = landmark.kind == scene::PathPoint::Kind::fold;
      if (!is_fold && landmark.target != 1) continue;
      result.newton_iterations += system.newton_iterations();
      const double load_factor = landmark.state.parameter;
      result.status = is_fold ? scene::Status::limit_point : scene::Status::converged;
      result.message = is_fold ? snap_message(load_factor) : "";
      if (is_fold) result.limit = load_factor;
      result.stable.reset();
      if (landmark.state.index) result.stable = *landmark.state.index == 0;
      result.state = std::move(landmark.state.state);
      return;
    }
  }
}

}  // namespace fem_reference
