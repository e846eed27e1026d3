#include "fam/solve.h"

#include "fam/answer.h"
#include "fam/column.h"
#include "fam/limit.h"
#include "scene/load_visitor.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace fam {
namespace {

// A thread keeps the memory of a solve with no more arcs, and of a scene with no more spans and loads, than this.
// Taking it and giving it back were a sixth to a third of the instructions of an easy rod. Chosen, not measured.
constexpr std::size_t most_kept = 64;

using scene::Equilibrium;
using scene::Span;
using scene::Status;

// Why the published law cannot take a load, empty where it can.
std::string beyond_published(const scene::Load& load) {
  return scene::visit_load(
      load,
      [](const scene::Force& force) { return force.frame == scene::Frame::fixed ? "a force in a fixed frame" : ""; },
      [](const scene::Moment& moment) {
        return moment.frame == scene::Frame::fixed ? "a moment in a fixed frame" : "";
      },
      [](const scene::DistributedForce&) { return "a distributed force"; },
      [](const scene::Gravity&) { return "gravity"; },  //
      [](const scene::Tendon&) { return ""; });
}

}  // namespace

std::string refusal(const Problem& problem) {
  if (facts_of(problem.choice().law).coupled) return {};
  const scene::Scene& scene = problem.scene();
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const std::string what = beyond_published(scene.loads[i]);
    if (!what.empty()) return "loads[" + std::to_string(i) + "]: the published law cannot solve " + what;
  }
  if (problem.options().model == RodModel::reissner)
    return "the published law is a Kirchhoff rod's: no shear, no stretch";
  for (const Span& span : problem.scene_spans()) {
    if (span.stiffness.bending_Nmm2[0] != span.stiffness.bending_Nmm2[1]) {
      return "the published law needs sections with one bending stiffness, EI_y = EI_z";
    }
  }
  return {};
}

namespace {

// Where a load could not grow on, its path tells why.
std::optional<Equilibrium> beyond(const Problem& problem, const Run& run) {
  const bool stuck = run.status == Status::load_step_too_small || run.status == Status::work_limit ||
                     run.status == Status::tendon_collapsed;
  if (!stuck || run.engine.load_factor() <= 0 || !problem.follows_path()) return std::nullopt;
  return beyond_growth(problem.scene(), problem.options());
}

// What a solve works in.
struct Workspace {
  Problem problem;
  Run one, another, spare;
  Solution solution;

  bool is_small() const {
    const int arcs = std::max({one.arc_count(), another.arc_count(), spare.arc_count()});
    return std::max({static_cast<std::size_t>(arcs), problem.scene_spans().size(), problem.scene().loads.size()}) <=
           most_kept;
  }
};

Equilibrium solve_fixed(Workspace& memory) {
  const Problem& problem = memory.problem;
  Run& run = memory.one;
  run.solve(problem, scene::cells_per_span(problem.spans(), problem.options().arcs));
  if (!run.converged()) {
    const std::optional<Equilibrium> found = beyond(problem, run);
    return found ? *found : failure(run);
  }
  const ArcExtent extent = run.extent(problem);
  if (verdict(run.engine, problem.choice().law, extent) == Status::arc_not_converged)
    return too_long_for_series(extent);
  const double error_mm = problem.options().estimate_error ? estimate_by_doubling_mm(problem, run, memory.another)
                                                           : problem.choice().rod.left_out_mm;
  return success(problem, run, error_mm, is_stable(problem, run, nullptr, memory.another, memory.spare),
                 "number of arcs given", memory.solution);
}

Equilibrium solve_by_tolerance(Workspace& memory) {
  const Problem& problem = memory.problem;
  Found found = solve_to_tolerance(problem, memory.one, memory.another, problem.follows_path());
  if (!found.run->converged() && problem.follows_path()) {
    const std::optional<Equilibrium> result = beyond(problem, *found.run);
    // A fold of few arcs that the path does not know.
    const bool is_none = found.run->engine.nears_fold() && (!result || result->converged());
    if (is_none) found = solve_to_tolerance(problem, memory.one, memory.another);
    if (!found.run->converged() && result) return *result;
  }
  if (found.status == Status::tolerance_not_met) return tolerance_not_met(problem, *found.run, found.error_mm);
  if (found.status != Status::converged) return failure(*found.run);
  return success(problem, *found.run, found.error_mm,
                 is_stable(problem, *found.run, found.other, *found.other, memory.spare),
                 "fewest arcs found whose estimate meets the tolerance", memory.solution);
}

// A column is straight with any number of arcs; empty where it is none, or its stability takes more than a look.
std::optional<Equilibrium> solve_column(Workspace& memory) {
  const Problem& problem = memory.problem;
  const Choice& choice = problem.choice();
  if (choice.march || !is_column(problem.scene_spans())) return std::nullopt;
  const std::optional<bool> stable = is_stable_column(problem.scene_spans(), choice.rod.model);
  if (!stable) return std::nullopt;
  memory.one.solve(problem, std::vector<int>(problem.spans().size(), 1));
  const double error_mm = round_off_mm(problem, memory.one) + choice.rod.left_out_mm;
  if (!memory.one.converged() || error_mm > problem.tolerance_mm()) return std::nullopt;
  return success(problem, memory.one, error_mm, stable, "a column is straight", memory.solution);
}

// A thread's workspace while a solve has it. A solve within a solve finds none and makes one.
class Borrowed {
 public:
  Borrowed() : workspace_(std::move(kept)) {
    if (!workspace_) workspace_ = std::make_unique<Workspace>();
  }
  ~Borrowed() {
    if (workspace_->is_small()) kept = std::move(workspace_);
  }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  Workspace& operator*() const { return *workspace_; }

 private:
  static thread_local std::unique_ptr<Workspace> kept;
  std::unique_ptr<Workspace> workspace_;
};
thread_local std::unique_ptr<Workspace> Borrowed::kept;

}  // namespace

Equilibrium solve(const scene::Scene& scene, const Options& options) {
  const Borrowed borrowed;
  Workspace& memory = *borrowed;
  memory.problem.set(scene, options);
  const std::string why_not = refusal(memory.problem);
  if (!why_not.empty()) {
    Equilibrium result;
    result.status = Status::unsupported;
    result.message = why_not;
    return result;
  }
  if (options.arcs > 0) return solve_fixed(memory);
  if (std::optional<Equilibrium> column = solve_column(memory)) return *column;
  return solve_by_tolerance(memory);
}

}  // namespace fam
