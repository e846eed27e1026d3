// Who competes in the work-precision study, and at which resolutions.
#pragma once

#include "studies/methods/method.h"

#include <vector>

namespace studies {

struct Competitor {
  std::string series;      // "fam fourth_order", "fe quadratic adaptive", ...
  std::string model;       // "Kirchhoff" or "Reissner": the exact rod that it is compared with
  std::string resolution;  // "12 arcs", "1e-06 L", ...
  std::string label;       // the same in a picture: "12"
  std::unique_ptr<Method> method;
};

// How many finite element meshes a scene is worth: they cost the most.
enum class FeMeshes {
  few,   // 1 to 50 elements, Reissner
  many,  // 1 to 100 elements, both models
  most   // the same, and Reissner up to 400
};

// In the order of tables and legends; a series in order of rising effort.
std::vector<Competitor> competitors(FeMeshes meshes);

}  // namespace studies
