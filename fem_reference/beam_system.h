// The whole beam: unknowns, assembly and linear solution, on deal.II, which no other header here shows.
#pragma once

#include "fem_reference/condensed_rod.h"
#include "fem_reference/stability.h"
#include "scene/branch_watch.h"

#include <memory>
#include <optional>

namespace fem_reference {

// Residual of a state, dimensionless as in beam_model.h.
struct Residual {
  double largest_force = 0;  // of the equilibrium equations of the free nodes
  double largest_moment = 0;
  double largest_gap = 0;  // of the strain equations of the Gauss points, weighted by length

  double largest() const;
  bool finite() const;
};

class BeamSystem {
 public:
  // Keeps a reference to the model, whose loads and rest curvatures may change; not its elements' lengths.
  explicit BeamSystem(const BeamModel& model);
  ~BeamSystem();

  // Residual at a state under load_factor times the loads.
  Residual residual(const BeamState& state, double load_factor);

  // The same, and the tangent, which all that follows is about.
  Residual assemble(const BeamState& state, double load_factor);

  // Newton increment of the system assembled last, clamped at s = 0. False: the matrix is singular.
  bool newton_increment(BeamIncrement& increment);

  // Of the tangent assembled last, as it acts on motions in the plane of the model's symmetry if there is one. Empty:
  // the matrix is singular.
  std::optional<scene::Determinant> determinant();

  // The same of motions in the x-y plane alone, and of all motions, which leave a pinned rotation as it is.
  std::optional<scene::Determinant> determinant_in_xy();
  std::optional<scene::Determinant> determinant_in_space();

  // The rotation that no increment changes from the next assembly on: where the rod may turn freely.
  void set_pin(const std::optional<Pin>& pin);

  // Increment that takes away another imbalance, by the tangent assembled last; after newton_increment(). False: the
  // matrix is singular.
  bool increment(const Imbalance& imbalance, BeamIncrement& increment);

  // Of the state assembled last, an equilibrium of a conservative model.
  std::optional<Inertia> inertia();

  // Whether the state assembled last, an equilibrium of a conservative model, is stable (stability.h).
  std::optional<bool> is_stable();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fem_reference
