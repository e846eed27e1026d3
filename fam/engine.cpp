#include "fam/engine.h"

#include "fam/load_length.h"
#include "fam/shape.h"

#include <algorithm>

namespace fam {
namespace {

using scene::Span;
using scene::Status;

template <int D>
Engine solver_in(std::span<const Span> spans, std::span<const int> arcs, const Choice& choice, const Options& options) {
  if (choice.march) return BasicMarch<D>(spans, arcs, choice.law, choice.rod.model, options.twist_order);
  // Newton ends a thousandth of the tolerance away, or at round-off where none is given.
  const double newton_tolerance =
      std::clamp(1e-3 * options.tolerance_mm / spans.back().end_mm, tightest_newton_tolerance, 1e-6);
  return BasicBoundaryValue<D>(spans, arcs, choice.law, choice.rod.model, newton_tolerance);
}

template <int D>
std::string message_of(const BasicMarch<D>& march, Status status) {
  const std::string arcs = std::to_string(march.arc_count());
  if (status == Status::arc_not_converged) {
    return "the bending angle of arc " + std::to_string(march.failed_arc()) + " of " + arcs +
           " (from the clamp) was not found; more arcs make each one easier";
  }
  if (status == Status::tendon_collapsed)
    return "a tendon's path has no length somewhere: |v + u x r| = 0, with " + arcs + " arcs";
  return "a pose or wrench overflowed with " + arcs + " arcs";
}
template <int D>
std::string message_of(const BasicBoundaryValue<D>& problem, Status) {
  return problem.message() + ", with " + std::to_string(problem.arc_count()) + " arcs";
}

template <int D>
double load_factor_of(const BasicMarch<D>&) {
  return 0;
}
template <int D>
double load_factor_of(const BasicBoundaryValue<D>& problem) {
  return problem.load_factor();
}

template <int D>
double largest_swing_of(const SolvedRod<D>& rod, std::span<const Span> spans, std::span<const int> arcs_per_span) {
  return largest_swing_rad<D>(spans, arcs_per_span, rod.arcs);
}

}  // namespace

Engine make_engine(std::span<const Span> spans, std::span<const int> arcs_per_span, const Choice& choice,
                   const Options& options) {
  if (choice.plane) return solver_in<2>(choice.plane->spans, arcs_per_span, choice, options);
  return solver_in<3>(choice.solved_spans(spans), arcs_per_span, choice, options);
}

int arc_count(const Engine& solver) {
  return std::visit([](const auto& s) { return s.arc_count(); }, solver);
}

bool is_march(const Engine& solver) {
  return std::holds_alternative<March>(solver) || std::holds_alternative<BasicMarch<2>>(solver);
}

double load_factor(const Engine& solver) {
  return std::visit([](const auto& s) { return load_factor_of(s); }, solver);
}

std::string failure_message(const Engine& solver, Status status) {
  return std::visit([&](const auto& s) { return message_of(s, status); }, solver);
}

ArcExtent extent_of_arcs(const Engine& solver, std::span<const Span> spans, std::span<const int> arcs_per_span) {
  return {largest_load_length(spans, arcs_per_span),
          std::visit([&](const auto& s) { return largest_swing_of(s.solved(), spans, arcs_per_span); }, solver)};
}

Status verdict(const Engine& solver, Law law, const ArcExtent& extent) {
  if (facts_of(law).by_series && !extent.resolved()) return Status::arc_not_converged;
  const bool collapsed = std::visit([](const auto& s) { return any_tendon_collapsed(s.solved()); }, solver);
  return collapsed ? Status::tendon_collapsed : Status::converged;
}

}  // namespace fam
