#include "fem_reference/imbalance.h"

namespace fem_reference {

Imbalance imbalance(const BeamModel& model, const BeamState& state) {
  Imbalance result;
  result.elements.resize(model.elements.size());
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    element_residual(model.reference, model.elements[e], state_of_element(model, state, e), 1, result.elements[e]);
  }
  result.vertices.assign(model.elements.size() + 1, Eigen::Matrix<double, 6, 1>::Zero());
  for (const NodalLoad& load : model.loads) {
    const auto vertex = static_cast<std::size_t>(load.node / model.reference.order());
    result.vertices[vertex] += nodal_system(load, state.rotation_BS[static_cast<std::size_t>(load.node)], 1).residual;
  }
  return result;
}

Imbalance difference(const Imbalance& a, const Imbalance& b, double factor) {
  Imbalance result = a;
  for (std::size_t e = 0; e < a.elements.size(); ++e) result.elements[e] = factor * (a.elements[e] - b.elements[e]);
  for (std::size_t i = 0; i < a.vertices.size(); ++i) result.vertices[i] = factor * (a.vertices[i] - b.vertices[i]);
  return result;
}

}  // namespace fem_reference
