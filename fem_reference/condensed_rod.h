// Newton's linear system of the whole rod, its elements condensed to what stands at their ends.
//
// At each vertex but the clamp: the increment of the rotation, and g, the force that all beyond exerts on the element
// that ends there. Their equations: the moments at the vertex, and
//   g = load at the vertex + sum of all nodal forces of the next element + g at its end,
// each with its increment. The determinant is that of the whole uncondensed system, clamped: sums of rows and columns
// leave it as it is, g enters with a unit triangular block, and the elements' inner blocks count as factors.
#pragma once

#include "fem_reference/band_system.h"
#include "fem_reference/condensed_element.h"
#include "fem_reference/imbalance.h"

#include <optional>

namespace fem_reference {

// A component of the rotation of an element's end that may not change; the ends are counted from the clamp, which is 0.
struct Pin {
  std::size_t vertex = 1;
  int component = 0;
};

class CondensedRod {
 public:
  // vertex_unknowns: the number of the first of motions.size() unknowns, rotations first, of each element's end.
  CondensedRod(const BeamModel& model, const Motions& motions, std::vector<int> vertex_unknowns);

  // False: singular.
  bool factorise(const std::vector<ElementSystem>& elements, const std::vector<NodalSystem>& loads,
                 const std::optional<Pin>& pin = {});

  // Another residual in place of the system's.
  void set_residual(const Imbalance& imbalance);

  // Of the system factorised last.
  scene::Determinant determinant() const;

  // Newton's increment by the system factorised last. Motions that it leaves out are zero.
  void increment(BeamIncrement& increment) const;

 private:
  void add_element(std::size_t e);
  void add_element_residual(std::size_t e);
  void add_load(const NodalLoad& load, const NodalSystem& system);
  void add_load_residual(std::size_t vertex, const Eigen::Matrix<double, 6, 1>& residual);
  template <typename AddRow>
  void for_rows(std::size_t e, const AddRow& add_row) const;
  void recover(std::size_t e, const std::vector<double>& solution, Eigen::VectorXd& found,
               BeamIncrement& increment) const;
  int unknown(std::size_t e, int outer) const;  // number of an element's outer unknown (condensed_element.h)

  const BeamModel& model_;
  Motions motions_;
  std::vector<int> vertex_unknowns_;  // negative: clamped
  ElementParting parting_;
  BandSystem band_;
  std::vector<double> residual_;
  std::vector<CondensedElement> elements_;
  int pinned_ = -1;  // an unknown; negative: none
};

}  // namespace fem_reference
