// The rods of an estimation problem, solved for one set of values of the unknowns after another.
#pragma once

#include "fam/solver.h"

#include "scene/estimation.h"

#include <span>
#include <string>
#include <vector>

namespace fam {

// The unit of an unknown: EI/L^2, EI/L, L, 1, 1/L of the first section.
double unit_of(const scene::Unknown& unknown, const scene::EstimationProblem& problem);

// The nearest value that the scene can have: places on the rod, tensions that pull, factors above zero.
double within_bounds(const scene::Unknown& unknown, const scene::EstimationProblem& problem, double value);
// Whether that is a bound which nature does not know: a stiffness' factor may be any positive number.
bool is_at_chosen_bound(const scene::Unknown& unknown, double value);

class EstimatedRods {
 public:
  // Options as of Estimator.
  EstimatedRods(const scene::EstimationProblem& problem, const Options& options);

  // Values of the unknowns in the units of the scene.
  void put(std::span<const double> values);
  // What was put last.
  void put_into(scene::EstimationProblem& problem) const;

  // From now on solvers take memory as they are made, for as many arcs as loads like these need. True: those that stand
  // are lost, and with them their solutions.
  bool reserve();

  // A solver that reserves too few arcs is made anew. From a last solution work_limit where the way there is long
  // (most_way_newton_steps).
  bool solve(std::size_t scene, Solver::Start start);
  // To the solution before the last one.
  bool go_back(std::size_t scene) { return solvers_[scene]->go_back(); }
  const Solver& solver(std::size_t scene) const { return *solvers_[scene]; }
  // Why solve() failed.
  scene::Status status() const { return status_; }
  const std::string& message() const { return message_; }

 private:
  bool make(std::size_t scene);
  void set_values(Solver& solver, std::size_t scene) const;

  scene::EstimationProblem now_;
  std::vector<std::vector<scene::Section>> sections_;  // before any factor
  std::vector<double> values_;
  Options options_;
  std::vector<std::optional<Solver>> solvers_;
  bool has_sections_ = false;  // among the unknowns
  scene::Status status_ = scene::Status::converged;
  std::string message_;
};

}  // namespace fam
