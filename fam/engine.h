// The four solvers as one: a march or a boundary value problem, in space or in the plane, in memory that is kept from
// one rod to the next.
#pragma once

#include "fam/boundary_value.h"
#include "fam/march.h"
#include "fam/problem.h"

#include <string>

namespace fam {

class Engine {
 public:
  // For every solver that loads of this rod may come to ask for; law: chosen.
  void reserve(const Room& room, Law law);
  // Takes memory where more arcs, segments or spans are asked for than ever before. The problem must stay as it is as
  // long as the engine is asked anything. fewer_arcs: one of the same problem, for run_from().
  void set(const Problem& problem, std::span<const int> arcs_per_span, const Engine* fewer_arcs = nullptr);

  // swing_limit_rad: where a boundary value problem pauses (BasicBoundaryValue::run).
  scene::Status run(double swing_limit_rad = std::numeric_limits<double>::infinity());
  bool is_paused() const;
  scene::Status go_on_from(const Engine& fewer_arcs);
  // A march, or a boundary value problem whose loads need not be grown; else not_converged.
  scene::Status run_at_once();
  // From the solution with fewer arcs that this was set by; a march starts anew.
  scene::Status run_from(const Engine& fewer_arcs);
  // Along the problem's way from the shape that the rod had, if known as another engine's solution, and to where the
  // tip has turned by about so much: state_at(arc), SectionState<3> at an arc's distal end in the base frame, without
  // the point loads there.
  template <class StateAt>
  scene::Status run_on(const Engine* last, const Vector3d& tip_turn_B, StateAt&& state_at);

  // visit(solver): BasicMarch<D> or BasicBoundaryValue<D>.
  template <class Visit>
  decltype(auto) visit(Visit&& visit) const {
    if (is_march_) return is_planar_ ? visit(planar_march_) : visit(march_);
    return is_planar_ ? visit(planar_boundary_value_) : visit(boundary_value_);
  }
  // visit(solver, the other's), which must be of the same kind.
  template <class Visit>
  decltype(auto) visit_with(const Engine& other, Visit&& visit) const {
    if (is_march_) {
      return is_planar_ ? visit(planar_march_, other.planar_march_) : visit(march_, other.march_);
    }
    return is_planar_ ? visit(planar_boundary_value_, other.planar_boundary_value_)
                      : visit(boundary_value_, other.boundary_value_);
  }

  bool is_march() const { return is_march_; }
  bool is_planar() const { return is_planar_; }
  int arc_count() const;
  double load_factor() const;  // that a boundary value problem has reached
  bool nears_fold() const;     // there
  int load_steps() const;
  int newton_steps() const;
  void limit_newton_steps(int most);  // that loads take to grow, from now on
  bool has_one_solution() const;      // a march, or no other equilibrium
  bool way_was_smooth() const;        // no critical point was near as the load grew
  double expected_turn_rad() const;   // of a segment's end, in the step that Newton left out; 0: a march
  std::string failure_message(scene::Status status) const;

 private:
  bool is_march_ = true, is_planar_ = false;
  Matrix3d rotation_BP_ = Matrix3d::Identity();
  BasicMarch<3> march_;
  BasicMarch<2> planar_march_;
  BasicBoundaryValue<3> boundary_value_;
  BasicBoundaryValue<2> planar_boundary_value_;
};

// Whether the arcs resolve the load and the rod's turns. Longer ones do not see them, and two resolutions may agree by
// chance: the error estimate is then at least L, and the series of an arc has no answer at all. Chosen, not measured.
constexpr double longest_load_length = 2.5;  // of an arc: sqrt(force / EI) h
constexpr double longest_swing_rad = 2.5;    // load_length.h
// The error over L is taken for at least this times the unseen turn (shape.h). Of eight random scenes with a tendon
// that all but collapses in a layer thinner than an arc, solved with 8 to 256 arcs, the error is at most 0.13 of it.
constexpr double unseen_share = 0.2;
struct ArcExtent {
  double load_length, swing_rad, unseen_turn_rad;
  bool resolved() const { return load_length <= longest_load_length && swing_rad <= longest_swing_rad; }
  double least_error_over_L(bool trusted) const { return trusted ? unseen_share * unseen_turn_rad : 1; }
};
// Of the longest of solved arcs; spans as they were solved (Problem::spans).
ArcExtent extent_of_arcs(const Engine& engine, std::span<const scene::Span> spans, std::span<const int> arcs_per_span);

// series_error_over_L (load_length.h) of the solved arcs; infinite of another law than sixth_order, and where there may
// be another equilibrium.
double series_error_over_L(const Engine& engine, Law law, std::span<const scene::Span> spans,
                           std::span<const int> arcs_per_span);

// What a solve with a given number of arcs ends in, that has converged: arc_not_converged where the law's series do not
// reach the arcs' ends, tendon_collapsed where a tendon's path has no length, else converged. Does not allocate.
scene::Status verdict(const Engine& engine, Law law, const ArcExtent& extent);

template <class StateAt>
scene::Status Engine::run_on(const Engine* last, const Vector3d& tip_turn_B, StateAt&& state_at) {
  if (is_march_) return run();
  const bool alike = last && !last->is_march_ && last->is_planar_ == is_planar_;
  if (!is_planar_) return boundary_value_.run_on(alike ? &last->boundary_value_ : nullptr, tip_turn_B, state_at);
  const Angular<double, 2> planar_turn_B = (rotation_BP_.transpose() * tip_turn_B).tail<1>();
  return planar_boundary_value_.run_on(alike ? &last->planar_boundary_value_ : nullptr, planar_turn_B, [&](int arc) {
    const SectionState<3> state = state_at(arc);
    SectionState<2> planar;
    planar.rotation_SB = (rotation_BP_.transpose() * state.rotation_SB * rotation_BP_).topLeftCorner<2, 2>();
    planar.wrench.force_N = (rotation_BP_.transpose() * state.wrench.force_N).head<2>();
    planar.wrench.moment_Nmm = (rotation_BP_.transpose() * state.wrench.moment_Nmm).tail<1>();
    return planar;
  });
}

}  // namespace fam
