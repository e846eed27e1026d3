#include "fem_reference/options.h"

#include "fem_reference/reference_element.h"
#include "scene/scene.h"

#include <string>

namespace fem_reference {

namespace {

void require(bool holds, const char* name, double value, const char* rule) {
  if (holds) return;
  throw scene::SceneError("finite element options: " + std::string(name) + " = " + std::to_string(value) + ": " + rule);
}

}  // namespace

void validate(const Options& options) {
  require(options.elements >= 1 && options.elements <= 1'000'000, "elements", options.elements, "must be 1 to 1000000");
  require(options.order >= 1 && options.order <= max_order, "order", options.order, "must be 1, 2 or 3");
  require(options.initial_load_step > 0 && options.initial_load_step <= 1, "initial_load_step",
          options.initial_load_step, "must be > 0 and <= 1");
  require(options.smallest_load_step > 0, "smallest_load_step", options.smallest_load_step, "must be > 0");
  require(options.max_load_steps >= 1, "max_load_steps", options.max_load_steps, "must be >= 1");
  require(options.max_newton_iterations >= 1, "max_newton_iterations", options.max_newton_iterations, "must be >= 1");
  require(options.largest_rotation_rad > 0 && options.largest_rotation_rad <= 3, "largest_rotation_rad",
          options.largest_rotation_rad, "must be > 0 and <= 3");
  require(options.tolerance > 0, "tolerance", options.tolerance, "must be > 0");
}

}  // namespace fem_reference
