// Multiple shooting: the states at all mesh nodes are unknown at once, so that nothing is carried over a long stretch
// and no growth of exp(sqrt(F L^2/EI)) can spoil the answer. Newton's matrix is banded and solved by SUNDIALS' LU with
// partial pivoting; cost linear in the number of intervals.
#pragma once

#include "exact_reference/runge_kutta.h"
#include "scene/branch_watch.h"

#include <memory>
#include <span>
#include <vector>

namespace exact_reference {

// One Runge-Kutta step long.
struct Interval {
  int span = 0;
  double start = 0;
  double length = 0;
  bool ends_span = false;
};

using Mesh = std::vector<Interval>;

// States at the nodes, mesh.size() + 1 of them. At a span's end: the state before its point loads.
using NodeStates = std::vector<State>;

struct MeshedStates {
  Mesh mesh;
  NodeStates y;
};

struct Convergence {
  bool converged = false;
  bool tendon_collapsed = false;  // given up because a tendon's path has no length somewhere
  int iterations = 0;
  double last_update = 0;  // largest change of a component; rotations in half radians, wrenches relative to the largest
};

class BandSystem;

class Shooting {
 public:
  // At least one interval a span and `minimum` in all, at most half a radian of rest curvature an interval.
  Shooting(const ScaledRod& rod, int minimum);
  // On a mesh of a rod that has the same spans.
  Shooting(const ScaledRod& rod, Mesh mesh);
  ~Shooting();
  Shooting(const Shooting&) = delete;
  Shooting& operator=(const Shooting&) = delete;

  // The unloaded rod: clamp at the origin, rest curvature only.
  NodeStates unloaded() const;

  // Newton's iteration without damping. Converged when an update is <= tolerance, or no longer falling (round-off) and
  // <= 1e-9, from the fifth on <= 1e-6 (a motion that next to nothing resists). Given up when not finite, when two
  // updates grow in turn, or after max_iterations.
  Convergence newton(NodeStates& y, double load_factor, double tolerance, int max_iterations);

  // d(states)/d(load_factor) at a solution; zero if the matrix is singular there.
  std::vector<Core> tangent(const NodeStates& y, double load_factor);

  // Splits the intervals whose step disagrees with two half steps by more than the tolerance (components as in
  // Convergence, position over L), or whose sensitivity's volume changes by more than that. Returns whether any was
  // split; more than max_intervals: no split, false.
  bool refine(NodeStates& y, double load_factor, double tolerance, double most_volume_change, int max_intervals);
  void halve(NodeStates& y, double load_factor);

  // Of the equations' derivatives, as they act on motions in the plane of the rod's symmetry if there is one. It does
  // not depend on the mesh; its sign differs from one branch to the next.
  scene::Determinant determinant(const NodeStates& y, double load_factor) const;
  // The same for motions in this plane, or for all; the states lie in it.
  scene::Determinant determinant(const NodeStates& y, double load_factor, scene::Symmetry plane) const;

  // Newton's matrix and its residual (the system's vector), unknowns and equations multiplied by `weight`.
  BandSystem& newton_equations(const NodeStates& y, double load_factor, const Core& weight);
  // The residual alone, and the weights that newton() takes.
  Eigen::VectorXd residual(const NodeStates& y, double load_factor, const Core& weight) const;
  Core weights(const NodeStates& y) const;  // 1 for q, 1/(1 + largest) for N and M

  // Sets the positions, which Newton's unknowns do not hold.
  void integrate_positions(NodeStates& y, double load_factor) const;

  // State at the start of interval i, beyond the point loads there.
  State start_state(const NodeStates& y, double load_factor, std::size_t i) const;
  RodEquations equations(std::size_t i, double load_factor) const;

  const Mesh& mesh() const { return mesh_; }
  const ScaledRod& rod() const { return rod_; }

  // |det - 1| of each interval's sensitivity in Newton's last iteration, if the mesh is still that one. The exact one
  // is 1 (the equations' Jacobian has no trace): what grows along the interval and what decays, both must be resolved,
  // though a straight taut rod or a rod with next to no torsional stiffness shows nothing of it in its shape.
  const std::vector<double>& volume_changes() const { return volume_changes_; }

  // Each interval's step from these states and its derivatives by them. The last ones are kept: Newton's equations, the
  // determinant, the stability and the tangent at one state share them.
  struct Linearised {
    NodeStates y;
    double load_factor = 0;
    NodeStates ends;
    std::vector<CoreMatrix> sensitivities;
  };
  const Linearised& linearised(const NodeStates& y, double load_factor) const;

  // After a change of the rod's loads.
  void forget() { linearised_ = {}; }

  // Intervals linearised so far: what costs.
  double work() const { return work_; }

 private:
  void assemble(BandSystem& band, std::span<const int> components, const NodeStates& y, double load_factor,
                const Core& weight, std::vector<double>* volume_changes = nullptr) const;
  bool tendon_collapses(const NodeStates& y, double load_factor) const;
  double local_error(const NodeStates& y, double load_factor, const Core& weight, std::size_t i) const;
  void split(NodeStates& y, double load_factor, const std::vector<int>& parts);

  const ScaledRod& rod_;
  Mesh mesh_;
  std::unique_ptr<BandSystem> band_;
  std::vector<double> volume_changes_;
  mutable Linearised linearised_;
  mutable double work_ = 0;
};

}  // namespace exact_reference
