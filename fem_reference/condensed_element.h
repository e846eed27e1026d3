// Static condensation: an element's linear system without the unknowns that no other element shares.
//
// An element's displacements count from its start, and the force g from beyond its end stands for the rest of the rod:
// all that lies beyond an element follows the displacement of its end, which changes no load. Then its displacements,
// internal forces and inner rotations are its own. Without the rotations their block of the tangent is [A B^T; B -C]
// with A >= 0 from the tendons, C >= 0 and B of full rank (stability.h): regular whatever the state, and for C = 0 too,
// where the internal forces alone would leave no regular block. Its determinant never changes its sign; with the inner
// rotations it does where an element buckles between its ends, which the whole's then has as a factor.
//
// What is left couples the rotations of the element's ends and g: rows of the moments at start and end and of the sum
// of all nodal forces, columns of the rotations at start and end and of g.
#pragma once

#include "fem_reference/beam_element.h"
#include "scene/branch_watch.h"

#include <array>
#include <vector>

namespace fem_reference {

// Components of all displacements and forces and of all rotations that may change.
struct Motions {
  std::vector<int> translations{0, 1, 2};
  std::vector<int> rotations{0, 1, 2};

  int size() const { return static_cast<int>(translations.size() + rotations.size()); }
};

// Where an element's unknowns stand among those of beam_element.h.
struct ElementParting {
  std::vector<int> inner;       // displacements of nodes 1.., forces, rotations of inner nodes
  std::vector<int> rotations;   // that stay: of the first node and the last
  std::vector<int> forces;      // rows of the displacements of node 0; those of node i are 6 i beyond
  std::vector<int> end_forces;  // places in `inner` of the last node's displacements, on which g acts
  int nodes = 0;

  int outer() const { return static_cast<int>(rotations.size() + forces.size()); }
};
ElementParting parting(const ReferenceElement& reference, const Motions& motions);

// All rotations stay, and g is not asked for: for loads that do not turn with the rod.
ElementParting rotations_apart(const ReferenceElement& reference);

class CondensedElement {
 public:
  // False: the inner block is singular.
  bool condense(const ElementParting& parting, const ElementSystem& system);

  // Another residual in place of the system's, which is condensed already.
  void set_residual(const ElementParting& parting, const ElementResidual& residual);

  // The condensed tangent and residual; rows and columns in the order above.
  double tangent(int row, int column) const { return table_(inner_ + row, inner_ + column); }
  double residual(int row) const { return -table_(inner_ + row, table_.cols() - 1); }
  scene::Determinant inner_determinant() const;

  // Increments of all unknowns, the inner ones first, from those of the rotations of the ends and g.
  void recover(Eigen::Ref<Eigen::VectorXd> increments) const;

 private:
  static constexpr int max_size = max_unknowns;
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, max_size, max_size + 1>;

  void gather(const ElementParting& parting, const ElementSystem& system);
  void gather_residual(const ElementParting& parting, const ElementResidual& residual);
  bool eliminate();

  // Rows: inner, then outer; columns: the same and the right hand side. Below the pivots what was taken of their rows.
  Table table_;
  int inner_ = 0;
  std::array<int, max_unknowns> pivot_rows_{};  // with which each inner row was exchanged
};

}  // namespace fem_reference
