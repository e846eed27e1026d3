#include "fam/tolerance.h"

#include "fam/answer.h"
#include "fam/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace fam {
namespace {

using scene::Equilibrium;
using scene::Span;
using scene::Status;

template <int D>
Status run_solver(BasicMarch<D>& march, const Engine*) {
  march.keep_wrenches();
  return march.run();
}
template <int D>
Status run_solver(BasicBoundaryValue<D>& problem, const Engine* fewer_arcs) {
  return fewer_arcs ? problem.run_from(std::get<BasicBoundaryValue<D>>(*fewer_arcs)) : problem.run();
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
        return distance(solver.solved(), std::get<std::decay_t<decltype(solver)>>(b.solver).solved());
      },
      a.solver);
}

double round_off_mm(std::span<const Span> spans, const Run& run) {
  return 4 * std::numeric_limits<double>::epsilon() * spans.back().end_mm * std::sqrt(run.arc_count());
}

ArcExtent extent_of(const Task& task, const Run& run) {
  return extent_of_arcs(run.solver, task.spans, run.arcs);
}

// The answer with more arcs, from that with fewer. Where that one is far off, or its arcs are too long to lead there,
// the loads grow from nothing once more: it may lie on another branch.
Run refined(const Task& task, const std::vector<int>& arcs, const Run& coarse) {
  const auto afresh = [&] { return Run(task, arcs); };
  if (is_march(coarse.solver) || coarse.status != Status::converged) return afresh();
  if (extent_of(task, coarse).swing_rad > leading_swing_rad) return afresh();
  Run fine(task, arcs, &coarse);
  const bool near = fine.status == Status::converged &&
                    distance(coarse, fine).position_mm <= leading_distance * task.spans.back().end_mm;
  return near ? std::move(fine) : afresh();
}

// Whether arcs twice as many cannot help: two runs failed at the same load, or the work is used up.
bool is_the_end(const Run& last, const Run& run) {
  const bool march = is_march(run.solver);
  if (run.status == Status::tendon_collapsed && last.status == Status::tendon_collapsed && march) return true;
  if (run.status == Status::work_limit && run.arc_count() > most_arcs_marched / most_newton_steps) return true;
  if (last.status == Status::converged || march) return false;
  const double reached = load_factor(run.solver);
  return std::abs(reached - load_factor(last.solver)) <= same_load * reached;
}

// The runs of one task, each compared with the one before along the whole rod, and what they say of the error.
class Ladder {
 public:
  explicit Ladder(const Task& task)
      : task_(task), order_(facts_of(task.choice.law).order), length_mm_(task.spans.back().end_mm) {}

  double error_mm() const { return error_mm_; }

  // Which of two runs, the finer with `ratio` times the arcs, meets the tolerance; null if none.
  const Run* sufficient(const Run& coarse, const Run& fine, double ratio) {
    const Distance d = distance(coarse, fine);
    const double d_mm = std::max(d.position_mm, d.rotation_rad * length_mm_);
    if (meets(coarse, coarse_safety, d)) return &coarse;
    const double least = std::isnan(last_mm_) ? unconfirmed : d_mm > contraction * last_mm_ ? 1 : 0;
    const double by_order = fine_safety / (std::pow(ratio, order_ - 1) - 1);
    if (meets(fine, std::max(least, by_order + distrust * d_mm / length_mm_), d)) return &fine;
    last_mm_ = d_mm;
    return nullptr;
  }

  // Times the first arcs, after runs with `multiple` times that did not do.
  int next(int multiple) const {
    const double more = 1.05 * std::pow(needed_mm_ / task_.tolerance_mm, 1.0 / order_);
    const int wanted = static_cast<int>(std::clamp(std::ceil(more * multiple), 1.3 * multiple, 4.0 * multiple));
    return std::max(wanted, multiple + 1);
  }

 private:
  bool meets(const Run& run, double factor, const Distance& d) {
    const double d_mm = std::max(d.position_mm, d.rotation_rad * length_mm_);
    const double rest_mm = round_off_mm(task_.spans, run) + task_.choice.rod.left_out_mm;
    error_mm_ = factor * d.position_mm + rest_mm;
    if (extent_of(task_, run).swing_rad > longest_swing_rad) error_mm_ = std::max(error_mm_, length_mm_);
    needed_mm_ = std::max(error_mm_, factor * d_mm + rest_mm);
    return needed_mm_ <= task_.tolerance_mm;
  }

  const Task& task_;
  const int order_;
  const double length_mm_;
  double error_mm_ = std::numeric_limits<double>::infinity();
  double needed_mm_ = error_mm_;  // what must meet the tolerance: the error, and that of follower loads' directions x L
  double last_mm_ = std::numeric_limits<double>::quiet_NaN();  // distance of the last two runs but one
};

}  // namespace

Run::Run(const Task& task, std::vector<int> arcs_per_span, const Run* fewer_arcs)
    : solver(make_engine(task.spans, arcs_per_span, task.choice, task.options)), arcs(std::move(arcs_per_span)) {
  const Engine* from = fewer_arcs && fewer_arcs->status == Status::converged ? &fewer_arcs->solver : nullptr;
  status = std::visit([&](auto& s) { return run_solver(s, from); }, solver);
}

std::vector<int> times(std::vector<int> arcs, int factor) {
  for (int& count : arcs) count *= factor;
  return arcs;
}

Equilibrium solve_fixed(const Task& task) {
  const Run run(task, scene::cells_per_span(task.spans, task.options.arcs));
  if (run.status != Status::converged) return failure(run);
  const ArcExtent extent = extent_of(task, run);
  if (verdict(run.solver, task.choice.law, extent) == Status::arc_not_converged) return too_long_for_series(extent);
  double error = 0;
  if (task.options.estimate_error) {
    const Run twice(task, times(run.arcs, 2), &run);
    const double factor = std::pow(2, facts_of(task.choice.law).order);
    error = twice.status == Status::converged
                ? factor / (factor - 1) * distance(run, twice).position_mm + round_off_mm(task.spans, run)
                : std::numeric_limits<double>::infinity();
    if (!extent.resolved()) error = std::max(error, task.spans.back().end_mm);
  }
  return success(task, run, error + task.choice.rod.left_out_mm, "number of arcs given");
}

// Runs with growing multiples of the first arcs.
Equilibrium solve_to_tolerance(const Task& task) {
  const std::vector<int> first = first_arcs(task.spans, task.choice.plane.has_value());
  int count = 0;
  for (const int arcs : first) count += arcs;
  Ladder ladder(task);
  int multiple = 1;
  std::optional<Run> coarse(std::in_place, task, first);
  int next = 2;
  while (static_cast<double>(next) * count <= max_arcs) {
    Run fine = refined(task, times(first, next), *coarse);
    const double ratio = static_cast<double>(next) / multiple;
    int after = 2 * next;
    if (fine.status != Status::converged && is_the_end(*coarse, fine)) return failure(fine);
    if (coarse->status == Status::converged && fine.status == Status::converged) {
      if (const Run* run = ladder.sufficient(*coarse, fine, ratio)) {
        return success(task, *run, ladder.error_mm(), "fewest arcs found whose estimate meets the tolerance");
      }
      after = ladder.next(next);
    }
    multiple = next;
    next = after;
    coarse.emplace(std::move(fine));
  }
  if (coarse->status != Status::converged) return failure(*coarse);
  return tolerance_not_met(task, *coarse, ladder.error_mm());
}

}  // namespace fam
