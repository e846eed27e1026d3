// Equilibria of a rod that one number, the parameter, changes, followed by arc length: multiple shooting's equations
// with the parameter as one more unknown and one more row, which holds the solution at a distance s from the last one
// along the path's tangent. That matrix is regular at folds; its determinant changes sign where branches cross.
//
// A solution x holds the first ten components of all node states and, last, the parameter. Lengths are root mean
// squares over the nodes, of quaternions and of wrenches over the largest, and of the parameter over its scale.
#pragma once

#include "exact_reference/bordered_system.h"
#include "exact_reference/shooting.h"

#include <cmath>
#include <functional>
#include <optional>

namespace exact_reference {

// Sets the rod to a value of the parameter; returns the load factor that RodEquations take with it. Spans and their
// stiffnesses stay.
using ParameterSetter = std::function<double(ScaledRod& rod, double parameter)>;

struct Solution {
  Eigen::VectorXd x, tangent;          // of length 1
  bool negative = false;               // determinant, with the row of the tangent of the step's start
  std::optional<bool> negative_in_xy;  // of motions in the x-y plane: straight rods under loads without an energy
  std::optional<int> index;            // empty also where an eigenvalue is zero within round-off

  double parameter() const { return x[x.size() - 1]; }
  double slope() const { return tangent[tangent.size() - 1]; }  // d(parameter)/ds
};

class Continuation {
 public:
  // The mesh is one of the rod's. Tolerance as of Options. has_energy: at every value of the parameter.
  Continuation(ScaledRod rod, ParameterSetter set, double parameter_scale, double tolerance, Mesh mesh,
               bool has_energy);

  // At an equilibrium, to be refined, that can be continued in the parameter. False: Newton's iteration fails.
  bool start(const NodeStates& y, double parameter, double direction);
  // Along `direction` from an equilibrium on this mesh where branches meet. With `free_turn`: the branch's equilibria
  // can be turned about the axis at no cost, and this direction of the null space is kept at zero.
  void start_branch(const Eigen::VectorXd& x, const Eigen::VectorXd& direction, const Eigen::VectorXd* free_turn);

  const Solution& base() const { return base_; }
  // The next step starts there. The mesh is refined to the tolerance; false: that fails.
  bool advance(Solution next);

  // The solution at a distance from the base, from the straight prediction or from a guess; empty: Newton fails.
  std::optional<Solution> at(double s) { return at(s, base_.x + s * base_.tangent); }
  std::optional<Solution> at(double s, const Eigen::VectorXd& guess);
  // The solution at this parameter next to one there.
  std::optional<Solution> at_parameter(double parameter, const Solution& near);

  // How singular the matrix at a solution is along given singular vectors: see smallest_vectors().
  struct SingularVectors {
    Eigen::MatrixXd left, right;
  };
  SingularVectors smallest_vectors(const Solution& at, int count);
  // G of [M left; right^T 0] [V; G] = [0; 1]: singular where M is, and smooth. V, there M's null vectors, come in the
  // solution's units.
  struct Singularity {
    Eigen::MatrixXd G, null_vectors;
  };
  Singularity singularity(const Eigen::VectorXd& x, const SingularVectors& vectors);

  // Of the equations at x, in the matrix's units.
  double largest_residual(const Eigen::VectorXd& x);

  double inner(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  // The angle between the path's tangents at the base and there, or, if that is larger, the largest rotation of a
  // section.
  double turn_to(const Solution& there) const;
  // A solution further on is one of this branch: the turn is small, and the cubic curve between the two nearly solves
  // the equations halfway. Else it may be another's, or folds may lie between.
  bool leads_to(const Solution& there);

  // With positions, the rod and the load factor set to the parameter's value.
  NodeStates states(const Eigen::VectorXd& x);
  const ScaledRod& rod() const { return rod_; }
  const Shooting& shooting() const { return shooting_; }
  double load_factor() const { return load_factor_; }
  double parameter_scale() const { return scale_; }
  bool turns_freely() const { return free_row_.size() > 0; }
  // The turn changes no equation at this solution. If not, forget it.
  bool is_turn_free(const Eigen::VectorXd& x);
  void hold_turn();
  bool is_straight(const Eigen::VectorXd& x) const;

 private:
  void set(double parameter);
  long size() const { return core_size * static_cast<long>(shooting_.mesh().size() + 1); }
  // Between the solution's units and the matrix's.
  Eigen::VectorXd weighted(const Eigen::VectorXd& a) const;
  Eigen::VectorXd unweighted(const Eigen::VectorXd& a) const;
  Eigen::VectorXd row_of(const Eigen::VectorXd& direction) const;  // times a weighted vector: inner()
  Eigen::VectorXd parameter_column(const NodeStates& y, double parameter);
  // The matrix at x with a row of this direction, to be factorised.
  struct Bordered {
    BandSystem& band;
    Eigen::MatrixXd columns, rows;
  };
  Bordered bordered(const Eigen::VectorXd& x, const Eigen::VectorXd& direction);
  bool factorise(const Eigen::VectorXd& x, const Eigen::VectorXd& direction);
  // Newton's iteration onto inner(direction, x - origin) = s.
  bool correct(Eigen::VectorXd& x, const Eigen::VectorXd& origin, const Eigen::VectorXd& direction, double s);
  bool measure(Solution& at);
  bool refine(Solution& at);
  bool set_free_turn(const Solution& at);

  ScaledRod rod_;
  ParameterSetter set_;
  double scale_, tolerance_, load_factor_ = 1, set_to_ = NAN;
  Shooting shooting_;
  bool has_energy_;
  Core weight_ = Core::Ones();
  Solution base_;
  BorderedSystem matrix_, wider_;
  // Where equilibria turn about the axis at no cost: the turn's direction, in the matrix's units, and one out of the
  // equations' range.
  Eigen::VectorXd free_row_, free_column_;
};

}  // namespace exact_reference
