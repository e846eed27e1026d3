#include "fam/answer.h"

#include "fam/embedding.h"
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

// The sign of the energy's second variation, from the run and the other or finer ones, until two agree: where one has
// less than twice the other's arcs, the more closely.
template <int D>
std::optional<bool> judged(const BasicBoundaryValue<D>& solver, const Problem& problem, const Run& run,
                           const Run* other, std::array<Run*, 2> spare, int arcs_at_most) {
  if (solver.is_surely_stable()) return true;
  Stability coarse = solver.stability();
  if (other && other->converged()) {
    const auto [fewer, more] = std::minmax({run.arc_count(), other->arc_count()});
    const double times = std::min(2.0, static_cast<double>(more) / fewer);
    if (agree(coarse, stability_of(*other), times - 1)) return coarse.conjugate_points == 0;
  }
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

template <int D>
bool has_torsion(const SolvedRod<D>& rod) {
  if constexpr (D == 2) return false;
  else
    return std::any_of(rod.arcs.begin(), rod.arcs.end(), [](const Arc& arc) {
      return arc.screw.rotation[0] != 0 || arc.twist_before_rad != 0 || arc.twist_after_rad != 0;
    });
}

Equilibrium refusal(Status status, const std::string& message) {
  Equilibrium result;
  result.status = status;
  result.message = message;
  return result;
}

// The sum of the arcs' turns about the normal of the plane that a rod lies in: full turns count.
template <int D>
double turn_rad(const SolvedRod<D>& rod, const Matrix3d& rotation_BP, const Vector3d& normal_B) {
  const Vector3d normal_P = rotation_BP.transpose() * normal_B;
  double turn = 0;
  for (const BasicArc<D>& arc : rod.arcs) turn += embedded_angular(arc.screw.rotation).dot(normal_P);
  return std::abs(turn);
}

// Clamp and tip alone.
std::vector<scene::Station> ends(const Problem& problem, const Solution& solution) {
  const auto station = [&](double s_mm, const Place& place) -> scene::Station {
    const scene::Wrench own_B = solution.own_wrench_B(place);
    return {s_mm, solution.pose(place), own_B.force_N, own_B.moment_Nmm};
  };
  return {station(0, {0, 0}), station(problem.length_mm(), {solution.arc_count() - 1, 1})};
}

// As Equilibrium has it.
double tip_angle_rad(const Problem& problem, const Run& run, const std::vector<scene::Station>& stations) {
  const Matrix3d& rotation_BP = problem.choice().rotation_BP;
  const std::optional<Vector3d> normal_B =
      problem.choice().plane ? Vector3d(rotation_BP.col(2)) : scene::plane_normal(problem.scene_spans());
  if (!normal_B) return scene::tip_angle_rad(stations, std::nullopt);
  return run.engine.visit([&](const auto& solver) { return turn_rad(solver.solved(), rotation_BP, *normal_B); });
}

std::string rounded(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
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
                    const char* how, Solution& solution) {
  const Choice& choice = problem.choice();
  const std::span<const Span> spans = problem.scene_spans();
  if (run.engine.visit([](const auto& solver) { return any_tendon_collapsed(solver.solved()); })) {
    return refusal(Status::tendon_collapsed, "a tendon's path has no length somewhere: |v + u x r| = 0");
  }
  Equilibrium result;
  result.status = Status::converged;
  result.error_estimate_mm = error_mm;
  result.stable = stable;
  solution.set(problem, run);
  if (!problem.options().whole_rod) {
    result.stations = ends(problem, solution);
    result.tip_angle_rad = tip_angle_rad(problem, run, result.stations);
    return result;
  }
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
    report(solver, result);
  });
  if (choice.round) {
    for (scene::Station& at : result.stations) {
      const double twist_rad = solution.twist_rad(solution.place_at(at.s_mm));
      at.X_BS.rotation_BS *= Eigen::AngleAxisd(twist_rad, Vector3d::UnitX()).toRotationMatrix();
    }
  }
  result.tip_angle_rad = tip_angle_rad(problem, run, result.stations);
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
