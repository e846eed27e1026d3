#include "fem_reference/stability.h"

#include "fem_reference/beam_element.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace fem_reference {

namespace {

using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_unknowns, max_unknowns>;
using Numbers = Eigen::Matrix<int, Eigen::Dynamic, 1, Eigen::ColMajor, max_unknowns, 1>;

// Places of an element's unknowns in beam_element.h's order, parted by when they are eliminated. The displacement of
// node 0 is in neither: at the clamp it is zero, elsewhere it moves the distal rod without turning it.
struct Parting {
  Numbers followers;  // displacements of nodes 1.., then n
  Numbers rotations;  // of nodes 0..
};

Parting parting(const ReferenceElement& reference) {
  const int nodes = reference.nodes(), forces = 3 * reference.points();
  Parting result{Numbers(3 * (nodes - 1) + forces), Numbers(3 * nodes)};
  for (int i = 0; i < nodes; ++i) {
    for (int c = 0; c < 3; ++c) {
      if (i > 0) result.followers[3 * (i - 1) + c] = 6 * i + c;
      result.rotations[3 * i + c] = 6 * i + 3 + c;
    }
  }
  for (int k = 0; k < forces; ++k) result.followers[3 * (nodes - 1) + k] = 6 * nodes + k;
  return result;
}

// Second derivative of the element's energy by the rotations of its nodes, all else minimised or constrained out.
Block energy_of_rotations(const ElementSystem& system, const Parting& parting) {
  const Block pivot = system.tangent(parting.followers, parting.followers);
  const Block coupling = system.tangent(parting.followers, parting.rotations);
  Block form = system.tangent(parting.rotations, parting.rotations);
  form -= coupling.transpose() * pivot.partialPivLu().solve(coupling);
  // The skew part is half the moments at the nodes, whose sum over the elements and point loads is zero in equilibrium.
  return 0.5 * (form + form.transpose());
}

// The sign of a form's least eigenvalue, after its rows and columns are scaled to a diagonal of ones.
std::optional<bool> is_positive(const Block& form, double round_off) {
  if ((form.diagonal().array() <= 0).any()) return false;
  const Eigen::VectorXd scale = form.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * form * scale.asDiagonal();
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
  if (std::abs(least) <= round_off) return {};
  return least > 0;
}

// The same of the point loads at a node.
class LoadEnergy {
 public:
  LoadEnergy(const BeamModel& model, const BeamState& state, double load_factor)
      : model_(model), state_(state), load_factor_(load_factor), next_(model.loads.size()) {}

  // The nodes are to be asked for from the tip to the clamp.
  Eigen::Matrix3d by_rotation(std::size_t node) {
    if (next_ == 0 || static_cast<std::size_t>(model_.loads[next_ - 1].node) != node) return Eigen::Matrix3d::Zero();
    const NodalSystem system = nodal_system(model_.loads[--next_], state_.rotation_BS[node], load_factor_);
    const Eigen::Matrix3d form = system.tangent.bottomRightCorner<3, 3>();
    return 0.5 * (form + form.transpose());
  }

 private:
  const BeamModel& model_;
  const BeamState& state_;
  double load_factor_;
  std::size_t next_;
};

}  // namespace

std::optional<bool> is_stable(const BeamModel& model, const BeamState& state, double load_factor) {
  // Nothing but tendons: their lengths and the elastic energy are convex in the strains, which nothing else holds.
  if (model.conservative && model.all_loads_follow) return true;
  const ReferenceElement& reference = model.reference;
  const Parting parts = parting(reference);
  const int free = 3 * reference.order();
  Eigen::Matrix3d distal = Eigen::Matrix3d::Zero();  // the energy of all that lies beyond, by the rotation of its start
  LoadEnergy loads(model, state, load_factor);
  ElementSystem system;
  double shortest = 1;
  for (std::size_t e = model.elements.size(); e-- > 0;) {
    element_system(reference, model.elements[e], state_of_element(model, state, e), load_factor, system);
    Block form = energy_of_rotations(system, parts);
    const std::size_t end = (e + 1) * static_cast<std::size_t>(reference.order());
    form.bottomRightCorner<3, 3>() += distal + loads.by_rotation(end);
    shortest = std::min(shortest, model.elements[e].length);
    const Block pivot = form.bottomRightCorner(free, free);
    // Each node adds an error of about 1e-16 / length to `distal`; at the clamp a pivot is of order length * (distance
    // from the critical load) against a diagonal of 1 / length.
    if (e == 0) return is_positive(pivot, 4 * std::numeric_limits<double>::epsilon() / std::pow(shortest, 3));
    // A rod that is not stable with its clamp moved towards the tip is not with the clamp where it belongs.
    const Eigen::LLT<Block> factors(pivot);
    if (factors.info() != Eigen::Success) return false;
    const Block coupling = form.bottomLeftCorner(free, 3);
    distal = form.topLeftCorner<3, 3>() - coupling.transpose() * factors.solve(coupling);
  }
  return {};
}

}  // namespace fem_reference
