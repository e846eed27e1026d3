#include "fam/engine.h"

#include "fam/load_length.h"
#include "fam/shape.h"

#include <algorithm>
#include <limits>

namespace fam {
namespace {

using scene::Span;
using scene::Status;

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

// What boundary value problems alone have; 0 of marches.
template <int D, class Get>
auto of_boundary_value(const BasicBoundaryValue<D>& problem, Get&& get) {
  return get(problem);
}
template <int D, class Get>
auto of_boundary_value(const BasicMarch<D>&, Get&& get) -> decltype(get(BasicBoundaryValue<D>())) {
  return 0;
}

template <int D>
double series_error_of(const SolvedRod<D>& rod, std::span<const Span> spans, std::span<const int> arcs_per_span) {
  return series_error_over_L<D>(spans, arcs_per_span, rod.arcs);
}

template <int D>
double largest_swing_of(const SolvedRod<D>& rod, std::span<const Span> spans, std::span<const int> arcs_per_span) {
  return largest_swing_rad<D>(spans, arcs_per_span, rod.arcs);
}

}  // namespace

void Engine::reserve(const Room& room, Law law) {
  march_.reserve(room);
  if (!facts_of(law).coupled) return;
  planar_march_.reserve(room);
  boundary_value_.reserve(room);
  planar_boundary_value_.reserve(room);
}

void Engine::set(const Problem& problem, std::span<const int> arcs_per_span, const Engine* fewer_arcs) {
  const Choice& choice = problem.choice();
  is_march_ = choice.march;
  is_planar_ = choice.plane.has_value();
  rotation_BP_ = choice.rotation_BP;
  const LoadWay& way = problem.way();
  const RodModel model = choice.rod.model;
  if (is_march_) {
    const TwistOrder order = problem.options().twist_order;
    if (is_planar_) planar_march_.set(way.to, arcs_per_span, choice.law, model, order);
    else march_.set(way.to, arcs_per_span, choice.law, model, order);
    return;
  }
  // Newton ends a hundredth of the tolerance away, or at round-off where the arcs are given and no tolerance is.
  const bool has_tolerance = problem.options().arcs == 0 || problem.options().tolerance_mm > 0;
  const double tolerance =
      has_tolerance ? std::clamp(1e-2 * problem.tolerance_mm() / problem.length_mm(), tightest_newton_tolerance, 1e-5)
                    : tightest_newton_tolerance;
  const auto set_to = [&](auto& solver, const auto* fewer) {
    solver.set(way, arcs_per_span, choice.law, model, tolerance, fewer);
  };
  if (is_planar_) set_to(planar_boundary_value_, fewer_arcs ? &fewer_arcs->planar_boundary_value_ : nullptr);
  else set_to(boundary_value_, fewer_arcs ? &fewer_arcs->boundary_value_ : nullptr);
}

Status Engine::run(double swing_limit_rad) {
  if (is_march_) return is_planar_ ? planar_march_.run() : march_.run();
  return is_planar_ ? planar_boundary_value_.run(swing_limit_rad) : boundary_value_.run(swing_limit_rad);
}
bool Engine::is_paused() const {
  return visit([](const auto& s) { return of_boundary_value(s, [](const auto& p) { return p.is_paused(); }); });
}
Status Engine::go_on_from(const Engine& fewer_arcs) {
  return is_planar_ ? planar_boundary_value_.go_on_from(fewer_arcs.planar_boundary_value_)
                    : boundary_value_.go_on_from(fewer_arcs.boundary_value_);
}

Status Engine::run_at_once() {
  if (is_march_) return run();
  return is_planar_ ? planar_boundary_value_.run_at_once() : boundary_value_.run_at_once();
}

Status Engine::run_from(const Engine& fewer_arcs) {
  if (is_march_) return run();
  return is_planar_ ? planar_boundary_value_.run_from(fewer_arcs.planar_boundary_value_)
                    : boundary_value_.run_from(fewer_arcs.boundary_value_);
}

int Engine::arc_count() const {
  return visit([](const auto& s) { return s.arc_count(); });
}
double Engine::load_factor() const {
  return visit([](const auto& s) { return of_boundary_value(s, [](const auto& p) { return p.load_factor(); }); });
}
bool Engine::nears_fold() const {
  return visit([](const auto& s) { return of_boundary_value(s, [](const auto& p) { return p.nears_fold(); }); });
}
int Engine::load_steps() const {
  return visit([](const auto& s) { return of_boundary_value(s, [](const auto& p) { return p.load_steps(); }); });
}
int Engine::newton_steps() const {
  return visit([](const auto& s) { return of_boundary_value(s, [](const auto& p) { return p.newton_steps(); }); });
}
void Engine::limit_newton_steps(int most) {
  planar_boundary_value_.limit_newton_steps(most);
  boundary_value_.limit_newton_steps(most);
}
bool Engine::has_one_solution() const {
  return is_march_ ||
         visit([](const auto& s) { return of_boundary_value(s, [](const auto& p) { return p.one_equilibrium(); }); });
}
bool Engine::way_was_smooth() const {
  return visit([](const auto& s) { return of_boundary_value(s, [](const auto& p) { return p.way_was_smooth(); }); });
}
double Engine::expected_turn_rad() const {
  return visit([](const auto& s) { return of_boundary_value(s, [](const auto& p) { return p.expected_turn_rad(); }); });
}
std::string Engine::failure_message(Status status) const {
  return visit([&](const auto& s) { return message_of(s, status); });
}

ArcExtent extent_of_arcs(const Engine& engine, std::span<const Span> spans, std::span<const int> arcs_per_span) {
  return {largest_load_length(spans, arcs_per_span),
          engine.visit([&](const auto& s) { return largest_swing_of(s.solved(), spans, arcs_per_span); }),
          engine.visit([](const auto& s) { return unseen_turn_rad(s.solved()); })};
}

double series_error_over_L(const Engine& engine, Law law, std::span<const Span> spans,
                           std::span<const int> arcs_per_span) {
  if (law != Law::sixth_order || !engine.has_one_solution()) return std::numeric_limits<double>::infinity();
  return engine.visit([&](const auto& s) { return series_error_of(s.solved(), spans, arcs_per_span); });
}

Status verdict(const Engine& engine, Law law, const ArcExtent& extent) {
  if (facts_of(law).by_series && !extent.resolved()) return Status::arc_not_converged;
  const bool collapsed = engine.visit([](const auto& s) { return any_tendon_collapsed(s.solved()); });
  return collapsed ? Status::tendon_collapsed : Status::converged;
}

}  // namespace fam
