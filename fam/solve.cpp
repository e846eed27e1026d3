#include "fam/solve.h"

#include "fam/embedding.h"
#include "fam/model_choice.h"
#include "fam/reach.h"
#include "fam/shape.h"
#include "fam/stations.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>

namespace fam {
namespace {

using scene::Equilibrium;
using scene::Span;
using scene::Status;

// Why the published law cannot take a load, empty where it can.
std::string beyond_published(const scene::Load& load) {
  if (const auto* force = std::get_if<scene::Force>(&load)) {
    if (force->frame == scene::Frame::fixed) return "a force in a fixed frame";
  } else if (const auto* moment = std::get_if<scene::Moment>(&load)) {
    if (moment->frame == scene::Frame::fixed) return "a moment in a fixed frame";
  } else if (std::holds_alternative<scene::DistributedForce>(load)) {
    return "a distributed force";
  } else if (std::holds_alternative<scene::Gravity>(load)) {
    return "gravity";
  }
  return {};
}

std::string unsupported(const scene::Scene& scene, const std::vector<Span>& spans, const Options& options) {
  if (options.law != Law::published) return {};
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const std::string what = beyond_published(scene.loads[i]);
    if (!what.empty()) return "loads[" + std::to_string(i) + "]: the published law cannot solve " + what;
  }
  if (options.model == RodModel::reissner) return "the published law is a Kirchhoff rod's: no shear, no stretch";
  for (const Span& span : spans) {
    if (span.stiffness.bending_Nmm2[0] != span.stiffness.bending_Nmm2[1]) {
      return "the published law needs sections with one bending stiffness, EI_y = EI_z";
    }
  }
  return {};
}

// What is fixed once the options are read against the scene.
struct Choice {
  Law law;
  RodChoice rod;
  std::optional<PlanarScene> plane;
  std::optional<RoundRod> round;  // of rods in space
  std::string reason;
};

Choice choose(const std::vector<Span>& spans, const Options& options, double tolerance_mm) {
  Choice choice{options.law, {}, {}, {}, {}};
  if (choice.law == Law::automatic) choice.law = Law::sixth_order;
  if (choice.law != Law::published) choice.plane = in_one_plane(spans);
  if (choice.law != Law::published && !choice.plane) choice.round = without_torsion(spans);
  const bool published_rod = options.model == RodModel::automatic && choice.law == Law::published;
  choice.rod =
      choose_rod(spans, published_rod ? RodModel::kirchhoff : options.model, options.arcs == 0 ? tolerance_mm : 0);
  choice.reason =
      (choice.plane ? "planar: all loads and rest curvatures lie in one plane; " : "spatial; ") + choice.rod.reason +
      "; " +
      (options.law == Law::automatic ? "sixth_order: an arc costs no more than a fourth_order one and fewer do"
                                     : "law as asked for") +
      (scene::all_loads_follow(spans) ? "; march: all loads follow the rod"
                                      : "; boundary value: a load is fixed in space");
  return choice;
}

template <int D>
Prepared prepared_in(const std::vector<Span>& spans, const std::vector<int>& arcs, const Choice& choice,
                     const Options& options) {
  if (scene::all_loads_follow(spans))
    return {BasicMarch<D>(spans, arcs, choice.law, choice.rod.model, options.twist_order)};
  // Newton ends a thousandth of the tolerance away, or at round-off where none is given.
  const double newton_tolerance =
      std::clamp(1e-3 * options.tolerance_mm / spans.back().end_mm, tightest_newton_tolerance, 1e-6);
  return {BasicBoundaryValue<D>(spans, arcs, choice.law, choice.rod.model, newton_tolerance)};
}

Prepared prepared(const std::vector<Span>& spans, const std::vector<int>& arcs, const Choice& choice,
                  const Options& options) {
  if (choice.round) return prepared_in<3>(choice.round->spans, arcs, choice, options);
  if (!choice.plane) return prepared_in<3>(spans, arcs, choice, options);
  Prepared result = prepared_in<2>(choice.plane->spans, arcs, choice, options);
  result.rotation_BP = choice.plane->rotation_BP;
  return result;
}

const std::string* message_of(const Prepared& prepared) {
  return std::visit(
      [](const auto& s) -> const std::string* {
        if constexpr (requires { s.message(); }) return &s.message();
        else return nullptr;
      },
      prepared.solver);
}

// A march or a boundary value problem, solved.
struct Run {
  Prepared prepared;
  std::vector<int> arcs;  // of each span
  Status status;

  Run(const std::vector<Span>& spans, std::vector<int> arcs_per_span, const Choice& choice, const Options& options,
      const Run* coarser = nullptr)
      : prepared(fam::prepared(spans, arcs_per_span, choice, options)), arcs(std::move(arcs_per_span)) {
    status = std::visit(
        [&](auto& solver) {
          if constexpr (requires { solver.run_from(solver); }) {
            using Solver = std::decay_t<decltype(solver)>;
            if (coarser && coarser->status == Status::converged) {
              return solver.run_from(std::get<Solver>(coarser->prepared.solver));
            }
          } else {
            solver.keep_wrenches();
          }
          return solver.run();
        },
        prepared.solver);
  }

  int arc_count() const {
    return std::visit([](const auto& s) { return s.arc_count(); }, prepared.solver);
  }
  bool marched() const { return message_of(prepared) == nullptr; }
};

std::vector<int> times(std::vector<int> arcs, int factor) {
  for (int& count : arcs) count *= factor;
  return arcs;
}

double order(Law law) {
  return law == Law::sixth_order ? 6 : law == Law::fourth_order ? 4 : law == Law::midpoint ? 2 : 1;
}

// How far two solved rods are apart, at the ends and the middles of the first one's arcs.
struct Distance {
  double position_mm = 0;
  double rotation_rad = 0;  // where follower loads act, which turn with the section: their directions
};

template <int D>
bool is_loaded(const BasicWrench<double, D>& load) {
  return !load.force_N.isZero(0) || !load.moment_Nmm.isZero(0);
}

template <int D>
Distance distance(const SolvedRod<D>& a, const SolvedRod<D>& b) {
  Distance largest;
  for (std::size_t i = 0; i < a.spans.size(); ++i) {
    const SpanArcs<D>&span = a.spans[i], &other = b.spans[i];
    const int count = span.end_arc - span.first_arc, other_count = other.end_arc - other.first_arc;
    for (int half = 1; half <= 2 * count; ++half) {
      const int arc = (half - 1) / 2;
      const double fraction = half / 2. - arc, there = half / 2. * other_count / count;
      const int other_arc = std::min(other_count - 1, static_cast<int>(there));
      const BasicPose<D> here = pose_in_arc(a, span, span.first_arc + arc, fraction);
      const BasicPose<D> pose = pose_in_arc(b, other, other.first_arc + other_arc, there - other_arc);
      largest.position_mm = std::max(largest.position_mm, (here.position_B_mm - pose.position_B_mm).norm());
      const bool loaded = !span.follower_force_S_N.isZero(0) || (half == 2 * count && is_loaded(span.follower_load_S));
      if (loaded) {
        largest.rotation_rad =
            std::max(largest.rotation_rad, (here.rotation_BS - pose.rotation_BS).norm() / std::numbers::sqrt2);
      }
    }
  }
  return largest;
}

Distance distance(const Run& a, const Run& b) {
  return std::visit(
      [&](const auto& solver) {
        return distance(solver.solved(), std::get<std::decay_t<decltype(solver)>>(b.prepared.solver).solved());
      },
      a.prepared.solver);
}

double round_off_mm(const std::vector<Span>& spans, const Run& run) {
  return 4 * std::numeric_limits<double>::epsilon() * spans.back().end_mm * std::sqrt(run.arc_count());
}

Equilibrium failure(const Run& run) {
  Equilibrium result;
  result.status = run.status;
  const std::string arcs = std::to_string(run.arc_count());
  if (const std::string* message = message_of(run.prepared)) {
    result.message = *message + ", with " + arcs + " arcs";
  } else if (run.status == Status::arc_not_converged) {
    result.message = "the bending angle of arc " + std::to_string(std::get<March>(run.prepared.solver).failed_arc()) +
                     " of " + arcs + " (from the clamp) was not found; more arcs make each one easier";
  } else if (run.status == Status::tendon_collapsed) {
    result.message = "a tendon's path has no length somewhere: |v + u x r| = 0, with " + arcs + " arcs";
  } else {
    result.message = "a pose or wrench overflowed with " + arcs + " arcs";
  }
  return result;
}

std::string rounded(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

Equilibrium too_long_for_series(double growth, double reach_rad) {
  Equilibrium result;
  result.status = Status::arc_not_converged;
  result.message = "the series of an arc does not reach its end: it grows by sqrt(force / EI) h = " + rounded(growth) +
                   " (largest: " + rounded(resolved_growth) + ") and turns or swings by " + rounded(reach_rad) +
                   " rad (largest: " + rounded(resolved_reach_rad) + "); take more arcs, or the law fourth_order";
  return result;
}

// What a solve was asked for and how.
struct Task {
  const scene::Scene& scene;
  const std::vector<Span>& scene_spans;
  const std::vector<Span>& spans;  // as they are solved
  const Options& options;
  Choice choice;
  double tolerance_mm;
};

// The sign of the energy's second variation, from the run and finer ones until two agree.
template <int D>
std::optional<bool> stable(const BasicBoundaryValue<D>& solver, const Task& task, const Run& run) {
  if (solver.one_equilibrium()) return true;
  Stability coarse = solver.stability();
  const Run* last = &run;
  std::optional<Run> fine;
  for (int doublings = 0; doublings < most_stability_doublings; ++doublings) {
    Run next(task.spans, times(last->arcs, 2), task.choice, task.options, last);
    if (next.status != Status::converged) return std::nullopt;
    const Stability finer = std::get<BasicBoundaryValue<D>>(next.prepared.solver).stability();
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
void twist_sections(Equilibrium& result, const std::vector<Span>& spans, const RoundRod& rod) {
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

Equilibrium success(const Task& task, const Run& run, double error_mm, const std::string& reason) {
  Equilibrium result;
  result.status = Status::converged;
  result.error_estimate_mm = error_mm;
  const std::vector<Arc> solved = arcs_of(run.prepared);
  const bool torsion = std::any_of(solved.begin(), solved.end(), [](const Arc& arc) {
    return arc.screw.rotation[0] != 0 || arc.twist_before_rad != 0 || arc.twist_after_rad != 0;
  });
  result.model = {{"law", std::string(name(task.choice.law))},
                  {"arcs", run.arc_count()},
                  {"planar", scene::plane_direction(task.scene_spans).has_value()},
                  {"torsion", torsion},
                  {"shear", task.choice.rod.model == RodModel::reissner},
                  {"solver", std::string(run.marched() ? "march" : "boundary value")},
                  {"kernel", std::string(task.choice.plane ? "planar" : "spatial")},
                  {"reason", task.choice.reason + "; " + reason}};
  std::visit(
      [&](const auto& solver) {
        set_shape(result, task.scene, task.spans, solver.solved(), run.prepared.rotation_BP);
        if (task.choice.round && result.converged()) twist_sections(result, task.scene_spans, *task.choice.round);
        if (result.converged()) report(solver, task, run, result);
      },
      run.prepared.solver);
  result.tip_angle_rad =
      result.converged() ? scene::tip_angle_rad(result.stations, scene::plane_normal(task.scene_spans)) : 0;
  return result;
}

double reach_rad(const Task& task, const Run& run) {
  return largest_reach_rad(task.spans, run.arcs, arcs_of(run.prepared), task.choice.plane.has_value());
}

Equilibrium solve_fixed(const Task& task) {
  const Run run(task.spans, scene::cells_per_span(task.spans, task.options.arcs), task.choice, task.options);
  if (run.status != Status::converged) return failure(run);
  const double growth = largest_growth(task.spans, run.arcs);
  const double reach = reach_rad(task, run);
  const bool resolved = growth <= resolved_growth && reach <= resolved_reach_rad;
  if (!resolved && task.choice.law == Law::sixth_order) return too_long_for_series(growth, reach);
  double error = 0;
  if (task.options.estimate_error) {
    const Run twice(task.spans, times(run.arcs, 2), task.choice, task.options, &run);
    const double factor = std::pow(2, order(task.choice.law));
    error = twice.status == Status::converged
                ? factor / (factor - 1) * distance(run, twice).position_mm + round_off_mm(task.spans, run)
                : std::numeric_limits<double>::infinity();
    if (!resolved) error = std::max(error, task.spans.back().end_mm);
  }
  return success(task, run, error + task.choice.rod.left_out_mm, "number of arcs given");
}

// The answer with more arcs, from that with fewer. Where that one is far off, or its arcs are too long to lead there,
// the loads grow from nothing once more: it may lie on another branch.
Run refined(const Task& task, const std::vector<int>& arcs, const Run& coarse) {
  const auto afresh = [&] { return Run(task.spans, arcs, task.choice, task.options); };
  if (coarse.marched() || coarse.status != Status::converged) return afresh();
  if (reach_rad(task, coarse) > leading_reach_rad) return afresh();
  Run fine(task.spans, arcs, task.choice, task.options, &coarse);
  const bool near = fine.status == Status::converged &&
                    distance(coarse, fine).position_mm <= leading_distance * task.spans.back().end_mm;
  return near ? std::move(fine) : afresh();
}

// Whether arcs twice as many cannot help: two runs failed at the same load, or the work is used up.
bool is_the_end(const Run& last, const Run& run) {
  if (run.status == Status::tendon_collapsed && last.status == Status::tendon_collapsed && run.marched()) return true;
  if (run.status == Status::work_limit && run.arc_count() > most_arcs_marched / most_newton_steps) return true;
  if (last.status == Status::converged || last.marched()) return false;
  const auto factor = [](const Run& r) {
    return std::visit(
        [](const auto& s) {
          if constexpr (requires { s.load_factor(); }) return s.load_factor();
          else return 0.0;
        },
        r.prepared.solver);
  };
  return std::abs(factor(run) - factor(last)) <= same_load * factor(run);
}

// Runs with growing multiples of the first arcs, each compared with the one before along the whole rod.
Equilibrium solve_to_tolerance(const Task& task) {
  const double p = order(task.choice.law);
  const double length_mm = task.spans.back().end_mm;
  const std::vector<int> first = first_arcs(task.spans, task.choice.plane.has_value());
  int count = 0;
  for (const int arcs : first) count += arcs;
  int multiple = 1;
  std::optional<Run> coarse(std::in_place, task.spans, first, task.choice, task.options);
  double error = std::numeric_limits<double>::infinity();
  double needed = error;  // what must meet the tolerance: the error, and that of follower loads' directions over L
  double last_mm = std::numeric_limits<double>::quiet_NaN();  // distance of the last two runs but one
  int next = 2;
  while (static_cast<double>(next) * count <= max_arcs) {
    Run fine = refined(task, times(first, next), *coarse);
    const double ratio = static_cast<double>(next) / multiple;
    int after = 2 * next;
    if (fine.status != Status::converged && is_the_end(*coarse, fine)) return failure(fine);
    if (coarse->status == Status::converged && fine.status == Status::converged) {
      const Distance d = distance(*coarse, fine);
      const double d_mm = std::max(d.position_mm, d.rotation_rad * length_mm);
      const auto meets = [&](const Run& run, double factor) {
        const double rest_mm = round_off_mm(task.spans, run) + task.choice.rod.left_out_mm;
        error = factor * d.position_mm + rest_mm;
        if (reach_rad(task, run) > resolved_reach_rad) error = std::max(error, length_mm);
        needed = std::max(error, factor * d_mm + rest_mm);
        return needed <= task.tolerance_mm;
      };
      const std::string reason = "fewest arcs found whose estimate meets the tolerance";
      if (meets(*coarse, coarse_safety)) return success(task, *coarse, error, reason);
      const double least = std::isnan(last_mm) ? unconfirmed : d_mm > contraction * last_mm ? 1 : 0;
      if (meets(fine, std::max(least, fine_safety / (std::pow(ratio, p - 1) - 1) + distrust * d_mm / length_mm))) {
        return success(task, fine, error, reason);
      }
      last_mm = d_mm;
      const double growth = 1.05 * std::pow(needed / task.tolerance_mm, 1 / p);
      after = static_cast<int>(std::clamp(std::ceil(growth * next), 1.3 * next, 4.0 * next));
      after = std::max(after, next + 1);
    }
    multiple = next;
    next = after;
    coarse.emplace(std::move(fine));
  }
  if (coarse->status != Status::converged) return failure(*coarse);
  Equilibrium result;
  result.status = Status::tolerance_not_met;
  result.message = "estimated error " + rounded(error) + " mm exceeds the tolerance " + rounded(task.tolerance_mm) +
                   " mm with " + std::to_string(coarse->arc_count()) + " arcs";
  return result;
}

}  // namespace

const char* name(Law law) {
  switch (law) {
    case Law::automatic: return "auto";
    case Law::published: return "published";
    case Law::midpoint: return "midpoint";
    case Law::fourth_order: return "fourth_order";
    case Law::sixth_order: return "sixth_order";
  }
  return "unknown";
}

Status run_prepared(Prepared& prepared) {
  return std::visit([](auto& solver) { return solver.run(); }, prepared.solver);
}

std::optional<Prepared> prepare(const scene::Scene& scene, const Options& options, std::string& reason) {
  const std::vector<Span> spans = scene::spans_of(scene);
  reason = unsupported(scene, spans, options);
  if (!reason.empty()) return std::nullopt;
  return prepared(spans, scene::cells_per_span(spans, options.arcs), choose(spans, options, options.tolerance_mm),
                  options);
}

std::vector<Arc> arcs_of(const Prepared& prepared) {
  const Matrix3d& rotation = prepared.rotation_BP;
  std::vector<Arc> result;
  std::visit(
      [&](const auto& solver) {
        result.reserve(solver.arcs().size());
        for (const auto& arc : solver.arcs()) {
          result.push_back(
              {{rotation * embedded_turn(arc.screw.rotation), rotation * embedded(arc.screw.translation_mm)},
               arc.twist_before_rad,
               arc.twist_after_rad});
        }
      },
      prepared.solver);
  return result;
}

std::vector<SectionPose> poses_of(const Prepared& prepared) {
  std::vector<SectionPose> result;
  std::visit(
      [&](const auto& solver) {
        result.reserve(solver.poses().size());
        for (const auto& pose : solver.poses()) result.push_back(in_base(pose, prepared.rotation_BP));
      },
      prepared.solver);
  return result;
}

Equilibrium solve(const scene::Scene& scene, const Options& options) {
  const std::vector<Span> spans = scene::spans_of(scene);
  const std::string why_not = unsupported(scene, spans, options);
  if (!why_not.empty()) {
    Equilibrium result;
    result.status = Status::unsupported;
    result.message = why_not;
    return result;
  }
  const double tolerance_mm = options.tolerance_mm > 0 ? options.tolerance_mm : 1e-3 * spans.back().end_mm;
  const Choice choice = choose(spans, options, tolerance_mm);
  const Task task{scene, spans, choice.round ? choice.round->spans : spans, options, choice, tolerance_mm};
  return options.arcs > 0 ? solve_fixed(task) : solve_to_tolerance(task);
}

}  // namespace fam
