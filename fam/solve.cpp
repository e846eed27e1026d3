#include "fam/solve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fam {
namespace {

using scene::Equilibrium;
using scene::Span;
using scene::Status;

// Why the march cannot take a load, empty where it can.
std::string unsupported_load(const scene::Load& load) {
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
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const std::string what = unsupported_load(scene.loads[i]);
    if (!what.empty()) return "loads[" + std::to_string(i) + "]: the finite arc method cannot solve " + what + " yet";
  }
  if (options.law != Law::published) return {};
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
    force += span->follower_load_S.force_N.norm();
    double compliance = 0;
    if (span->stiffness.axial_N) compliance = 1 / *span->stiffness.axial_N;
    if (span->stiffness.shear_N) compliance = std::max(compliance, 1 / span->stiffness.shear_N->minCoeff());
    bound += span->length_mm() * compliance * (force + span->tendon_S.force_N.norm());
  }
  return 3 * bound;
}

// True where all bending is about one axis of the section, y or z, and nothing twists.
bool is_planar(const std::vector<Span>& spans) {
  const auto about = [&](int axis) {  // 2: the x-y plane, 1: the x-z plane
    const int other = 3 - axis;
    return std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
      const auto& load = span.follower_load_S;
      return load.force_N[axis] == 0 && load.moment_Nmm[0] == 0 && load.moment_Nmm[other] == 0 &&
             span.rest_curvature_per_mm[0] == 0 && span.rest_curvature_per_mm[other] == 0 &&
             span.tendon_S.moment_Nmm[other] == 0;
    });
  };
  return about(2) || about(1);
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

// One march with its status.
struct Run {
  March march;
  Status status;

  Run(const std::vector<Span>& spans, const std::vector<int>& arcs, const Choice& choice, TwistOrder order)
      : march(spans, arcs, choice.law, choice.model, order), status(march.run()) {}
};

std::vector<int> doubled(std::vector<int> arcs) {
  for (int& count : arcs) count *= 2;
  return arcs;
}

double order_factor(Law law) {
  return law == Law::fourth_order ? 16 : law == Law::midpoint ? 4 : 2;
}  // 2^p

// Largest distance between the arc ends that two marches share.
double distance_mm(const March& coarse, const March& fine) {
  double largest = 0;
  for (std::size_t k = 0; k < coarse.poses().size(); ++k) {
    largest = std::max(largest, (coarse.poses()[k].position_B_mm - fine.poses()[2 * k].position_B_mm).norm());
  }
  return largest;
}

double round_off_mm(const March& march) {
  return 4 * std::numeric_limits<double>::epsilon() * march.end_mm(march.arc_count()) * std::sqrt(march.arc_count());
}

// Stations at the arc ends and, for pictures and for counting turns, between them: at least 40 intervals along the
// rod and none that turns by more than half a radian.
std::vector<scene::Station> stations_of(const March& march) {
  constexpr int fewest_intervals = 40;
  constexpr double largest_turn_rad = 0.5;
  const int arcs = march.arc_count();
  std::vector<scene::Station> stations{{}};
  for (int k = 0; k < arcs; ++k) {
    const Arc& arc = march.arcs()[static_cast<std::size_t>(k)];
    const SectionPose& proximal = march.poses()[static_cast<std::size_t>(k)];
    const double start = march.end_mm(k);
    const double end = march.end_mm(k + 1);
    const double turn = arc.screw.rotation.norm() + std::abs(arc.twist_before_rad) + std::abs(arc.twist_after_rad);
    const int for_turn = static_cast<int>(std::min(1e4, std::ceil(turn / largest_turn_rad)));
    const int pieces = std::max({1, (fewest_intervals + arcs - 1) / arcs, for_turn});
    for (int i = 1; i < pieces; ++i) {
      const double fraction = static_cast<double>(i) / pieces;
      const SectionPose pose = pose_on(arc, proximal, fraction);
      stations.push_back({start + fraction * (end - start), {pose.rotation_BS, pose.position_B_mm}});
    }
    const SectionPose& distal = march.poses()[static_cast<std::size_t>(k) + 1];
    stations.push_back({end, {distal.rotation_BS, distal.position_B_mm}});
  }
  return stations;
}

Equilibrium failure(const Run& run) {
  Equilibrium result;
  result.status = run.status;
  const int arcs = run.march.arc_count();
  result.message = run.status == Status::arc_not_converged
                       ? "the bending angle of arc " + std::to_string(run.march.failed_arc()) + " of " +
                             std::to_string(arcs) + " (from the clamp) was not found; more arcs make each one easier"
                       : "a pose or wrench overflowed with " + std::to_string(arcs) + " arcs";
  return result;
}

Equilibrium success(const March& march, double error_mm) {
  Equilibrium result;
  result.status = Status::converged;
  result.stations = stations_of(march);
  result.tip_angle_rad = scene::total_angle_rad(result.stations);
  result.base_force_B_N = march.base_wrench().force_N;
  result.base_moment_B_Nmm = march.base_wrench().moment_Nmm;
  result.error_estimate_mm = error_mm;
  return result;
}

void describe(Equilibrium& result, const March& march, const std::vector<Span>& spans, const Choice& choice,
              const std::string& reason) {
  const bool torsion = std::any_of(march.arcs().begin(), march.arcs().end(), [](const Arc& arc) {
    return arc.screw.rotation[0] != 0 || arc.twist_before_rad != 0 || arc.twist_after_rad != 0;
  });
  result.model = {{"law", std::string(name(choice.law))},
                  {"arcs", march.arc_count()},
                  {"planar", is_planar(spans)},
                  {"torsion", torsion},
                  {"shear", choice.model == RodModel::reissner},
                  {"solver", std::string("march")},
                  {"reason", choice.reason + "; " + reason}};
}

Equilibrium solve_fixed(const std::vector<Span>& spans, const Options& options, const Choice& choice) {
  const std::vector<int> arcs = scene::cells_per_span(spans, options.arcs);
  const Run run(spans, arcs, choice, options.twist_order);
  if (run.status != Status::converged) return failure(run);
  double error = 0;
  if (options.estimate_error) {
    const Run twice(spans, doubled(arcs), choice, options.twist_order);
    const double factor = order_factor(choice.law);
    error = twice.status == Status::converged
                ? factor / (factor - 1) * distance_mm(run.march, twice.march) + round_off_mm(run.march)
                : std::numeric_limits<double>::infinity();
  }
  Equilibrium result = success(run.march, error + choice.left_out_mm);
  describe(result, run.march, spans, choice, "number of arcs given");
  return result;
}

// Doubles the arcs until N or 2N arcs meet the tolerance by the difference between them.
Equilibrium solve_to_tolerance(const std::vector<Span>& spans, const Options& options, const Choice& choice,
                               double tolerance_mm) {
  const double factor = order_factor(choice.law);
  std::vector<int> arcs(spans.size(), 1);
  Run coarse(spans, arcs, choice, options.twist_order);
  double error = std::numeric_limits<double>::infinity();
  while (2 * coarse.march.arc_count() <= max_arcs) {
    arcs = doubled(arcs);
    Run fine(spans, arcs, choice, options.twist_order);
    if (coarse.status == Status::converged && fine.status == Status::converged) {
      const double difference = distance_mm(coarse.march, fine.march);
      const auto accept = [&](const March& march, double estimate) {
        error = estimate + round_off_mm(march) + choice.left_out_mm;
        return error <= tolerance_mm;
      };
      for (const auto& [run, estimate] :
           {std::pair{&coarse, factor / (factor - 1) * difference}, std::pair{&fine, 2 / (factor - 1) * difference}}) {
        if (!accept(run->march, estimate)) continue;
        Equilibrium result = success(run->march, error);
        describe(result, run->march, spans, choice, "arcs doubled until the estimate met the tolerance");
        return result;
      }
    }
    coarse = std::move(fine);
  }
  if (coarse.status != Status::converged) return failure(coarse);
  Equilibrium result;
  result.status = Status::tolerance_not_met;
  result.message = "estimated tip error " + std::to_string(error) + " mm exceeds the tolerance " +
                   std::to_string(tolerance_mm) + " mm with " + std::to_string(coarse.march.arc_count()) + " arcs";
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

std::optional<March> prepare(const scene::Scene& scene, const Options& options, std::string& reason) {
  const std::vector<Span> spans = scene::spans_of(scene);
  reason = unsupported(scene, spans, options);
  if (!reason.empty()) return std::nullopt;
  const Choice choice = choose(spans, options, options.tolerance_mm);
  return March(spans, scene::cells_per_span(spans, options.arcs), choice.law, choice.model, options.twist_order);
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
  const double tolerance = options.tolerance_mm > 0 ? options.tolerance_mm : 1e-3 * spans.back().end_mm;
  const Choice choice = choose(spans, options, tolerance);
  return options.arcs > 0 ? solve_fixed(spans, options, choice) : solve_to_tolerance(spans, options, choice, tolerance);
}

}  // namespace fam
