#include "studies/walks/walk.h"

#include "exact_reference/solve.h"
#include "fam/solver.h"
#include "scene/load_visitor.h"
#include "studies/report/progress.h"
#include "studies/scenes/random_scene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <random>

namespace studies {
namespace {

using Eigen::Vector3d;

constexpr double wrong = 1e-2;  // over L

// Draws the next loads: all scaled alike, or each on its own, by -0.5 to 1.5; half of those turned by up to a radian; a
// tenth of the point loads moves.
class Steps {
 public:
  explicit Steps(std::uint64_t seed) : engine_(seed + 0x9e3779b97f4a7c15ULL) {}

  void take(fam::Solver& solver, const scene::Scene& first) {
    together_ = chance(0.3) ? std::optional(uniform(-0.5, 1.5)) : std::nullopt;
    const double length_mm = scene::length_mm(first);
    for (std::size_t i = 0; i < first.loads.size(); ++i) {
      const auto move = [&] {
        if (chance(0.1)) solver.set_at_mm(i, length_mm * uniform(0.05, 1));
      };
      scene::visit_load(
          first.loads[i],
          [&](const scene::Force& force) {
            solver.set_force_N(i, next(force.value_N));
            move();
          },
          [&](const scene::Moment& moment) {
            solver.set_moment_Nmm(i, next(moment.value_Nmm));
            move();
          },
          [&](const scene::DistributedForce& force) { solver.set_distributed_N_per_mm(i, next(force.value_N_per_mm)); },
          [&](const scene::Gravity& gravity) {
            solver.set_acceleration_m_per_s2(i, next(gravity.acceleration_m_per_s2));
          },
          [&](const scene::Tendon& tendon) { solver.set_tension_N(i, std::max(0.0, factor()) * tendon.tension_N); });
    }
  }

 private:
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  bool chance(double probability) { return unit() < probability; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  double factor() { return together_ ? *together_ : uniform(-0.5, 1.5); }

  Vector3d next(const Vector3d& first) {
    Vector3d value = factor() * first;
    if (together_ || chance(0.5)) return value;
    Vector3d axis;
    for (double& component : axis) component = uniform(-1, 1);
    return Eigen::AngleAxisd(uniform(0, 1), axis.normalized()) * value;
  }

  std::mt19937_64 engine_;
  std::optional<double> together_;
};

double distance(const fam::Solver& solver, const scene::Equilibrium& truth, double length_mm) {
  double largest_mm = 0;
  for (const scene::Station& station : truth.stations) {
    const Vector3d position_mm = solver.pose_at(station.s_mm).position_B_mm;
    largest_mm = std::max(largest_mm, (position_mm - station.X_BS.position_B_mm).norm());
  }
  return largest_mm / length_mm;
}

// The way of the loads that were solved, from the first on, and of those that are asked for.
using Way = std::vector<scene::Scene>;

scene::Equilibrium exact_along(std::span<const scene::Scene> way) {
  return exact_reference::solve_along(way, {exact_reference::RodModel::reissner, walk_exact_tolerance});
}

bool is_as_cold(WalkStep& step, const fam::Solver& solver, const fam::Options& options, const scene::Scene& scene) {
  const scene::Equilibrium cold = fam::solve(scene, options);
  if (!cold.converged()) return false;
  step.error = distance(solver, cold, scene::length_mm(scene));
  step.outcome = "as cold";
  return step.error <= 2 * walk_tolerance;
}

void judge_answer(WalkStep& step, fam::Solver& solver, const Way& way) {
  const double length_mm = scene::length_mm(way.back());
  const scene::Equilibrium truth = exact_along(way);
  step.outcome = "no judge";
  if (!truth.converged()) return;
  step.error = distance(solver, truth, length_mm);
  if (step.error <= walk_tolerance) step.outcome = "as exact";
  else if (solver.error_estimate_mm() >= step.error * length_mm) step.outcome = "told by the estimate";
  else step.outcome = step.error <= wrong ? "tolerance missed" : "wrong";
}

void judge_stop(WalkStep& step, const Way& way) {
  step.outcome = "stopped";
  if (exact_along(way).converged()) return;
  const bool comes_there = exact_along(std::span(way).first(way.size() - 1)).converged();
  step.outcome = comes_there ? "stopped, rightly" : "stopped, no judge";
}

}  // namespace

std::vector<WalkStep> walk(std::uint64_t seed, Judge judge) {
  const scene::Scene first = random_scene(seed);
  fam::Options options;
  options.tolerance_mm = walk_tolerance * scene::length_mm(first);
  options.reserved_arcs = 4096;
  auto made = fam::Solver::make(first, options);
  auto* solver = std::get_if<fam::Solver>(&made);
  std::vector<WalkStep> steps;
  if (!solver || !solver->solve(fam::Solver::Start::unloaded).converged()) return steps;
  Steps loads(seed);
  Way way{first};
  for (int i = 0; i < steps_of_walk; ++i) {
    loads.take(*solver, first);
    const fam::Solver::Outcome outcome = solver->solve();
    way.push_back(solver->scene());
    WalkStep& step = steps.emplace_back(WalkStep{seed, i, scene::name(outcome.status), {}, 0});
    if (!outcome.converged()) {
      judge_stop(step, way);
      way.pop_back();
    } else if (judge == Judge::exact || !is_as_cold(step, *solver, options, way.back())) {
      judge_answer(step, *solver, way);
    }
  }
  return steps;
}

std::vector<WalkStep> all_walks(std::uint64_t walks, Progress::Style style) {
  std::vector<std::vector<WalkStep>> of_seed(walks);
  in_parallel(walks, "walks", style, [&](std::uint64_t i) { of_seed[i] = walk(mixed_seed(i)); });
  std::vector<WalkStep> all;
  for (const std::vector<WalkStep>& steps : of_seed) all.insert(all.end(), steps.begin(), steps.end());
  return all;
}

}  // namespace studies
