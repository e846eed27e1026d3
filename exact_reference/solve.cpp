#include "exact_reference/solve.h"

#include "exact_reference/boundary_value.h"
#include "exact_reference/initial_value.h"

namespace exact_reference {

void check(const Options& options) {
  if (!(options.tolerance >= 1e-13 && options.tolerance <= 1e-3)) {
    throw scene::SceneError("options: tolerance = " + std::to_string(options.tolerance) + ": must be 1e-13 to 1e-3");
  }
}

scene::Equilibrium solve(const scene::Scene& scene, const Options& options) {
  check(options);
  const ScaledRod rod = scaled_rod(scene, options.model);
  const bool known = rod.moments_are_known(), can_march = known || !rod.has_fixed_load();
  const bool march = options.way == Way::automatic ? can_march : options.way == Way::initial_value;
  if (march && !can_march) {
    scene::Equilibrium refused;
    refused.status = scene::Status::unsupported;
    refused.message =
        "a march needs follower loads only, or fixed moments only; this scene has other loads in the base frame";
    return refused;
  }
  scene::Equilibrium result =
      march ? solve_initial_value(rod, options.tolerance) : solve_boundary_value({&rod, 1}, options.tolerance);
  // Tendons and rest curvature alone: the elastic energy is convex in the strains, and no load does work.
  if (march && result.converged() && rod.has_energy()) result.stable = true;
  result.model.insert(result.model.begin(), {{"solver", std::string(!march  ? "multiple shooting"
                                                                    : known ? "march by CVODE from the clamp"
                                                                            : "march by CVODE from the tip")},
                                             {"shear", rod.shears_or_stretches()},
                                             {"reason", std::string(!march  ? "loads in the base frame"
                                                                    : known ? "the moments are known before the shape"
                                                                            : "all loads follow the rod")}});
  if (!march && can_march) std::get<std::string>(result.model[2].second) = "asked for";
  return result;
}

scene::Equilibrium solve_along(std::span<const scene::Scene> scenes, const Options& options) {
  check(options);
  return solve_boundary_value(scaled_way(scenes, options.model), options.tolerance);
}

}  // namespace exact_reference
