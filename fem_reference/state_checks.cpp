#include "fem_reference/state_checks.h"

#include "fem_reference/beam_element.h"
#include "fem_reference/tendon_pull.h"

namespace fem_reference {

bool tendon_collapses(const BeamModel& model, const BeamState& from, const BeamState& to) {
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const ElementData& data = model.elements[e];
    if (data.tendons.empty()) continue;
    const ElementState before = state_of_element(model, from, e), after = state_of_element(model, to, e);
    for (int g = 0; g < model.reference.points(); ++g) {
      if (collapses(data, element_strain(model.reference, data, before, g),
                    element_strain(model.reference, data, after, g))) {
        return true;
      }
    }
  }
  return false;
}

std::optional<std::size_t> turned_over(const BeamModel& model, const BeamState& state) {
  const std::size_t order = static_cast<std::size_t>(model.reference.order());
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    if (state.rotation_BS[e * order].dot(state.rotation_BS[(e + 1) * order]) <= 0) return e;
  }
  return std::nullopt;
}

}  // namespace fem_reference
