// The number of unstable directions of a shape that another method found.
#pragma once

#include "fem_reference/options.h"
#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace fem_reference {

struct ShapeIndex {
  std::optional<int> index;  // empty: not found, or the loads have no energy
  bool neutral = false;      // a turn about the x axis costs nothing
  double moved_mm = 0;       // from the shape given to the finite elements' equilibrium, largest of all nodes
  std::string message;       // why not found
};

// Negative eigenvalues of the tangent at the equilibrium of the discrete rod that lies at the shape; stations from the
// clamp to the tip, in the scene's loads. An equilibrium farther away than 1e-3 L is none of this shape.
ShapeIndex index_of_shape(const scene::Scene& scene, const std::vector<scene::Station>& shape, const Options& options);

}  // namespace fem_reference
