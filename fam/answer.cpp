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

using scene::Equilibrium;
using scene::Span;
using scene::Status;

// The sign of the energy's second variation, from the run and finer ones until two agree.
template <int D>
std::optional<bool> stable(const BasicBoundaryValue<D>& solver, const Task& task, const Run& run) {
  if (solver.one_equilibrium()) return true;
  Stability coarse = solver.stability();
  const Run* last = &run;
  std::optional<Run> fine;
  for (int doublings = 0; doublings < most_stability_doublings; ++doublings) {
    Run next(task, times(last->arcs, 2), last);
    if (next.status != Status::converged) return std::nullopt;
    const Stability finer = std::get<BasicBoundaryValue<D>>(next.solver).stability();
    if (agree(coarse, finer)) return finer.conjugate_points == 0;
    coarse = finer;
    fine.emplace(std::move(next));
    last = &*fine;
  }
  return std::nullopt;
}

// What the boundary value solver did, and whether its equilibrium is stable.
template <int D>
void report(const BasicBoundaryValue<D>& solver, const Task& task, const Run& run, Equilibrium& result) {
  result.model.emplace_back("segments", solver.segment_count());
  result.model.emplace_back("load_steps", solver.load_steps());
  result.model.emplace_back("newton_iterations", solver.newton_steps());
  if (scene::is_conservative(task.spans)) result.stable = stable(solver, task, run);
}
// No loads, or tendons alone: the energy is convex in the strains, and no load does work.
template <int D>
void report(const BasicMarch<D>&, const Task& task, const Run&, Equilibrium& result) {
  if (scene::is_conservative(task.spans)) result.stable = true;
}

// Turns each section about its tangent by what GJ adds to the rod that was solved: the moment about the tangent is
// constant along a span.
void twist_sections(Equilibrium& result, std::span<const Span> spans, const RoundRod& rod) {
  double twist_rad = 0;
  std::size_t i = 0;
  for (std::size_t k = 1; k < result.stations.size(); ++k) {
    scene::Station& station = result.stations[k];
    const double last_mm = result.stations[k - 1].s_mm;
    if (last_mm >= spans[i].end_mm) ++i;
    const double moment_Nmm = station.moment_B_Nmm.dot(station.X_BS.rotation_BS.col(0));
    twist_rad += rod.twist_per_Nmm2[i] * moment_Nmm * (station.s_mm - last_mm);
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

Equilibrium success(const Task& task, const Run& run, double error_mm, const std::string& reason) {
  const Choice& choice = task.choice;
  Equilibrium result;
  result.status = Status::converged;
  result.error_estimate_mm = error_mm;
  result.model = {{"law", std::string(name(choice.law))},
                  {"arcs", run.arc_count()},
                  {"planar", scene::plane_direction(task.scene_spans).has_value()},
                  {"torsion", std::visit([](const auto& s) { return has_torsion(s.solved()); }, run.solver)},
                  {"shear", choice.rod.model == RodModel::reissner},
                  {"solver", std::string(choice.march ? "march" : "boundary value")},
                  {"kernel", std::string(choice.plane ? "planar" : "spatial")},
                  {"reason", choice.reason + "; " + reason}};
  std::visit(
      [&](const auto& solver) {
        set_shape(result, task.scene, task.spans, solver.solved(), choice.rotation_BP());
        if (choice.round && result.converged()) twist_sections(result, task.scene_spans, *choice.round);
        if (result.converged()) report(solver, task, run, result);
      },
      run.solver);
  result.tip_angle_rad =
      result.converged() ? scene::tip_angle_rad(result.stations, scene::plane_normal(task.scene_spans)) : 0;
  return result;
}

Equilibrium failure(const Run& run) {
  return refusal(run.status, failure_message(run.solver, run.status));
}

Equilibrium too_long_for_series(const ArcExtent& extent) {
  return refusal(
      Status::arc_not_converged,
      "the series of an arc does not reach its end: it grows by sqrt(force / EI) h = " + rounded(extent.load_length) +
          " (largest: " + rounded(longest_load_length) + ") and turns or swings by " + rounded(extent.swing_rad) +
          " rad (largest: " + rounded(longest_swing_rad) + "); take more arcs, or the law fourth_order");
}

Equilibrium tolerance_not_met(const Task& task, const Run& run, double error_mm) {
  return refusal(Status::tolerance_not_met, "estimated error " + rounded(error_mm) + " mm exceeds the tolerance " +
                                                rounded(task.tolerance_mm) + " mm with " +
                                                std::to_string(run.arc_count()) + " arcs");
}

}  // namespace fam
