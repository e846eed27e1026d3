// What the forces and moments of a state leave unbalanced, part by part.
#pragma once

#include "fem_reference/beam_element.h"

#include <vector>

namespace fem_reference {

struct Imbalance {
  std::vector<ElementResidual> elements;
  std::vector<Eigen::Matrix<double, 6, 1>> vertices;  // of the point loads at the elements' ends, the clamp first
};

// Under the full loads.
Imbalance imbalance(const BeamModel& model, const BeamState& state);

// (a - b) * factor. Of models with elements of the same length.
Imbalance difference(const Imbalance& a, const Imbalance& b, double factor);

}  // namespace fem_reference
