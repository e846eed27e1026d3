#include "studies/batch/rods.h"

#include "fam/batch_rows.h"
#include "scene/load_visitor.h"
#include "studies/report/svg.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace studies {
namespace {

double& number_of(scene::Scene& scene, const fam::BatchColumn& column) {
  return scene::numbers_of(scene.loads[column.load])[static_cast<std::size_t>(column.component)];
}

}  // namespace

const std::array<BatchWay, batch_way_count> batch_ways = {{
    {"arcs_given", "arcs given", colour::blue},
    {"with_estimate", "and an error estimate", colour::purple},
    {"arcs_chosen", "arcs chosen, error estimate", colour::green},
    {"solver", "Solver, row by row, arcs given", colour::orange},
}};

// Weights stay as they are.
std::span<const BatchCase> batch_cases() {
  constexpr scene::RodModel kirchhoff = scene::RodModel::kirchhoff, reissner = scene::RodModel::reissner;
  using Columns = std::vector<fam::BatchColumn>;
  const Columns in_plane = {{0, 1}, {1, 2}}, force_y = {{0, 1}}, of_finger = {{0, 0}, {1, 0}, {2, 0}, {2, 1}},
                in_space = {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}}, of_catheter = {{1, 0}, {2, 0}, {3, 1}},
                of_arm = {{0, 0}, {1, 0}, {2, 0}, {3, 2}};
  static const BatchCase cases[] = {
      {"P4_follower", "plane, follower loads (P4)", "study1/P4_follower", reissner, 1, 1e-3, in_plane},
      {"P2_fixed", "plane, fixed force (P2)", "study1/P2_fixed", kirchhoff, 1, 2e-4, force_y},
      {"finger", "plane, finger with tendons", "batch/finger", kirchhoff, 1, 1e-3, of_finger},
      {"S4_follower", "space, follower loads (S4)", "study1/S4_follower", reissner, 1, 1e-3, in_space},
      {"S4_fixed", "space, fixed loads (S4)", "study1/S4_fixed", reissner, 1, 1e-3, in_space},
      {"S4_fixed_twice", "space, twice these loads", "study1/S4_fixed", reissner, 2, 1e-3, in_space},
      {"catheter", "space, catheter with tendons", "stream/catheter", kirchhoff, 1, 1e-3, of_catheter},
      {"arm", "space, arm of three sections", "robots/tendon_arm_three_sections", kirchhoff, 1, 1e-2, of_arm},
  };
  return cases;
}

fam::RowMajorMatrix random_rows(scene::Scene scene, const BatchCase& rods, Eigen::Index rows) {
  std::mt19937 random(1);
  fam::RowMajorMatrix values(rows, static_cast<Eigen::Index>(rods.columns.size()));
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (Eigen::Index k = 0; k < values.cols(); ++k) {
      const double share = static_cast<double>(random()) / 4294967296.0;
      values(row, k) = share * rods.scale * number_of(scene, rods.columns[static_cast<std::size_t>(k)]);
    }
  }
  return values;
}

void set_row(scene::Scene& scene, const BatchCase& rods, const BatchValues& values, Eigen::Index row) {
  for (std::size_t k = 0; k < rods.columns.size(); ++k)
    number_of(scene, rods.columns[k]) = values(row, static_cast<Eigen::Index>(k));
}

fam::Options batch_options(const BatchCase& rods, int arcs, bool estimate) {
  fam::Options options;
  options.model = rods.model;
  options.arcs = arcs;
  if (arcs == 0) options.tolerance_mm = rods.aim_mm;  // else a Solver's iteration would stop before round-off
  options.estimate_error = estimate;
  return options;
}

UnitOutcome solve_on_unit(const fam::LaneUnit& unit, const scene::Scene& scene, const BatchCase& rods,
                          const BatchValues& values, const fam::Options& options) {
  constexpr Eigen::Index block = 512;  // as fam::solve_batch
  UnitOutcome outcome{fam::room_for(values.rows()), values.rows()};
  fam::BatchRows rows(scene, rods.columns, values, options, outcome.result, unit);
  for (Eigen::Index begin = 0; begin < values.rows(); begin += block) {
    rows.solve(begin, std::min(begin + block, values.rows()));
    outcome.in_lanes -= static_cast<Eigen::Index>(rows.left_to_solver().size());
  }
  return outcome;
}

fam::BatchResult solve_one_by_one(const scene::Scene& scene, const BatchCase& rods, const BatchValues& values,
                                  const fam::Options& options) {
  fam::BatchResult result = fam::room_for(values.rows());
  auto solver = std::get<fam::Solver>(fam::Solver::make(scene, options));
  scene::Scene with_values = scene;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    set_row(with_values, rods, values, row);
    for (std::size_t k = 0; k < rods.columns.size(); ++k) {
      const std::size_t load = rods.columns[k].load;
      if (k == 0 || rods.columns[k - 1].load != load) fam::set_value(solver, load, with_values.loads[load]);
    }
    scene::Status& status = result.status[static_cast<std::size_t>(row)];
    status = solver.solve(fam::Solver::Start::unloaded).status;
    if (status == scene::Status::converged) result.position_mm.row(row) = solver.tip().position_B_mm;
  }
  return result;
}

double largest_difference_mm(const fam::BatchResult& a, const fam::BatchResult& b) {
  if (a.status != b.status) return INFINITY;
  double largest = 0;
  for (Eigen::Index row = 0; row < a.position_mm.rows(); ++row) {
    if (a.status[static_cast<std::size_t>(row)] != scene::Status::converged) continue;
    const double difference = (a.position_mm.row(row) - b.position_mm.row(row)).norm();
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

Eigen::Index converged_rows(const fam::BatchResult& result) {
  return std::count(result.status.begin(), result.status.end(), scene::Status::converged);
}

}  // namespace studies
