// The four solvers as one: a march or a boundary value problem, in space or in the plane.
#pragma once

#include "fam/boundary_value.h"
#include "fam/march.h"
#include "fam/model_choice.h"

#include <span>
#include <string>
#include <variant>
#include <vector>

namespace fam {

using Engine = std::variant<March, BasicMarch<2>, BoundaryValue, BasicBoundaryValue<2>>;

// Of the spans of the scene, with all the memory that it needs.
Engine make_engine(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, const Choice& choice,
                   const Options& options);

int arc_count(const Engine& solver);
bool is_march(const Engine& solver);
double load_factor(const Engine& solver);  // that a boundary value problem has reached
std::string failure_message(const Engine& solver, scene::Status status);

// Whether the arcs resolve the load and the rod's turns. Longer ones do not see them, and two resolutions may agree by
// chance: the error estimate is then at least L, and the series of an arc has no answer at all. Chosen, not measured.
constexpr double longest_load_length = 2.5;  // of an arc: sqrt(force / EI) h
constexpr double longest_swing_rad = 2.5;    // load_length.h
struct ArcExtent {
  double load_length, swing_rad;
  bool resolved() const { return load_length <= longest_load_length && swing_rad <= longest_swing_rad; }
};
// Of the longest of solved arcs; spans as they were solved (Choice::solved_spans).
ArcExtent extent_of_arcs(const Engine& solver, std::span<const scene::Span> spans, std::span<const int> arcs_per_span);

// What a solve with a given number of arcs ends in, that has converged: arc_not_converged where the law's series do not
// reach the arcs' ends, tendon_collapsed where a tendon's path has no length, else converged. Does not allocate.
scene::Status verdict(const Engine& solver, Law law, const ArcExtent& extent);

}  // namespace fam
