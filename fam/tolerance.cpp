#include "fam/tolerance.h"

#include "fam/shape.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace fam {
namespace {

using scene::Span;
using scene::Status;

// How far two solved rods are apart, at the ends of the second one's arcs, which has more; or only where an arc of the
// first ends, too, which takes no place within one.
enum class Where { arc_ends, everywhere };
struct Distance {
  double position_mm = 0;
  double rotation_rad = 0;  // where follower loads act, which turn with the section: their directions
};

template <int D>
bool is_loaded(const BasicWrench<double, D>& load) {
  return !load.force_N.isZero(0) || !load.moment_Nmm.isZero(0);
}

template <int D>
Distance distance(const SolvedRod<D>& fewer, const SolvedRod<D>& more, Where where) {
  Distance largest;
  for (std::size_t i = 0; i < more.spans.size(); ++i) {
    const SpanArcs<D>&span = more.spans[i], &coarse = fewer.spans[i];
    const long long count = span.end_arc - span.first_arc, coarse_count = coarse.end_arc - coarse.first_arc;
    long long k = 1;
    for (int whole = 0; whole < coarse_count; ++whole) {
      ArcInterior<D> arc(fewer, coarse, coarse.first_arc + whole);
      for (; k * coarse_count <= (whole + 1) * count; ++k) {
        if (where == Where::arc_ends && k * coarse_count < (whole + 1) * count) continue;
        const BasicPose<D>& here = more.poses[static_cast<std::size_t>(span.first_arc + k)];
        const BasicPose<D> pose = arc.pose(static_cast<double>(k * coarse_count - whole * count) / count);
        largest.position_mm = std::max(largest.position_mm, (here.position_B_mm - pose.position_B_mm).norm());
        const bool loaded = !span.follower_force_S_N.isZero(0) || (k == count && is_loaded(span.follower_load_S));
        if (!loaded) continue;
        largest.rotation_rad =
            std::max(largest.rotation_rad, (here.rotation_BS - pose.rotation_BS).norm() / std::numbers::sqrt2);
      }
    }
  }
  return largest;
}

Distance distance(const Run& a, const Run& b, Where where = Where::everywhere) {
  return a.engine.visit_with(
      b.engine, [where](const auto& one, const auto& other) { return distance(one.solved(), other.solved(), where); });
}

// Whether an answer leads to a finer one (leading_swing_rad); agrees: with a coarser one.
bool leads(const Problem& problem, const Run& coarse, bool agrees) {
  if (!coarse.converged() || coarse.engine.is_march()) return false;
  return agrees || coarse.engine.has_one_solution() || coarse.engine.way_was_smooth() ||
         coarse.extent(problem).swing_rad <= leading_swing_rad;
}

// The answer with more arcs, from that with fewer if that leads there. Where it does not, or it is far off, the loads
// grow from nothing once more: it may lie on another branch.
void refine(const Problem& problem, std::span<const int> arcs, int factor, const Run& coarse, Run& fine,
            bool coarse_leads) {
  if (coarse_leads) {
    fine.solve(problem, arcs, factor, &coarse);
    if (fine.converged()) return;
  }
  fine.solve(problem, arcs, factor);
}

template <int D>
bool are_apart(const BasicBoundaryValue<D>& fewer, const BasicBoundaryValue<D>& more) {
  const double ratio = std::min(2.0, static_cast<double>(more.arc_count()) / fewer.arc_count());
  return !(fewer.is_surely_stable() && more.is_surely_stable()) &&
         !agree(fewer.stability(), more.stability(), apart_share * (ratio - 1));
}
template <int D>
bool are_apart(const BasicMarch<D>&, const BasicMarch<D>&) {
  return false;
}

// See most_apart.
bool are_apart(const Problem& problem, const Run& fewer, const Run& more) {
  return scene::is_conservative(problem.spans()) &&
         fewer.engine.visit_with(more.engine, [](const auto& a, const auto& b) { return are_apart(a, b); });
}

// In a march so fine a tendon without length is the rod's, not that of arcs too long to see it turn in time. Of 110
// collapsed random scenes that the exact reference has an answer for 9 take up to a thousand arcs to be solved.
constexpr int collapsing_arcs = 4096;

// Whether arcs twice as many cannot help: two runs failed at the same load, or the work is used up.
bool is_the_end(const Run& last, const Run& run) {
  const bool march = run.engine.is_march();
  if (run.status == Status::arc_not_converged) return false;
  if (march && run.status == Status::tendon_collapsed && run.arc_count() > collapsing_arcs) return true;
  if (run.status == Status::work_limit && run.arc_count() > most_arcs_marched / most_newton_steps) return true;
  if (last.converged() || march) return false;
  const double reached = run.engine.load_factor();
  const bool collapsed = last.status == Status::tendon_collapsed && run.status == Status::tendon_collapsed;
  if (collapsed && reached < last.engine.load_factor()) return true;  // arcs that see the peak better collapse sooner
  return std::abs(reached - last.engine.load_factor()) <= same_load * reached;
}

// The runs of one problem, each compared with the one before along the whole rod, and what they say of the error.
class Ladder {
 public:
  explicit Ladder(const Problem& problem) : problem_(problem), order_(facts_of(problem.choice().law).order) {}

  double error_mm() const { return error_mm_; }
  // Of two runs that did not meet the tolerance: whether they lie on one branch.
  bool agree() const { return last_mm_ <= confirming_share * problem_.length_mm(); }

  // Whether a run meets the tolerance by itself: of constant strains, or by what its arcs' series leave out at most.
  bool suffices(const Run& run) {
    if (!run.converged()) return false;
    const Choice& choice = problem_.choice();
    const double left_out_over_L =
        choice.constant_strains ? 0 : series_error_over_L(run.engine, choice.law, problem_.spans(), run.arcs);
    const Distance left_out{left_out_over_L * problem_.length_mm(), left_out_over_L};
    return may_meet(1, left_out) && meets(run, 1, left_out);
  }

  // Which of two runs, the finer with `ratio` times the arcs, meets the tolerance; null if none.
  const Run* sufficient(const Run& coarse, const Run& fine, double ratio) {
    const double by_order = fine_safety / (std::pow(ratio, std::max(order_ - 1.0, 0.5)) - 1);
    const auto factor_of_fine = [&](const Distance& d) {
      const double d_mm = largest_mm(d);
      const double least = std::isnan(last_mm_) ? unconfirmed : d_mm > contraction * last_mm_ ? 1 : 0;
      return std::max(least, by_order + distrust * d_mm / problem_.length_mm());
    };
    Distance d = distance(coarse, fine, Where::arc_ends);
    if (may_meet(coarse_safety, d)) d = distance(coarse, fine);  // its arcs are longer: they may be apart within alone
    if (may_meet(coarse_safety, d) && meets(coarse, coarse_safety, d)) return &coarse;
    if (meets(fine, factor_of_fine(d), d)) return &fine;
    last_mm_ = largest_mm(d);
    return nullptr;
  }

  // Times the first arcs, after runs with `multiple` times that did not do.
  int next(int multiple) const {
    const double more = 1.05 * std::pow(needed_mm_ / problem_.tolerance_mm(), 1.0 / order_);
    const int wanted = static_cast<int>(std::clamp(std::ceil(more * multiple), 1.3 * multiple, 4.0 * multiple));
    return std::max(wanted, multiple + 1);
  }

 private:
  bool may_meet(double factor, const Distance& d) const { return factor * largest_mm(d) <= problem_.tolerance_mm(); }
  double largest_mm(const Distance& d) const { return std::max(d.position_mm, d.rotation_rad * problem_.length_mm()); }
  bool meets(const Run& run, double factor, const Distance& d) {
    const double rest_mm = round_off_mm(problem_, run) + problem_.choice().rod.left_out_mm;
    const ArcExtent extent = run.extent(problem_);
    const double least_over_L = extent.least_error_over_L(extent.swing_rad <= longest_swing_rad);
    const double least_mm = std::max(least_over_L, run.engine.expected_turn_rad()) * problem_.length_mm();
    error_mm_ = std::max(factor * d.position_mm + rest_mm, least_mm);
    needed_mm_ = std::max(error_mm_, factor * largest_mm(d) + rest_mm);
    return needed_mm_ <= problem_.tolerance_mm();
  }

  const Problem& problem_;
  const int order_;
  double error_mm_ = std::numeric_limits<double>::infinity();
  double needed_mm_ = error_mm_;  // what must meet the tolerance: the error, and that of follower loads' directions x L
  double last_mm_ = std::numeric_limits<double>::quiet_NaN();  // distance of the last two runs but one
};

}  // namespace

void Run::reserve(const Room& room, Law law) {
  engine.reserve(room, law);
  arcs.reserve(room.spans);
}

void Run::set(const Problem& problem, std::span<const int> arcs_per_span, int factor, const Run* fewer_arcs) {
  arcs.assign(arcs_per_span.begin(), arcs_per_span.end());
  for (int& count : arcs) count *= factor;
  engine.set(problem, arcs, fewer_arcs ? &fewer_arcs->engine : nullptr);
}

void Run::solve(const Problem& problem, std::span<const int> arcs_per_span, int factor, const Run* fewer_arcs) {
  if (fewer_arcs && !fewer_arcs->converged()) fewer_arcs = nullptr;
  set(problem, arcs_per_span, factor, fewer_arcs);
  status = fewer_arcs ? engine.run_from(fewer_arcs->engine) : engine.run();
}

bool Run::solve_at_once(const Problem& problem, std::span<const int> arcs_per_span) {
  set(problem, arcs_per_span);
  status = engine.run_at_once();
  return converged();
}

double round_off_mm(const Problem& problem, const Run& run) {
  return 4 * std::numeric_limits<double>::epsilon() * problem.length_mm() * std::sqrt(run.arc_count());
}

double estimate_by_doubling_mm(const Problem& problem, const Run& run, Run& spare) {
  spare.solve(problem, run.arcs, 2, &run);
  if (!spare.converged()) return std::numeric_limits<double>::infinity();
  const double factor = std::pow(2, facts_of(problem.choice().law).order);
  const double error_mm = factor / (factor - 1) * distance(run, spare).position_mm + round_off_mm(problem, run);
  const ArcExtent extent = run.extent(problem);
  const double least_mm = extent.least_error_over_L(extent.resolved()) * problem.length_mm();
  return std::max(error_mm, least_mm) + problem.choice().rod.left_out_mm;
}

namespace {

int sum(const std::vector<int>& arcs) {
  return std::accumulate(arcs.begin(), arcs.end(), 0);
}

// Of the first arcs, as few as make a rod that is hardly bent worth trying: with more, rods of nearly round sections
// that end otherwise pay up to 1.4 times for having tried.
constexpr double fewer_share = 0.75;

// With as few arcs as do for a rod that is hardly bent, if it ends so. Where its loads have to grow they are too few,
// and would grow once more with others: strips took up to 2.8 times the instructions.
bool solve_hardly_bent(const Problem& problem, Run& run, std::vector<int>& first) {
  const Choice& choice = problem.choice();
  if (choice.march || choice.plane || !scene::is_conservative(problem.spans())) return false;
  std::vector<int> few;
  set_first_arcs_hardly_bent(problem.spans(), few);
  if (sum(few) > fewer_share * sum(first) || !run.solve_at_once(problem, few)) return false;
  first = few;
  return true;
}

// The first run, its arcs halved on the way where they come to swing too far to lead to a finer answer; in the two by
// turns. Where they do not lead on there either its loads grow from nothing. Returns how many times the first arcs it
// ends with.
int grow_first(const Problem& problem, std::span<const int> first, Run*& run, Run*& spare) {
  run->set(problem, first);
  run->status = run->engine.run(leading_swing_rad);
  int multiple = 1;
  while (run->is_paused() && 2 * run->arc_count() <= max_arcs) {
    multiple *= 2;
    spare->set(problem, first, multiple, run);
    spare->status = spare->engine.go_on_from(run->engine);
    if (spare->status == Status::not_converged && !spare->is_paused()) spare->solve(problem, first, multiple);
    std::swap(run, spare);
  }
  return multiple;
}

}  // namespace

// Runs with growing multiples of the first arcs.
Found solve_to_tolerance(const Problem& problem, Run& one, Run& another, bool fold_ends_it) {
  std::vector<int> first;
  set_first_arcs(problem.spans(), problem.choice().plane.has_value(), first);
  Ladder ladder(problem);
  Run *coarse = &one, *fine = &another;
  const bool hardly_bent = solve_hardly_bent(problem, *coarse, first);
  const int grown = hardly_bent ? 1 : grow_first(problem, first, coarse, fine), count = sum(first);
  if (ladder.suffices(*coarse)) {
    fine->status = Status::not_converged;  // it may hold another problem's answer
    return {coarse, fine, Status::converged, ladder.error_mm()};
  }
  if (fold_ends_it && !coarse->converged() && coarse->engine.nears_fold()) return {coarse, fine, coarse->status};
  int times_apart = 0;
  bool apart = false, agree = false;
  for (int multiple = grown, next = 2 * grown; static_cast<double>(next) * count <= max_arcs;) {
    refine(problem, first, next, *coarse, *fine, !apart && leads(problem, *coarse, agree));
    const double ratio = static_cast<double>(next) / multiple;
    int after = 2 * next;
    if (!fine->converged() && is_the_end(*coarse, *fine)) return {fine, coarse, fine->status};
    if (coarse->converged() && fine->converged()) {
      const Run* run = ladder.sufficient(*coarse, *fine, ratio);
      apart = times_apart < most_apart && are_apart(problem, *coarse, *fine);
      if (run && !apart) {
        if (run == coarse) std::swap(coarse, fine);
        return {fine, coarse, Status::converged, ladder.error_mm()};
      }
      times_apart += apart;
      agree = ladder.agree();
      if (!apart) after = ladder.next(next);
    }
    multiple = next;
    next = after;
    std::swap(coarse, fine);
  }
  if (!coarse->converged()) return {coarse, fine, coarse->status};
  return {coarse, fine, Status::tolerance_not_met, ladder.error_mm()};
}

}  // namespace fam
