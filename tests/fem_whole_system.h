// The linear system of the finite element beam with nothing condensed, dense.
#pragma once

#include "fem_reference/beam_element.h"
#include "scene/branch_watch.h"

#include <Eigen/LU>

#include <cmath>
#include <vector>

namespace fem_reference {

// All unknowns: displacement and rotation of each node, then the forces, the clamp's first six left out.
struct WholeSystem {
  Eigen::MatrixXd tangent;
  Eigen::VectorXd residual;

  WholeSystem(const BeamModel& model, const BeamState& state, double load_factor) {
    const ReferenceElement& reference = model.reference;
    const int clamp = 6, nodal = 6 * model.nodes(), forces = 3 * reference.points();
    const int size = nodal + forces * static_cast<int>(model.elements.size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd r = Eigen::VectorXd::Zero(size);
    ElementSystem element;
    for (std::size_t e = 0; e < model.elements.size(); ++e) {
      element_system(reference, model.elements[e], state_of_element(model, state, e), load_factor, element);
      std::vector<int> places;
      for (int k = 0; k < 6 * reference.nodes(); ++k) places.push_back(6 * reference.order() * static_cast<int>(e) + k);
      for (int k = 0; k < forces; ++k) places.push_back(nodal + forces * static_cast<int>(e) + k);
      K(places, places) += element.tangent;
      r(places) += element.residual;
    }
    for (const NodalLoad& load : model.loads) {
      const NodalSystem system =
          nodal_system(load, state.rotation_BS[static_cast<std::size_t>(load.node)], load_factor);
      K.block<6, 6>(6 * load.node, 6 * load.node) += system.tangent;
      r.segment<6>(6 * load.node) += system.residual;
    }
    tangent = K.bottomRightCorner(size - clamp, size - clamp);
    residual = r.tail(size - clamp);
  }

  // Of some of the unknowns alone.
  scene::Determinant determinant(const std::vector<int>& places) const {
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(tangent(places, places));
    scene::Determinant result{0, factors.permutationP().determinant() < 0};
    for (const double pivot : factors.matrixLU().diagonal()) {
      result.negative ^= pivot < 0;
      result.log_size += std::log(std::abs(pivot));
    }
    return result;
  }
  std::vector<int> all() const {
    std::vector<int> places;
    for (int k = 0; k < residual.size(); ++k) places.push_back(k);
    return places;
  }
};

}  // namespace fem_reference
