#include "fam/solve.h"

#include "fam/scene_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

bool gives_way(const scene::Stiffness& stiffness) {
  return stiffness.axial_N || stiffness.shear_N;
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

// A bound on the tip's shift by shear and stretch: the strain |K_v^-1 n| summed along the rod, |n| bounded by the
// forces beyond. The shift of the tip by the strains themselves; what they change in the moments is of their order.
double shear_bound_mm(const std::vector<Span>& spans) {
  double bound = 0;
  double force = 0;
  for (auto span = spans.rbegin(); span != spans.rend(); ++span) {
    force += span->follower_load_S.force_N.norm() + span->fixed_load_B.force_N.norm() +
             span->length_mm() * (span->follower_force_S_N_per_mm.norm() + span->fixed_force_B_N_per_mm.norm());
    double compliance = 0;
    if (span->stiffness.axial_N) compliance = 1 / *span->stiffness.axial_N;
    if (span->stiffness.shear_N) compliance = std::max(compliance, 1 / span->stiffness.shear_N->minCoeff());
    bound += span->length_mm() * compliance * (force + span->tendon_S.force_N.norm());
  }
  return 3 * bound;
}

// What is fixed once the options are read against the scene.
struct Choice {
  Law law;
  RodModel model;
  double left_out_mm = 0;  // bound on the effect of shear and stretch where the automatic choice drops them
  std::string reason;
};

Choice choose(const std::vector<Span>& spans, const Options& options, double tolerance_mm) {
  Choice choice{options.law, options.model, 0, "as asked for"};
  if (choice.law == Law::automatic) {
    choice.law = Law::fourth_order;
    choice.reason = "fourth_order: fewest arcs for any tolerance";
  }
  if (choice.model != RodModel::automatic) return choice;
  const bool has_shear = std::any_of(spans.begin(), spans.end(), [](const Span& s) { return gives_way(s.stiffness); });
  const double bound = shear_bound_mm(spans);
  const bool negligible = options.arcs == 0 && bound <= 0.1 * tolerance_mm;
  choice.model = has_shear && !negligible && choice.law != Law::published ? RodModel::reissner : RodModel::kirchhoff;
  if (!has_shear) {
    choice.reason += "; kirchhoff: the sections neither shear nor stretch";
  } else if (choice.model == RodModel::reissner) {
    choice.reason += "; reissner: shear and stretch are given and may matter";
  } else if (choice.law == Law::published) {
    choice.reason += "; kirchhoff: the published law's rod";
  } else {
    choice.left_out_mm = bound;
    choice.reason += "; kirchhoff: shear and stretch move the tip by less than a tenth of the tolerance";
  }
  return choice;
}

// Newton ends a thousandth of the tolerance away, or at round-off where none is given.
Prepared prepared(const std::vector<Span>& spans, const std::vector<int>& arcs, const Choice& choice,
                  const Options& options) {
  if (all_loads_follow(spans)) return March(spans, arcs, choice.law, choice.model, options.twist_order);
  const double newton_tolerance =
      std::clamp(1e-3 * options.tolerance_mm / spans.back().end_mm, tightest_newton_tolerance, 1e-6);
  return BoundaryValue(spans, arcs, choice.law, choice.model, newton_tolerance);
}

// A march or a boundary value problem, solved.
struct Run {
  Prepared solver;
  Status status;

  Run(const std::vector<Span>& spans, const std::vector<int>& arcs, const Choice& choice, const Options& options,
      const Run* half_as_many = nullptr)
      : solver(prepared(spans, arcs, choice, options)) {
    auto* boundary_value = std::get_if<BoundaryValue>(&solver);
    const bool start = boundary_value && half_as_many && half_as_many->status == Status::converged;
    status = start ? boundary_value->run_from(std::get<BoundaryValue>(half_as_many->solver)) : run_prepared(solver);
  }

  const std::vector<Arc>& arcs() const {
    return std::visit([](const auto& s) -> const std::vector<Arc>& { return s.arcs(); }, solver);
  }
  const std::vector<SectionPose>& poses() const {
    return std::visit([](const auto& s) -> const std::vector<SectionPose>& { return s.poses(); }, solver);
  }
  int arc_count() const { return static_cast<int>(arcs().size()); }
};

// Arc lengths of the arc ends, clamp to tip, mm.
std::vector<double> arc_ends_mm(const std::vector<Span>& spans, const std::vector<int>& arcs) {
  std::vector<double> ends{0};
  for (std::size_t i = 0; i < spans.size(); ++i) {
    for (int k = 1; k < arcs[i]; ++k) ends.push_back(spans[i].start_mm + spans[i].length_mm() * k / arcs[i]);
    ends.push_back(spans[i].end_mm);
  }
  return ends;
}

std::vector<int> doubled(std::vector<int> arcs) {
  for (int& count : arcs) count *= 2;
  return arcs;
}

// Arcs to start with: one a span for the march; enough to carry the growth of the boundary value problem.
std::vector<int> first_arcs(const std::vector<Span>& spans) {
  std::vector<int> arcs(spans.size(), 1);
  if (all_loads_follow(spans)) return arcs;
  double force = 0;
  for (std::size_t i = spans.size(); i-- > 0;) {
    const Span& span = spans[i];
    force += span.follower_load_S.force_N.norm() + span.fixed_load_B.force_N.norm() +
             span.length_mm() * (span.follower_force_S_N_per_mm.norm() + span.fixed_force_B_N_per_mm.norm());
    const double growth = span.length_mm() * std::sqrt(force / least_stiffness_Nmm2(span));
    arcs[i] = static_cast<int>(std::clamp(std::ceil(2 * growth), 1.0, 1000.0));
  }
  return arcs;
}

double order_factor(Law law) {
  return law == Law::fourth_order ? 16 : law == Law::midpoint ? 4 : 2;
}  // 2^p

// Largest distance between the arc ends that two marches share.
double distance_mm(const Run& coarse, const Run& fine) {
  double largest = 0;
  for (std::size_t k = 0; k < coarse.poses().size(); ++k) {
    largest = std::max(largest, (coarse.poses()[k].position_B_mm - fine.poses()[2 * k].position_B_mm).norm());
  }
  return largest;
}

double round_off_mm(const std::vector<Span>& spans, const Run& run) {
  return 4 * std::numeric_limits<double>::epsilon() * spans.back().end_mm * std::sqrt(run.arc_count());
}

// Stations at the arc ends and, for pictures and for counting turns, between them: at least 40 intervals along the
// rod and none that turns by more than half a radian.
std::vector<scene::Station> stations_of(const Run& run, const std::vector<double>& ends_mm) {
  constexpr int fewest_intervals = 40;
  constexpr double largest_turn_rad = 0.5;
  const int arcs = run.arc_count();
  std::vector<scene::Station> stations{{}};
  for (std::size_t k = 0; k + 1 < ends_mm.size(); ++k) {
    const Arc& arc = run.arcs()[k];
    const double turn = arc.screw.rotation.norm() + std::abs(arc.twist_before_rad) + std::abs(arc.twist_after_rad);
    const int for_turn = static_cast<int>(std::min(1e4, std::ceil(turn / largest_turn_rad)));
    const int pieces = std::max({1, (fewest_intervals + arcs - 1) / arcs, for_turn});
    for (int i = 1; i < pieces; ++i) {
      const double fraction = static_cast<double>(i) / pieces;
      const SectionPose pose = pose_on(arc, run.poses()[k], fraction);
      stations.push_back(
          {ends_mm[k] + fraction * (ends_mm[k + 1] - ends_mm[k]), {pose.rotation_BS, pose.position_B_mm}});
    }
    const SectionPose& distal = run.poses()[k + 1];
    stations.push_back({ends_mm[k + 1], {distal.rotation_BS, distal.position_B_mm}});
  }
  return stations;
}

Equilibrium failure(const Run& run) {
  Equilibrium result;
  result.status = run.status;
  const std::string arcs = std::to_string(run.arc_count());
  if (const auto* boundary_value = std::get_if<BoundaryValue>(&run.solver)) {
    result.message = boundary_value->message() + ", with " + arcs + " arcs";
  } else if (run.status == Status::arc_not_converged) {
    result.message = "the bending angle of arc " + std::to_string(std::get<March>(run.solver).failed_arc()) + " of " +
                     arcs + " (from the clamp) was not found; more arcs make each one easier";
  } else {
    result.message = "a pose or wrench overflowed with " + arcs + " arcs";
  }
  return result;
}

// What a solve was asked for and how.
struct Task {
  const std::vector<Span>& spans;
  const Options& options;
  Choice choice;
  double tolerance_mm;
};

Equilibrium success(const Task& task, const Run& run, const std::vector<int>& arcs, double error_mm,
                    const std::string& reason) {
  Equilibrium result;
  result.status = Status::converged;
  result.stations = stations_of(run, arc_ends_mm(task.spans, arcs));
  result.tip_angle_rad = scene::total_angle_rad(result.stations);
  const SectionWrench& base =
      std::visit([](const auto& s) -> const SectionWrench& { return s.base_wrench(); }, run.solver);
  result.base_force_B_N = base.force_N;
  result.base_moment_B_Nmm = base.moment_Nmm;
  result.error_estimate_mm = error_mm;
  const bool torsion = std::any_of(run.arcs().begin(), run.arcs().end(), [](const Arc& arc) {
    return arc.screw.rotation[0] != 0 || arc.twist_before_rad != 0 || arc.twist_after_rad != 0;
  });
  const auto* boundary_value = std::get_if<BoundaryValue>(&run.solver);
  result.model = {{"law", std::string(name(task.choice.law))},
                  {"arcs", run.arc_count()},
                  {"planar", is_planar(task.spans)},
                  {"torsion", torsion},
                  {"shear", task.choice.model == RodModel::reissner},
                  {"solver", std::string(boundary_value ? "boundary value" : "march")},
                  {"reason", task.choice.reason + "; " + reason}};
  if (boundary_value) {
    result.model.emplace_back("segments", boundary_value->segment_count());
    result.model.emplace_back("load_steps", boundary_value->load_steps());
    result.model.emplace_back("newton_iterations", boundary_value->newton_steps());
    if (conservative(task.spans)) result.stable = boundary_value->stable();
  }
  return result;
}

Equilibrium solve_fixed(const Task& task) {
  const std::vector<int> arcs = scene::cells_per_span(task.spans, task.options.arcs);
  const Run run(task.spans, arcs, task.choice, task.options);
  if (run.status != Status::converged) return failure(run);
  double error = 0;
  if (task.options.estimate_error) {
    const Run twice(task.spans, doubled(arcs), task.choice, task.options, &run);
    const double factor = order_factor(task.choice.law);
    error = twice.status == Status::converged
                ? factor / (factor - 1) * distance_mm(run, twice) + round_off_mm(task.spans, run)
                : std::numeric_limits<double>::infinity();
  }
  return success(task, run, arcs, error + task.choice.left_out_mm, "number of arcs given");
}

// Doubles the arcs until N or 2N arcs meet the tolerance by the difference between them.
Equilibrium solve_to_tolerance(const Task& task) {
  const double factor = order_factor(task.choice.law);
  std::vector<int> arcs = first_arcs(task.spans);
  std::optional<Run> coarse(std::in_place, task.spans, arcs, task.choice, task.options);
  double error = std::numeric_limits<double>::infinity();
  int failures = coarse->status == Status::converged ? 0 : 1;
  const bool marching = std::holds_alternative<March>(coarse->solver);
  while (2 * coarse->arc_count() <= max_arcs && (marching || failures < 4)) {
    const std::vector<int> twice = doubled(arcs);
    Run fine(task.spans, twice, task.choice, task.options, &*coarse);
    if (fine.status != Status::converged) ++failures;
    if (coarse->status == Status::converged && fine.status == Status::converged) {
      const double difference = distance_mm(*coarse, fine);
      const auto meets = [&](const Run& run, double estimate) {
        error = estimate + round_off_mm(task.spans, run) + task.choice.left_out_mm;
        return error <= task.tolerance_mm;
      };
      const std::string reason = "arcs doubled until the estimate met the tolerance";
      if (meets(*coarse, factor / (factor - 1) * difference)) return success(task, *coarse, arcs, error, reason);
      if (meets(fine, 2 / (factor - 1) * difference)) return success(task, fine, twice, error, reason);
    }
    arcs = twice;
    coarse.emplace(std::move(fine));
  }
  if (coarse->status != Status::converged) return failure(*coarse);
  Equilibrium result;
  result.status = Status::tolerance_not_met;
  result.message = "estimated tip error " + std::to_string(error) + " mm exceeds the tolerance " +
                   std::to_string(task.tolerance_mm) + " mm with " + std::to_string(coarse->arc_count()) + " arcs";
  return result;
}

}  // namespace

const char* name(Law law) {
  switch (law) {
    case Law::automatic: return "auto";
    case Law::published: return "published";
    case Law::midpoint: return "midpoint";
    case Law::fourth_order: return "fourth_order";
  }
  return "unknown";
}

Status run_prepared(Prepared& solver) {
  return std::visit([](auto& s) { return s.run(); }, solver);
}

std::optional<Prepared> prepare(const scene::Scene& scene, const Options& options, std::string& reason) {
  const std::vector<Span> spans = scene::spans_of(scene);
  reason = unsupported(scene, spans, options);
  if (!reason.empty()) return std::nullopt;
  const Choice choice = choose(spans, options, options.tolerance_mm);
  return prepared(spans, scene::cells_per_span(spans, options.arcs), choice, options);
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
  const Task task{spans, options, choose(spans, options, tolerance_mm), tolerance_mm};
  return options.arcs > 0 ? solve_fixed(task) : solve_to_tolerance(task);
}

}  // namespace fam
