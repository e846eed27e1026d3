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

std::optional<bool> is_stable(const BeamModel& model, const std::vector<ElementSystem>& elements,
                              const std::vector<NodalSystem>& systems) {
  // Nothing but tendons: their lengths and the elastic energy are convex in the strains, which nothing else holds.
  if (model.conservative && model.all_loads_follow) return true;
  const ReferenceElement& reference = model.reference;
  const ElementParting parting = rotations_apart(reference);
  const int free = 3 * reference.order();
  Eigen::Matrix3d distal = Eigen::Matrix3d::Zero();  // the energy of all that lies beyond, by the rotation of its start
  LoadEnergy loads(model, systems);
  CondensedElement element;
  double shortest = 1;
  for (std::size_t e = model.elements.size(); e-- > 0;) {
    if (!element.condense(parting, elements[e])) return {};
    Block form = energy_of_rotations(element, 3 * reference.nodes());
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
