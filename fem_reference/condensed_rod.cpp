#include "fem_reference/condensed_rod.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace fem_reference {

namespace {

// Of the rows of a vertex's moments to the rotation before it, and to g at the next one.
int lower_diagonals(const Motions& motions) {
  return motions.size() + static_cast<int>(motions.rotations.size()) - 1;
}
int upper_diagonals(const Motions& motions) {
  return 2 * motions.size() - 1;
}

}  // namespace

CondensedRod::CondensedRod(const BeamModel& model, const Motions& motions, std::vector<int> vertex_unknowns)
    : model_(model),
      motions_(motions),
      vertex_unknowns_(std::move(vertex_unknowns)),
      parting_(parting(model.reference, motions)),
      band_(motions.size() * static_cast<int>(model.elements.size()), lower_diagonals(motions),
            upper_diagonals(motions)),
      residual_(model.elements.size() * static_cast<std::size_t>(motions.size())),
      elements_(model.elements.size()) {}

bool CondensedRod::factorise(const std::vector<ElementSystem>& elements, const std::vector<NodalSystem>& loads,
                             const std::optional<Pin>& pin) {
  band_.set_zero();
  std::fill(residual_.begin(), residual_.end(), 0.0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (!elements_[e].condense(parting_, elements[e])) return false;
    add_element(e);
    add_element_residual(e);
  }
  for (std::size_t i = 0; i < loads.size(); ++i) add_load(model_.loads[i], loads[i]);
  pinned_ = pin ? vertex_unknowns_[pin->vertex] + pin->component : -1;
  if (pin) band_.fix(pinned_);
  return band_.factorise();
}

void CondensedRod::set_residual(const Imbalance& imbalance) {
  std::fill(residual_.begin(), residual_.end(), 0.0);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    elements_[e].set_residual(parting_, imbalance.elements[e]);
    add_element_residual(e);
  }
  for (std::size_t vertex = 1; vertex < imbalance.vertices.size(); ++vertex) {
    add_load_residual(vertex, imbalance.vertices[vertex]);
  }
}

int CondensedRod::unknown(std::size_t e, int outer) const {
  const int rotations = static_cast<int>(motions_.rotations.size());
  return outer < rotations ? vertex_unknowns_[e] + outer : vertex_unknowns_[e + 1] + outer - rotations;
}

// add_row(row, row of the element, sign): what is summed up from an element.
template <typename AddRow>
void CondensedRod::for_rows(std::size_t e, const AddRow& add_row) const {
  const int rotations = static_cast<int>(motions_.rotations.size());
  const bool is_first = vertex_unknowns_[e] < 0;
  for (int i = is_first ? rotations : 0; i < 2 * rotations; ++i) add_row(unknown(e, i), i, 1);
  // nobody asks for g at the clamp
  for (int i = 2 * rotations; !is_first && i < parting_.outer(); ++i) {
    add_row(vertex_unknowns_[e] + i - rotations, i, -1);
  }
}

void CondensedRod::add_element(std::size_t e) {
  const int rotations = static_cast<int>(motions_.rotations.size()), outer = parting_.outer();
  const bool is_first = vertex_unknowns_[e] < 0;
  for_rows(e, [&](int row, int from, double sign) {
    for (int j = is_first ? rotations : 0; j < outer; ++j) {
      band_.entry(row, unknown(e, j)) += sign * elements_[e].tangent(from, j);
    }
  });
  for (int i = 2 * rotations; i < outer; ++i) {
    const int g_at_end = unknown(e, i);
    band_.entry(g_at_end, g_at_end) += 1;
    if (!is_first) band_.entry(vertex_unknowns_[e] + i - rotations, g_at_end) -= 1;
  }
}

void CondensedRod::add_element_residual(std::size_t e) {
  for_rows(e, [&](int row, int from, double sign) {
    residual_[static_cast<std::size_t>(row)] += sign * elements_[e].residual(from);
  });
}

void CondensedRod::add_load(const NodalLoad& load, const NodalSystem& system) {
  const int rotations = static_cast<int>(motions_.rotations.size());
  const auto vertex = static_cast<std::size_t>(load.node / model_.reference.order());
  const int first = vertex_unknowns_[vertex];
  const auto add_row = [&](int unknown, int from, double sign) {
    for (int c = 0; c < rotations; ++c) {
      band_.entry(unknown, first + c) +=
          sign * system.tangent(from, 3 + motions_.rotations[static_cast<std::size_t>(c)]);
    }
  };
  int row = first;
  for (const int component : motions_.rotations) add_row(row++, 3 + component, 1);
  for (const int component : motions_.translations) add_row(row++, component, -1);
  add_load_residual(vertex, system.residual);
}

void CondensedRod::add_load_residual(std::size_t vertex, const Eigen::Matrix<double, 6, 1>& residual) {
  auto row = static_cast<std::size_t>(vertex_unknowns_[vertex]);
  for (const int component : motions_.rotations) residual_[row++] += residual[3 + component];
  for (const int component : motions_.translations) residual_[row++] -= residual[component];
}

scene::Determinant CondensedRod::determinant() const {
  scene::Determinant product = band_.determinant();
  for (const CondensedElement& element : elements_) {
    const scene::Determinant inner = element.inner_determinant();
    product.log_size += inner.log_size;
    product.negative ^= inner.negative;
  }
  return product;
}

void CondensedRod::increment(BeamIncrement& increment) const {
  std::vector<double> solution(residual_.size());
  std::transform(residual_.begin(), residual_.end(), solution.begin(), std::negate<>());
  if (pinned_ >= 0) solution[static_cast<std::size_t>(pinned_)] = 0;
  band_.solve(solution);
  const auto nodes = static_cast<std::size_t>(model_.nodes());
  const std::size_t points = model_.elements.size() * static_cast<std::size_t>(model_.reference.points());
  increment.displacement_B.assign(nodes, Eigen::Vector3d::Zero());
  increment.rotation_S.assign(nodes, Eigen::Vector3d::Zero());
  increment.force_S.assign(points, Eigen::Vector3d::Zero());
  Eigen::VectorXd found;
  for (std::size_t e = 0; e < elements_.size(); ++e) recover(e, solution, found, increment);
}

// From the clamp on: an element's displacements count from its start.
void CondensedRod::recover(std::size_t e, const std::vector<double>& solution, Eigen::VectorXd& found,
                           BeamIncrement& increment) const {
  const int order = model_.reference.order(), points = model_.reference.points();
  const int inner = static_cast<int>(parting_.inner.size());
  found.resize(inner + parting_.outer());
  for (int i = 0; i < parting_.outer(); ++i) {
    found[inner + i] = unknown(e, i) < 0 ? 0 : solution[static_cast<std::size_t>(unknown(e, i))];
  }
  elements_[e].recover(found);
  const std::size_t first = e * static_cast<std::size_t>(order);
  const double* next = found.data();
  for (int i = 1; i <= order; ++i) {
    Eigen::Vector3d& displacement_B = increment.displacement_B[first + static_cast<std::size_t>(i)];
    displacement_B = increment.displacement_B[first];
    for (const int component : motions_.translations) displacement_B[component] += *next++;
  }
  for (int g = 0; g < points; ++g) {
    Eigen::Vector3d& force_S = increment.force_S[e * static_cast<std::size_t>(points) + static_cast<std::size_t>(g)];
    for (const int component : motions_.translations) force_S[component] = *next++;
  }
  for (int i = 1; i < order; ++i) {
    for (const int component : motions_.rotations) {
      increment.rotation_S[first + static_cast<std::size_t>(i)][component] = *next++;
    }
  }
  const std::size_t end = first + static_cast<std::size_t>(order);
  next = found.data() + inner + motions_.rotations.size();
  for (const int component : motions_.rotations) increment.rotation_S[end][component] = *next++;
}

}  // namespace fem_reference
