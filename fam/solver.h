// One rod, solved again and again as its loads change, with the derivatives of every solution; fam::solve and
// fam::solve_batch stand on it. docs/library.md has examples.
//
// Frames and units as in scene/scene.h: base frame B at the clamp, section frame S(s); mm, N, N mm, rad.
#pragma once

#include "fam/batch.h"
#include "fam/solve.h"

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace fam {

// Why no Solver was made.
struct Refusal {
  scene::Status status;  // unsupported
  std::string message;   // one line
};

// What a column of Solver::jacobian is by: one value of a load (N, N mm, N/mm, m/s^2; a tendon's tension has component
// 0), of a section's rest curvature (1/mm) or stiffness (N mm^2: GJ, EI_y, EI_z), or the place of a point load (mm).
struct Parameter {
  enum class Kind { load, rest_curvature, stiffness, place };
  Kind kind;
  std::size_t index;  // of the load or section
  int component = 0;
};

// Memory is taken in make() only, unless Options::reserved_arcs is 0: for so many arcs, the estimate's finer run
// included; loads that need more end in tolerance_not_met. (Where more arcs than reserved are asked for, make() takes
// what its loads need to be solved; estimates, derivatives and loads of other kinds take more when they are asked for
// first.) Arcs are chosen anew in solve() by a priori bounds; error_estimate_mm() proves the tolerance. make and
// set_... throw scene::SceneError on wrong input (index, kind, NaN, a negative tension, a place off the rod) and leave
// the solver as it was. Getters give NaN before a converged solve, and for an s or an index out of range; they speak of
// the solution found last, which later set_... do not change. Different solvers may be used by different threads at
// once; one solver only by one, getters included.
class Solver {
 public:
  // Refuses what the law cannot solve (published).
  static std::variant<Solver, Refusal> make(const scene::Scene& scene, const Options& options = {});
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;
  ~Solver();

  // New values for scene.loads[load], whose kind, frame and place stay as they are.
  void set_force_N(std::size_t load, const Eigen::Vector3d& force_N);
  void set_moment_Nmm(std::size_t load, const Eigen::Vector3d& moment_Nmm);
  void set_distributed_N_per_mm(std::size_t load, const Eigen::Vector3d& force_N_per_mm);
  void set_acceleration_m_per_s2(std::size_t load, const Eigen::Vector3d& acceleration_m_per_s2);
  void set_tension_N(std::size_t load, double tension_N);
  // A point load moves along the rod.
  void set_at_mm(std::size_t load, double s_mm);
  void set_rest_curvature_per_mm(std::size_t section, const Eigen::Vector3d& rest_curvature_per_mm);
  // GJ, EI_y, EI_z; EA, GA and the mass stay as they are.
  void set_stiffness_Nmm2(std::size_t section, const Eigen::Vector3d& GJ_EIy_EIz_Nmm2);
  // With the values set.
  const scene::Scene& scene() const;

  // unloaded: the equilibrium that the rod reaches when all loads grow together from zero. last_solution: from the
  // loads (and compliances) solved last along the straight line between, on their branch (a load that has moved fades
  // out at its old place and in at the new); as unloaded before a first solution.
  enum class Start { unloaded, last_solution };
  // The statuses of solve() (fam/solve.h) and limit_point: a fold met on the way. Unless converged the last solution
  // stays.
  struct Outcome {
    scene::Status status;
    int load_steps, newton_steps;
    const char* message;  // never null; empty when converged
    bool converged() const { return status == scene::Status::converged; }
  };
  // Ends in work_limit once loads that grow have taken so many Newton steps, on all numbers of arcs tried: a few dozen
  // bound a tick of a stream, which takes up to five as a rule. Outcome: of the arcs tried last.
  Outcome solve(Start start = Start::last_solution, int newton_steps_at_most = most_newton_steps) noexcept;

  // The solution before the last one counts as the last again, which becomes the one before; values set stay. False:
  // there is none, or a solve that failed has taken its memory.
  bool go_back() noexcept;

  bool solved() const noexcept;  // there is a solution
  const scene::Pose& tip() const;
  scene::Wrench base_wrench_B() const;
  // At the arcs' ends, clamp to tip; empty before a solution.
  std::span<const double> s_mm() const;
  std::span<const scene::Pose> poses() const;         // X_BS
  std::span<const scene::Wrench> wrenches_B() const;  // the rod's own, as scene::Station has them
  // Anywhere, as accurate as at the arcs' ends.
  scene::Pose pose_at(double s_mm) const noexcept;
  scene::Wrench wrench_at(double s_mm) const noexcept;
  // Of any position along the rod, by a second resolution, made when asked for; infinite where that fails.
  double error_estimate_mm();
  // Whether the equilibrium is a minimum of the energy; empty: the loads have none, or not decided.
  std::optional<bool> stable() const;

  // Derivatives of the pose at s: 6 rows, d position_B (mm) and d rotation_B (rad; dR R^T = [d rotation_B]x), all
  // else held. Where the solution's arcs are too long for small changes (out of the plane of a circle) those of a finer
  // run. NaN also for the law `published`, and where that takes more arcs than are reserved.
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Matrix63 = Eigen::Matrix<double, 6, 3>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Matrix6 compliance(double s_mm) const noexcept;  // by a small fixed wrench (force, moment; base frame) at the tip
  Matrix63 by_load(std::size_t load, double s_mm) const noexcept;  // a tendon: the first column, by its tension
  Matrix63 by_rest_curvature(std::size_t section, double s_mm) const noexcept;
  Matrix63 by_stiffness(std::size_t section, double s_mm) const noexcept;  // GJ, EI_y, EI_z
  Vector6 by_place(std::size_t load, double s_mm) const noexcept;          // of a point load; NaN of other kinds
  // Of the strain: 6 rows, u (1/mm) and v, section frame.
  Matrix6 strain_compliance(double s_mm) const noexcept;
  Matrix63 strain_by_load(std::size_t load, double s_mm) const noexcept;
  Matrix63 strain_by_rest_curvature(std::size_t section, double s_mm) const noexcept;
  Matrix63 strain_by_stiffness(std::size_t section, double s_mm) const noexcept;
  Vector6 strain_by_place(std::size_t load, double s_mm) const noexcept;
  // Of the rod's own wrench: 6 rows, force (N) and moment (N mm), base frame.
  Matrix6 wrench_compliance(double s_mm) const noexcept;
  Matrix63 wrench_by_load(std::size_t load, double s_mm) const noexcept;
  Matrix63 wrench_by_rest_curvature(std::size_t section, double s_mm) const noexcept;
  Matrix63 wrench_by_stiffness(std::size_t section, double s_mm) const noexcept;
  Vector6 wrench_by_place(std::size_t load, double s_mm) const noexcept;
  // Of the poses at many places: six rows for each s, a column for each parameter. `result` must have that size.
  void jacobian(std::span<const double> s_mm, std::span<const Parameter> parameters,
                Eigen::Ref<Eigen::MatrixXd> result) const noexcept;

  // Of the pose, by one of them.
  Vector6 by(const Parameter& parameter, double s_mm) const noexcept;

 private:
  template <class Answer, class Ask>
  Answer asked(Ask&& ask) const noexcept;

  struct Impl;
  explicit Solver(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fam
