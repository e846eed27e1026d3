#include "fem_reference/stability.h"

#include "fem_reference/condensed_element.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fem_reference {

namespace {

using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3 * max_nodes, 3 * max_nodes>;

// Second derivative of the element's energy by the rotations of its nodes, all else minimised or constrained out.
Block energy_of_rotations(const CondensedElement& element, int rotations) {
  Block form(rotations, rotations);
  for (int i = 0; i < rotations; ++i) {
    for (int j = 0; j < rotations; ++j) form(i, j) = element.tangent(i, j);
  }
  // The skew part is half the moments at the nodes, whose sum over the elements and point loads is zero in equilibrium.
  return 0.5 * (form + form.transpose());
}

// Eigenvalues of a form after its rows and columns are scaled to a diagonal of ones.
Eigen::VectorXd scaled_eigenvalues(const Block& form) {
  const Eigen::VectorXd scale = form.diagonal().cwiseAbs().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * form * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
}

// What is left of a form's first three rows when the others are eliminated, and how many of their pivots are negative.
struct Eliminated {
  Eigen::Matrix3d rest;
  int negative = 0;
};
Eliminated eliminate(const Block& form) {
  const Eigen::Index free = form.rows() - 3;
  const Block pivot = form.bottomRightCorner(free, free), coupling = form.bottomLeftCorner(free, 3);
  const Eigen::LLT<Block> factors(pivot);
  if (factors.info() == Eigen::Success) {
    return {form.topLeftCorner<3, 3>() - coupling.transpose() * factors.solve(coupling), 0};
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(pivot);
  const Eigen::MatrixXd along = modes.eigenvectors().transpose() * coupling;
  return {form.topLeftCorner<3, 3>() - along.transpose() * modes.eigenvalues().cwiseInverse().asDiagonal() * along,
          static_cast<int>((modes.eigenvalues().array() < 0).count())};
}

// The same of the point loads at a node.
class LoadEnergy {
 public:
  LoadEnergy(const BeamModel& model, const std::vector<NodalSystem>& systems)
      : model_(model), systems_(systems), next_(systems.size()) {}

  // The nodes are to be asked for from the tip to the clamp.
  Eigen::Matrix3d by_rotation(std::size_t node) {
    if (next_ == 0 || static_cast<std::size_t>(model_.loads[next_ - 1].node) != node) return Eigen::Matrix3d::Zero();
    const Eigen::Matrix3d form = systems_[--next_].tangent.bottomRightCorner<3, 3>();
    return 0.5 * (form + form.transpose());
  }

 private:
  const BeamModel& model_;
  const std::vector<NodalSystem>& systems_;
  std::size_t next_;
};

}  // namespace

std::optional<Inertia> inertia(const BeamModel& model, const std::vector<ElementSystem>& elements,
                               const std::vector<NodalSystem>& systems, const std::optional<Pin>& pin) {
  const ReferenceElement& reference = model.reference;
  const ElementParting parting = rotations_apart(reference);
  const int free = 3 * reference.order();
  Eigen::Matrix3d distal = Eigen::Matrix3d::Zero();  // the energy of all that lies beyond, by the rotation of its start
  LoadEnergy loads(model, systems);
  CondensedElement element;
  double shortest = 1;
  Inertia result;
  for (std::size_t e = model.elements.size(); e-- > 0;) {
    if (!element.condense(parting, elements[e])) return {};
    Block form = energy_of_rotations(element, 3 * reference.nodes());
    form.bottomRightCorner<3, 3>() += distal + loads.by_rotation((e + 1) * static_cast<std::size_t>(reference.order()));
    if (pin && pin->vertex == e + 1) {
      const Eigen::Index pinned = free + pin->component;
      form.row(pinned).setZero();
      form.col(pinned).setZero();
      form(pinned, pinned) = 1;
    }
    shortest = std::min(shortest, model.elements[e].length);
    if (e > 0) {
      const Eliminated eliminated = eliminate(form);
      distal = eliminated.rest;
      result.negative += eliminated.negative;
    } else {
      // Each node adds an error of about 1e-16 / length to `distal`; at the clamp a pivot is of order length *
      // (distance from the critical load) against a diagonal of 1 / length.
      const double round_off = 4 * std::numeric_limits<double>::epsilon() / std::pow(shortest, 3);
      const Eigen::ArrayXd values = scaled_eigenvalues(form.bottomRightCorner(free, free)).array();
      result.negative += static_cast<int>((values < -round_off).count());
      result.neutral = (values.abs() <= round_off).any();
    }
  }
  return result;
}

std::optional<bool> is_stable(const BeamModel& model, const std::vector<ElementSystem>& elements,
                              const std::vector<NodalSystem>& systems) {
  // Nothing but tendons: their lengths and the elastic energy are convex in the strains, which nothing else holds.
  if (model.conservative && model.all_loads_follow) return true;
  const std::optional<Inertia> found = inertia(model, elements, systems);
  if (!found) return {};
  if (found->negative > 0) return false;
  return found->neutral ? std::nullopt : std::optional(true);
}

}  // namespace fem_reference
