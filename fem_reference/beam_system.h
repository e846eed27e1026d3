// The whole beam: unknowns, assembly and linear solution, on deal.II, which no other header here shows.
#pragma once

#include "fem_reference/beam_element.h"
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
  explicit BeamSystem(const BeamModel& model);  // keeps a reference to the model
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

  // Whether the state assembled last, an equilibrium of a conservative model, is stable (stability.h).
  std::optional<bool> is_stable();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fem_reference
