#include "fem_reference/beam_system.h"

#include "fem_reference/beam_element.h"

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>

namespace fem_reference {

namespace {

using Index = dealii::types::global_dof_index;

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

dealii::FESystem<1> finite_element(const ReferenceElement& reference) {
  const dealii::FE_Q<1> nodal(static_cast<unsigned int>(reference.order()));
  const dealii::FE_DGQArbitraryNodes<1> at_points(dealii::QGauss<1>(static_cast<unsigned int>(reference.points())));
  return dealii::FESystem<1>(nodal, 6, at_points, 3);
}

// For each unknown of deal.II's element its place in the order of beam_element.h.
std::vector<int> places(const dealii::FESystem<1>& fe, const ReferenceElement& reference) {
  std::vector<int> place(fe.dofs_per_cell);
  for (unsigned int k = 0; k < fe.dofs_per_cell; ++k) {
    const auto [component, function] = fe.system_to_component_index(k);
    const int c = static_cast<int>(component), f = static_cast<int>(function);
    // FE_Q numbers the two ends first, then the inner nodes along the element.
    const int node = f == 0 ? 0 : f == 1 ? reference.order() : f - 1;
    place[k] = c < 6 ? 6 * node + c : 6 * reference.nodes() + 3 * f + (c - 6);
  }
  return place;
}

}  // namespace

struct BeamSystem::Implementation {
  explicit Implementation(const BeamModel& beam);

  void number_unknowns();
  void number_watched();
  void make_matrix();
  void add_element(std::size_t e, const BeamState& state, double load_factor);
  void add_loads(const BeamState& state, double load_factor);
  Residual measure() const;
  Eigen::Vector3d values(const std::vector<Index>& numbers, std::size_t first) const;

  const BeamModel& model;
  dealii::Triangulation<1> line;
  dealii::FESystem<1> fe;
  dealii::DoFHandler<1> dofs;
  dealii::AffineConstraints<double> clamp;
  dealii::SparsityPattern pattern;
  dealii::SparseMatrix<double> tangent;
  dealii::SparseDirectUMFPACK factors;
  std::vector<int> watched;  // place of each unknown among those of the determinant, or -1
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::SparseMatrix<double> watched_tangent;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> determinant_factors;
  dealii::Vector<double> residual, solution;

  std::vector<std::vector<Index>> element_unknowns;  // in the order of beam_element.h
  std::vector<Index> node_unknowns;                  // 6 a node
  std::vector<Index> force_unknowns;                 // 3 a Gauss point

  ElementSystem element;
  dealii::FullMatrix<double> element_matrix;
};

BeamSystem::Implementation::Implementation(const BeamModel& beam)
    : model(beam), fe(finite_element(beam.reference)), dofs(line) {
  // One beam is too small to share between threads, and timings are to be those of one core.
  dealii::MultithreadInfo::set_thread_limit(1);
  make_line(model, line);
  dofs.distribute_dofs(fe);
  number_unknowns();
  for (std::size_t i = 0; i < 6; ++i) clamp.add_line(node_unknowns[i]);
  clamp.close();
  make_matrix();
}

void BeamSystem::Implementation::number_unknowns() {
  const std::vector<int> place = places(fe, model.reference);
  const auto points = static_cast<std::size_t>(model.reference.points());
  const std::size_t nodal = 6 * static_cast<std::size_t>(model.reference.nodes());
  std::vector<Index> of_cell(fe.dofs_per_cell);
  node_unknowns.resize(6 * static_cast<std::size_t>(model.nodes()));
  force_unknowns.resize(3 * points * model.elements.size());
  for (const auto& cell : dofs.active_cell_iterators()) {
    cell->get_dof_indices(of_cell);
    std::vector<Index> ordered(of_cell.size());
    for (std::size_t k = 0; k < of_cell.size(); ++k) ordered[static_cast<std::size_t>(place[k])] = of_cell[k];
    const std::size_t e = cell->active_cell_index();
    const std::size_t first_node = e * static_cast<std::size_t>(model.reference.order());
    std::copy_n(ordered.begin(), nodal, node_unknowns.begin() + static_cast<std::ptrdiff_t>(6 * first_node));
    std::copy(ordered.begin() + static_cast<std::ptrdiff_t>(nodal), ordered.end(),
              force_unknowns.begin() + static_cast<std::ptrdiff_t>(3 * points * e));
    element_unknowns.push_back(std::move(ordered));
  }
}

// All unknowns that are not clamped, but for displacements and forces normal to the plane of symmetry and turns in it.
void BeamSystem::Implementation::number_watched() {
  const int normal = model.symmetry == scene::Symmetry::plane_xy   ? 2
                     : model.symmetry == scene::Symmetry::plane_xz ? 1
                                                                   : -1;
  watched.assign(dofs.n_dofs(), -1);
  int count = 0;
  const auto number = [&](Index unknown, std::size_t component, bool turn) {
    const bool in_plane = normal < 0 || (static_cast<int>(component) == normal) == turn;
    if (in_plane && !clamp.is_constrained(unknown)) watched[unknown] = count++;
  };
  for (std::size_t i = 0; i < node_unknowns.size(); ++i) number(node_unknowns[i], i % 3, i % 6 >= 3);
  for (std::size_t i = 0; i < force_unknowns.size(); ++i) number(force_unknowns[i], i % 3, false);
  watched_tangent.resize(count, count);
}

void BeamSystem::Implementation::make_matrix() {
  dealii::DynamicSparsityPattern dynamic(dofs.n_dofs());
  dealii::DoFTools::make_sparsity_pattern(dofs, dynamic, clamp, false);
  pattern.copy_from(dynamic);
  tangent.reinit(pattern);
  residual.reinit(dofs.n_dofs());
  solution.reinit(dofs.n_dofs());
  element_matrix.reinit(fe.dofs_per_cell, fe.dofs_per_cell);
}

void BeamSystem::Implementation::add_element(std::size_t e, const BeamState& state, double load_factor) {
  element_system(model.reference, model.elements[e], state_of_element(model, state, e), load_factor, element);

  const std::vector<Index>& unknowns = element_unknowns[e];
  for (unsigned int i = 0; i < unknowns.size(); ++i) {
    for (unsigned int j = 0; j < unknowns.size(); ++j) element_matrix(i, j) = element.tangent(i, j);
    if (!clamp.is_constrained(unknowns[i])) residual[unknowns[i]] += element.residual[i];
  }
  clamp.distribute_local_to_global(element_matrix, unknowns, tangent);
}

void BeamSystem::Implementation::add_loads(const BeamState& state, double load_factor) {
  // No load stands at the clamp, so none of these unknowns is constrained.
  for (const NodalLoad& load : model.loads) {
    const auto node = static_cast<std::size_t>(load.node);
    const NodalSystem system = nodal_system(load, state.rotation_BS[node], load_factor);
    for (int i = 0; i < 6; ++i) {
      const Index row = node_unknowns[6 * node + static_cast<std::size_t>(i)];
      residual[row] += system.residual[i];
      for (int j = 3; j < 6; ++j) {
        tangent.add(row, node_unknowns[6 * node + static_cast<std::size_t>(j)], system.tangent(i, j));
      }
    }
  }
}

Residual BeamSystem::Implementation::measure() const {
  Residual result;
  for (std::size_t i = 0; i < node_unknowns.size(); ++i) {
    double& largest = i % 6 < 3 ? result.largest_force : result.largest_moment;
    // Not std::max, which would drop a NaN.
    if (!(std::abs(residual[node_unknowns[i]]) <= largest)) largest = std::abs(residual[node_unknowns[i]]);
  }
  for (const Index i : force_unknowns) {
    if (!(std::abs(residual[i]) <= result.largest_gap)) result.largest_gap = std::abs(residual[i]);
  }
  return result;
}

Eigen::Vector3d BeamSystem::Implementation::values(const std::vector<Index>& numbers, std::size_t first) const {
  return {solution[numbers[first]], solution[numbers[first + 1]], solution[numbers[first + 2]]};
}

double Residual::largest() const {
  return finite() ? std::max({largest_force, largest_moment, largest_gap}) : std::nan("");
}

bool Residual::finite() const {
  return std::isfinite(largest_force) && std::isfinite(largest_moment) && std::isfinite(largest_gap);
}

BeamSystem::BeamSystem(const BeamModel& model) : implementation_(std::make_unique<Implementation>(model)) {}
BeamSystem::~BeamSystem() = default;

Residual BeamSystem::assemble(const BeamState& state, double load_factor) {
  Implementation& self = *implementation_;
  self.tangent = 0;
  self.residual = 0;
  for (std::size_t e = 0; e < self.model.elements.size(); ++e) self.add_element(e, state, load_factor);
  self.add_loads(state, load_factor);
  return self.measure();
}

bool BeamSystem::newton_increment(BeamIncrement& increment) {
  Implementation& self = *implementation_;
  self.solution = self.residual;
  self.solution *= -1;
  try {
    self.factors.factorize(self.tangent);
    self.factors.solve(self.solution);
  } catch (const dealii::SparseDirectUMFPACK::ExcUMFPACKError&) {
    return false;
  }
  self.clamp.set_zero(self.solution);
  const auto nodes = static_cast<std::size_t>(self.model.nodes());
  increment.displacement_B.resize(nodes);
  increment.rotation_S.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    increment.displacement_B[i] = self.values(self.node_unknowns, 6 * i);
    increment.rotation_S[i] = self.values(self.node_unknowns, 6 * i + 3);
  }
  increment.force_S.resize(self.force_unknowns.size() / 3);
  for (std::size_t i = 0; i < increment.force_S.size(); ++i) {
    increment.force_S[i] = self.values(self.force_unknowns, 3 * i);
  }
  return true;
}

std::optional<scene::Determinant> BeamSystem::determinant() {
  Implementation& self = *implementation_;
  const bool first = self.watched.empty();
  if (first) self.number_watched();
  self.entries.clear();
  for (const auto& entry : self.tangent) {
    const int row = self.watched[entry.row()], column = self.watched[entry.column()];
    if (row >= 0 && column >= 0) self.entries.emplace_back(row, column, entry.value());
  }
  self.watched_tangent.setFromTriplets(self.entries.begin(), self.entries.end());
  if (first) self.determinant_factors.analyzePattern(self.watched_tangent);
  self.determinant_factors.factorize(self.watched_tangent);
  if (self.determinant_factors.info() != Eigen::Success) return std::nullopt;
  return scene::Determinant{self.determinant_factors.logAbsDeterminant(),
                            self.determinant_factors.signDeterminant() < 0};
}

}  // namespace fem_reference
