#include "fem_reference/beam_system.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>

namespace fem_reference {

namespace {

// The rod is a line in arc length, with a vertex at each element's end.
void make_line(const BeamModel& model, dealii::Triangulation<1>& line) {
  std::vector<dealii::Point<1>> vertices{dealii::Point<1>(0.0)};
  std::vector<dealii::CellData<1>> cells;
  for (const ElementData& element : model.elements) {
    dealii::CellData<1> cell;
    cell.vertices = {static_cast<unsigned int>(vertices.size() - 1), static_cast<unsigned int>(vertices.size())};
    cells.push_back(cell);
    vertices.emplace_back(vertices.back()[0] + element.length);
  }
  line.create_triangulation(vertices, cells, dealii::SubCellData());
}

// For the ends of the elements the number of the first of their unknowns; deal.II numbers from the clamp on, whose
// unknowns, which are zero, are made to lie below zero.
std::vector<int> vertex_unknowns(const dealii::Triangulation<1>& line, int unknowns) {
  dealii::DoFHandler<1> dofs(line);
  dofs.distribute_dofs(dealii::FESystem<1>(dealii::FE_Q<1>(1), static_cast<unsigned int>(unknowns)));
  std::vector<int> first{-unknowns};
  for (const auto& cell : dofs.active_cell_iterators()) {
    first.push_back(static_cast<int>(cell->vertex_dof_index(1, 0)) - unknowns);
  }
  return first;
}

Motions motions_in_plane(scene::Symmetry symmetry) {
  if (symmetry == scene::Symmetry::plane_xy) return {{0, 1}, {2}};
  if (symmetry == scene::Symmetry::plane_xz) return {{0, 2}, {1}};
  return {};
}

// Not std::max, which would drop a NaN.
void enlarge(double& largest, const auto& values) {
  for (const double value : values) {
    if (!(std::abs(value) <= largest) && !std::isnan(largest)) largest = std::abs(value);
  }
}

}  // namespace

struct BeamSystem::Implementation {
  explicit Implementation(const BeamModel& beam);

  CondensedRod rod(const Motions& motions) const { return {model, motions, vertex_unknowns(line, motions.size())}; }
  bool factorise();
  std::optional<scene::Determinant> determinant_in(scene::Symmetry plane);  // one plane for each system
  template <typename OfElement>
  Residual sum(const BeamState& state, double load_factor, const OfElement& residual_of);

  const BeamModel& model;
  dealii::Triangulation<1> line;
  std::vector<ElementSystem> elements;
  std::vector<NodalSystem> loads;
  std::vector<Eigen::Matrix<double, 6, 1>> node_residuals;
  std::optional<CondensedRod> whole, in_plane;
  std::optional<Pin> pin;
  bool is_factorised = false;  // `whole` holds the system assembled last
};

BeamSystem::Implementation::Implementation(const BeamModel& beam) : model(beam), elements(beam.elements.size()) {
  make_line(model, line);
  whole.emplace(rod({}));
}

bool BeamSystem::Implementation::factorise() {
  if (!is_factorised) is_factorised = whole->factorise(elements, loads, pin);
  return is_factorised;
}

// The residual of all nodes and points, from that of the elements.
template <typename OfElement>
Residual BeamSystem::Implementation::sum(const BeamState& state, double load_factor, const OfElement& residual_of) {
  const int nodes = model.reference.nodes();
  Residual result;
  node_residuals.assign(static_cast<std::size_t>(model.nodes()), Eigen::Matrix<double, 6, 1>::Zero());
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const ElementResidual& residual = residual_of(e);
    const std::size_t first = e * static_cast<std::size_t>(nodes - 1);
    for (int i = 0; i < nodes; ++i) {
      node_residuals[first + static_cast<std::size_t>(i)] += residual.segment<6>(6 * i);
    }
    enlarge(result.largest_gap, residual.tail(3 * model.reference.points()));
  }
  loads.clear();
  for (const NodalLoad& load : model.loads) {
    const auto node = static_cast<std::size_t>(load.node);
    loads.push_back(nodal_system(load, state.rotation_BS[node], load_factor));
    node_residuals[node] += loads.back().residual;
  }
  for (std::size_t i = 1; i < node_residuals.size(); ++i) {
    enlarge(result.largest_force, node_residuals[i].head<3>());
    enlarge(result.largest_moment, node_residuals[i].tail<3>());
  }
  return result;
}

double Residual::largest() const {
  return finite() ? std::max({largest_force, largest_moment, largest_gap}) : std::nan("");
}

bool Residual::finite() const {
  return std::isfinite(largest_force) && std::isfinite(largest_moment) && std::isfinite(largest_gap);
}

BeamSystem::BeamSystem(const BeamModel& model) : implementation_(std::make_unique<Implementation>(model)) {}
BeamSystem::~BeamSystem() = default;

Residual BeamSystem::residual(const BeamState& state, double load_factor) {
  Implementation& self = *implementation_;
  ElementResidual residual;
  return self.sum(state, load_factor, [&](std::size_t e) -> const ElementResidual& {
    element_residual(self.model.reference, self.model.elements[e], state_of_element(self.model, state, e), load_factor,
                     residual);
    return residual;
  });
}

Residual BeamSystem::assemble(const BeamState& state, double load_factor) {
  Implementation& self = *implementation_;
  self.is_factorised = false;
  return self.sum(state, load_factor, [&](std::size_t e) -> const ElementResidual& {
    element_system(self.model.reference, self.model.elements[e], state_of_element(self.model, state, e), load_factor,
                   self.elements[e]);
    return self.elements[e].residual;
  });
}

bool BeamSystem::newton_increment(BeamIncrement& increment) {
  Implementation& self = *implementation_;
  if (!self.factorise()) return false;
  self.whole->increment(increment);
  return true;
}

std::optional<scene::Determinant> BeamSystem::Implementation::determinant_in(scene::Symmetry plane) {
  if (!in_plane) in_plane.emplace(rod(motions_in_plane(plane)));
  return in_plane->factorise(elements, loads) ? std::optional(in_plane->determinant()) : std::nullopt;
}

std::optional<scene::Determinant> BeamSystem::determinant() {
  Implementation& self = *implementation_;
  const bool is_planar =
      self.model.symmetry == scene::Symmetry::plane_xy || self.model.symmetry == scene::Symmetry::plane_xz;
  return is_planar ? self.determinant_in(self.model.symmetry) : determinant_in_space();
}

std::optional<scene::Determinant> BeamSystem::determinant_in_xy() {
  return implementation_->determinant_in(scene::Symmetry::plane_xy);
}

std::optional<scene::Determinant> BeamSystem::determinant_in_space() {
  Implementation& self = *implementation_;
  return self.factorise() ? std::optional(self.whole->determinant()) : std::nullopt;
}

void BeamSystem::set_pin(const std::optional<Pin>& pin) {
  implementation_->pin = pin;
}

bool BeamSystem::increment(const Imbalance& imbalance, BeamIncrement& increment) {
  Implementation& self = *implementation_;
  if (!self.factorise()) return false;
  self.whole->set_residual(imbalance);
  self.whole->increment(increment);
  return true;
}

std::optional<Inertia> BeamSystem::inertia() {
  const Implementation& self = *implementation_;
  return fem_reference::inertia(self.model, self.elements, self.loads, self.pin);
}

std::optional<bool> BeamSystem::is_stable() {
  return fem_reference::is_stable(implementation_->model, implementation_->elements, implementation_->loads);
}

}  // namespace fem_reference
