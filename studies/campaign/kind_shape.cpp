// Campaigns `shape` and `batch`: what a kept solver and a batch say, beside the certificate and beside each other.
#include "fam/solver.h"
#include "scene/load_visitor.h"
#include "studies/campaign/judged.h"
#include "studies/campaign/kind_rows.h"

#include <algorithm>
#include <random>

namespace studies {
namespace {

constexpr double solver_tolerance = 1e-5;  // over L
constexpr int places_between = 20;         // at random along the rod, beside the arcs' ends

fam::Options solver_options(const scene::Scene& scene) {
  fam::Options options;
  options.tolerance_mm = solver_tolerance * scene::length_mm(scene);
  return options;
}

// Of the solver's solution, at the arcs' ends and between.
scene::Equilibrium dense_answer(const fam::Solver& solver, double length_mm, std::uint64_t seed) {
  std::vector<double> places_mm(solver.s_mm().begin(), solver.s_mm().end());
  std::mt19937_64 random(seed);
  for (int k = 0; k < places_between; ++k)
    places_mm.push_back(length_mm * (0.001 + 0.998 * static_cast<double>(random() >> 11) * 0x1p-53));
  std::sort(places_mm.begin(), places_mm.end());
  scene::Equilibrium answer;
  answer.status = scene::Status::converged;
  for (const double s_mm : places_mm) {
    const bool again = !answer.stations.empty() && s_mm - answer.stations.back().s_mm < 1e-9 * length_mm;
    const scene::Wrench wrench = solver.wrench_at(s_mm);
    if (!again) answer.stations.push_back({s_mm, solver.pose_at(s_mm), wrench.force_N, wrench.moment_Nmm});
  }
  return answer;
}

SceneOutcome shape_outcome(std::uint64_t campaign, std::uint64_t index) {
  SceneOutcome outcome = started(campaign, index);
  const std::uint64_t seed = campaign_seed(campaign, index);
  const scene::Scene scene = random_scene(seed);
  const double length_mm = scene::length_mm(scene);
  auto made = fam::Solver::make(scene, solver_options(scene));
  fam::Solver& solver = std::get<fam::Solver>(made);
  const fam::Solver::Outcome solved = solver.solve();
  if (!solved.converged()) {
    outcome.outcome = std::string("no answer: ") + scene::name(solved.status);
    return outcome;
  }
  scene::Equilibrium answer = dense_answer(solver, length_mm, seed);
  const double estimate = solver.error_estimate_mm() / length_mm;
  const double allowed = std::max(solver_tolerance, estimate);
  const Judged by = judged(scene, answer, allowed, false, {1e-8, 1e-10});
  if (by.exact && !by.by_exact()) set_failure(outcome, "no judge");
  else if (by.position > allowed + judges_error) set_failure(outcome, "beyond tolerance and estimate");
  else outcome.outcome = by.position > solver_tolerance ? "beyond tolerance, told" : "kept";
  outcome.measures = {{"position", by.position}};
  if (by.certificate.found) {
    outcome.measures.push_back({"rotation_rad", by.certificate.rotation_rad});
    outcome.measures.push_back({"wrench", by.certificate.wrench});
  }
  return outcome;
}

constexpr int rods = 16;
// Over L, between a lane, which ends Newton's method at round-off, and a Solver, which ends it a hundredth of the
// tolerance away: 1.6e-7 at most on 1500 scenes, 24 000 rods.
constexpr double same_tip = 0.1 * solver_tolerance;

// Row k: all loads times (k + 1)/rods.
scene::Scene scene_of_row(scene::Scene scene, int k) {
  for (scene::Load& load : scene.loads) load = scene::scaled(load, (k + 1.0) / rods);
  return scene;
}

struct Rows {
  std::vector<fam::BatchColumn> columns;
  fam::RowMajorMatrix values;
};

// All numbers of all loads.
Rows rows_of(const scene::Scene& scene) {
  Rows rows;
  for (int k = 0; k < rods; ++k) {
    scene::Scene row = scene_of_row(scene, k);
    std::vector<double> values;
    for (std::size_t load = 0; load < row.loads.size(); ++load) {
      int component = 0;
      for (const double number : scene::numbers_of(row.loads.at(load))) {
        if (k == 0) rows.columns.push_back({load, component++});
        values.push_back(number);
      }
    }
    rows.values.conservativeResize(rods, static_cast<long>(values.size()));
    rows.values.row(k) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<long>(values.size()));
  }
  return rows;
}

SceneOutcome batch_outcome(std::uint64_t campaign, std::uint64_t index) {
  SceneOutcome outcome = started(campaign, index);
  const scene::Scene scene = random_scene(campaign_seed(campaign, index));
  fam::Options options = solver_options(scene);
  options.estimate_error = false;
  const Rows rows = rows_of(scene);
  const fam::BatchResult batch = fam::solve_batch(scene, rows.columns, rows.values, options);
  double difference = 0;
  bool statuses_differ = false, any_solved = false;
  for (int k = 0; k < rods; ++k) {
    auto made = fam::Solver::make(scene_of_row(scene, k), options);
    fam::Solver& solver = std::get<fam::Solver>(made);
    const bool solved = solver.solve(fam::Solver::Start::unloaded).converged();
    const bool lane_solved = batch.status[static_cast<std::size_t>(k)] == scene::Status::converged;
    statuses_differ |= lane_solved != solved;
    if (!lane_solved || !solved) continue;
    any_solved = true;
    const Eigen::Vector3d lane_tip_B_mm = batch.position_mm.row(k).transpose();
    difference = std::max(difference, (lane_tip_B_mm - solver.tip().position_B_mm).norm() / scene::length_mm(scene));
  }
  if (statuses_differ) set_failure(outcome, "another status");
  else if (difference > same_tip) set_failure(outcome, "another tip");
  else outcome.outcome = any_solved ? "alike" : "no rod has an answer";
  if (any_solved) outcome.measures = {{"difference", difference}};
  return outcome;
}

}  // namespace

const CampaignKind shape_kind{"shape", "Are a kept solver's poses and wrenches right anywhere?", shape_outcome};
const CampaignKind batch_kind{"batch", "Does a batch say what a solver says?", batch_outcome};

}  // namespace studies
