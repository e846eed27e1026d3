// What a Solver keeps (fam/solver.h); solver.cpp solves, solver_values.cpp takes new loads, solver_answers.cpp tells.
#pragma once

#include "fam/response.h"
#include "fam/solution.h"
#include "fam/solver.h"

#include <array>
#include <limits>

namespace fam {

inline const scene::Pose no_pose{Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()),
                                 Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())};
inline const scene::Wrench no_wrench{no_pose.position_B_mm, no_pose.position_B_mm};

// A problem and its solution.
struct Attempt {
  Problem problem;
  Run run;
};

struct Solver::Impl {
  scene::Scene scene;
  Options options;
  RodModel model_asked_for;
  int most_arcs = 0;
  std::array<Attempt, 2> attempts;
  ArcExtent extent;           // of the arcs that solve_with_arcs() solved last
  Attempt* solved = nullptr;  // the solution found last
  bool has_previous = false;  // the other attempt is the one before
  Solution solution;          // of it
  scene::Pose tip = no_pose;
  std::array<Run, 2> spare;
  std::vector<int> arcs;
  scene::CellShares shares;
  struct {
    bool known = false;
    std::vector<double> s_mm;
    std::vector<scene::Pose> poses;
    std::vector<scene::Wrench> wrenches_B;
  } ends;  // of the arcs
  Response response;
  struct {
    bool known = false;
    std::vector<int> arcs;
    std::vector<SectionPose> poses;
    std::vector<SectionWrench> distal_wrenches_S;
  } solved_states;  // that the response is asked about
  Solution finer;   // whose states they are where the solution's arcs are too long for small changes
  std::optional<double> error_mm;
  std::optional<std::optional<bool>> stable;

  Impl(const scene::Scene& scene, const Options& options);
  void choose_model();
  void reserve();
  Attempt& next() { return attempts[solved == &attempts[0] ? 1 : 0]; }
  Outcome solve(Start start, int newton_steps_at_most);
  scene::Status solve_with_arcs(Attempt& attempt, bool on, int newton_steps_at_most);
  Vector3d expected_tip_turn_B();
  void choose_arcs(const Problem& problem);
  scene::Status refine(Attempt& attempt);
  void accept(Attempt& attempt);
  void place_ends();
  double swing_of_changes_rad() const;
  void take_states(const Solution& from, std::span<const int> arcs_per_span);
  bool take_states_for_changes();
  Response* prepared_response();
  double estimate_mm();
  bool is_on_rod(double s_mm) const {
    return solved && s_mm >= 0 && s_mm <= solved->problem.length_mm() * (1 + scene::same_place_relative);
  }
};

}  // namespace fam
