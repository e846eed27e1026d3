// Exact reference: the rod equations solved to round-off, the judge of the other methods.
#pragma once

#include "exact_reference/scaled_rod.h"
#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <span>

namespace exact_reference {

// An error estimate beyond this over L, or beyond the tolerance if that is more, is no answer: not_converged.
constexpr double worst_error = 1e-6;

enum class Way {
  automatic,      // initial_value where it can be, else boundary_value
  initial_value,  // follower loads and tendons only, or fixed moments only; any other load: status unsupported
  boundary_value
};

struct Options {
  RodModel model = RodModel::reissner;
  double tolerance =
      1e-12;  // of any position, over L, 1e-13 to 1e-3; round-off may be larger, error_estimate_mm says so
  Way way = Way::automatic;
};

// Throws scene::SceneError if an option is out of its range.
void check(const Options& options);

// The equilibrium that the rod reaches when its loads (tendons included) grow together from zero.
//
// stable: decided for fixed forces, distributed fixed forces, gravity and tendons, by the second variation
// (stability.h); empty under follower loads and fixed moments, which are not conservative in space, and where it is
// neutral.
//
// Statuses: limit_point (with its load factor), load_step_too_small, work_limit, tendon_collapsed, not_converged
// (boundary_value.h, initial_value.h), unsupported. Throws scene::SceneError if an option is out of its range. The
// scene must be valid.
scene::Equilibrium solve(const scene::Scene& scene, const Options& options = {});

// The equilibrium that the rod reaches when its loads go in a straight line from zero to those of the first scene, from
// there to those of the second, and so on; always by boundary_value. The scenes have one rod and the same kinds of
// load. limit_point, with the share of the last part of the way, or load_step_too_small also where no equilibrium
// continues that reached on the way.
scene::Equilibrium solve_along(std::span<const scene::Scene> scenes, const Options& options = {});

}  // namespace exact_reference
