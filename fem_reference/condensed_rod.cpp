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

bool CondensedRod::factorise(const std::vector<ElementSystem>& elements, const std::vector<NodalSystem>& loads) {
  band_.set_zero();
  std::fill(residual_.begin(), residual_.end(), 0.0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (!elements_[e].condense(parting_, elements[e])) return false;
    add_element(e);
  }
  for (std::size_t i = 0; i < loads.size(); ++i) add_load(model_.loads[i], loads[i]);
  return band_.factorise();
}

int CondensedRod::unknown(std::size_t e, int outer) const {
  const int rotations = static_cast<int>(motions_.rotations.size());
  return outer < rotations ? vertex_unknowns_[e] + outer : vertex_unknowns_[e + 1] + outer - rotations;
}

void CondensedRod::add_element(std::size_t e) {
  const int rotations = static_cast<int>(motions_.rotations.size()), outer = parting_.outer();
  const int first_free = vertex_unknowns_[e] < 0 ? rotations : 0;
  const auto add_row = [&](int row, int from, double sign) {
    residual_[static_cast<std::size_t>(row)] += sign * elements_[e].residual(from);
    for (int j = first_free; j < outer; ++j) band_.entry(row, unknown(e, j)) += sign * elements_[e].tangent(from, j);
  };
  for (int i = first_free; i < 2 * rotations; ++i) add_row(unknown(e, i), i, 1);
  for (int i = 2 * rotations; i < outer; ++i) {
    const int g_at_end = unknown(e, i);
    band_.entry(g_at_end, g_at_end) += 1;
    if (first_free > 0) continue;  // nobody asks for g at the clamp
    const int g_at_start = vertex_unknowns_[e] + i - rotations;
    add_row(g_at_start, i, -1);
    band_.entry(g_at_start, g_at_end) -= 1;
  }
}

void CondensedRod::add_load(const NodalLoad& load, const NodalSystem& system) {
  const int rotations = static_cast<int>(motions_.rotations.size());
  const int first = vertex_unknowns_[static_cast<std::size_t>(load.node / model_.reference.order())];
  const auto add_row = [&](int unknown, int from, double sign) {
    residual_[static_cast<std::size_t>(unknown)] += sign * system.residual[from];
    for (int c = 0; c < rotations; ++c) {
      band_.entry(unknown, first + c) +=
          sign * system.tangent(from, 3 + motions_.rotations[static_cast<std::size_t>(c)]);
    }
  };
  int row = first;
  for (const int component : motions_.rotations) add_row(row++, 3 + component, 1);
  for (const int component : motions_.translations) add_row(row++, component, -1);
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
