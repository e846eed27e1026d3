#include "fam/answer.h"

#include "fam/stations.h"
#include "scene/span_facts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>

namespace fam {
namespace {

template <int D>
Stability stability_of(const BasicBoundaryValue<D>& solver) {
  return solver.stability();
}
template <int D>
Stability stability_of(const BasicMarch<D>&) {
  return {};
}

using scene::Equilibrium;
using scene::Span;
using scene::Status;

Stability stability_of(const Run& run) {
  return run.engine.visit([](const auto& solver) { return stability_of(solver); });
}

// The sign of the energy's second variation, from the run and the other or finer ones, until two agree of which one has
// twice the other's arcs.
template <int D>
std::optional<bool> judged(const BasicBoundaryValue<D>& solver, const Problem& problem, const Run& run,
                           const Run* other, std::array<Run*, 2> spare, int arcs_at_most) {
  if (solver.one_equilibrium()) return true;
  Stability coarse = solver.stability();
  const bool is_double = other && other->converged() &&
                         (other->arc_count() == 2 * run.arc_count() || run.arc_count() == 2 * other->arc_count());
  if (is_double && agree(coarse, stability_of(*other))) return coarse.conjugate_points == 0;
  const Run* last = &run;
  for (int doublings = 0; doublings < most_stability_doublings; ++doublings) {
    Run& next = *spare[static_cast<std::size_t>(doublings % 2)];
    if (last->arc_count() > arcs_at_most / 2) return std::nullopt;
    next.solve(problem, last->arcs, 2, last);
    if (!next.converged()) return std::nullopt;
    const Stability finer = stability_of(next);
    if (agree(coarse, finer)) return finer.conjugate_points == 0;
    coarse = finer;
    last = &next;
  }
  return std::nullopt;
}
// No loads, or tendons alone: the energy is convex in the strains, and no load does work.
template <int D>
std::optional<bool> judged(const BasicMarch<D>&, const Problem&, const Run&, const Run*, std::array<Run*, 2>, int) {
  return true;
}

// What the boundary value solver did.
template <int D>
void report(const BasicBoundaryValue<D>& solver, Equilibrium& result) {
  result.model.emplace_back("segments", solver.segment_count());
  result.model.emplace_back("load_steps", solver.load_steps());
  result.model.emplace_back("newton_iterations", solver.newton_steps());
}
template <int D>
void report(const BasicMarch<D>&, Equilibrium&) {}

// Turns each section about its tangent by what GJ adds to the rod that was solved: the moment about the tangent is
// constant along a span.
void twist_sections(Equilibrium& result, std::span<const Span> spans) {
  double twist_rad = 0;
  std::size_t i = 0;
  for (std::size_t k = 1; k < result.stations.size(); ++k) {
    scene::Station& station = result.stations[k];
    const double last_mm = result.stations[k - 1].s_mm;
    if (last_mm >= spans[i].end_mm) ++i;
    const double moment_Nmm = station.moment_B_Nmm.dot(station.X_BS.rotation_BS.col(0));
    twist_rad += twist_per_Nmm2(spans[i]) * moment_Nmm * (station.s_mm - last_mm);
    station.X_BS.rotation_BS *= Eigen::AngleAxisd(twist_rad, Vector3d::UnitX()).toRotationMatrix();
  }
}

template <int D>
bool has_torsion(const SolvedRod<D>& rod) {
  if constexpr (D == 2) return false;
  else
    return std::any_of(rod.arcs.begin(), rod.arcs.end(), [](const Arc& arc) {
      return arc.screw.rotation[0] != 0 || arc.twist_before_rad != 0 || arc.twist_after_rad != 0;
    });
}

std::string rounded(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

Equilibrium refusal(Status status, const std::string& message) {
  Equilibrium result;
  result.status = status;
  result.message = message;
  return result;
}

}  // namespace

std::optional<bool> is_stable(const Problem& problem, const Run& run, const Run* other, Run& spare, Run& another_spare,
                              int arcs_at_most) {
  if (!scene::is_conservative(problem.spans())) return std::nullopt;
  return run.engine.visit([&](const auto& solver) {
    return judged(solver, problem, run, other, {&spare, &another_spare}, arcs_at_most);
  });
}

Equilibrium success(const Problem& problem, const Run& run, double error_mm, std::optional<bool> stable,
                    const std::string& how) {
  const Choice& choice = problem.choice();
  const std::span<const Span> spans = problem.scene_spans();
  Equilibrium result;
  result.status = Status::converged;
  result.error_estimate_mm = error_mm;
  result.stable = stable;
  result.model = {{"law", std::string(name(choice.law))},
                  {"arcs", run.arc_count()},
                  {"planar", scene::plane_direction(spans).has_value()},
                  {"torsion", run.engine.visit([](const auto& s) { return has_torsion(s.solved()); })},
                  {"shear", choice.rod.model == RodModel::reissner},
                  {"solver", std::string(choice.march ? "march" : "boundary value")},
                  {"kernel", std::string(choice.plane ? "planar" : "spatial")},
                  {"reason", reason(choice) + "; " + how}};
  run.engine.visit([&](const auto& solver) {
    set_shape(result, problem.scene(), problem.spans(), solver.solved(), choice.rotation_BP);
    if (choice.round && result.converged()) twist_sections(result, spans);
    if (result.converged()) report(solver, result);
  });
  if (!result.converged()) result.stable.reset();
  result.tip_angle_rad = result.converged() ? scene::tip_angle_rad(result.stations, scene::plane_normal(spans)) : 0;
  return result;
}

Equilibrium failure(const Run& run) {
  return refusal(run.status, run.engine.failure_message(run.status));
}

Equilibrium too_long_for_series(const ArcExtent& extent) {
  return refusal(
      Status::arc_not_converged,
      "the series of an arc does not reach its end: it grows by sqrt(force / EI) h = " + rounded(extent.load_length) +
          " (largest: " + rounded(longest_load_length) + ") and turns or swings by " + rounded(extent.swing_rad) +
          " rad (largest: " + rounded(longest_swing_rad) + "); take more arcs, or the law fourth_order");
}

Equilibrium tolerance_not_met(const Problem& problem, const Run& run, double error_mm) {
  return refusal(Status::tolerance_not_met, "estimated error " + rounded(error_mm) + " mm exceeds the tolerance " +
                                                rounded(problem.tolerance_mm()) + " mm with " +
                                                std::to_string(run.arc_count()) + " arcs");
}

}  // namespace fam
