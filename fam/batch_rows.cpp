#include "fam/batch_rows.h"

#include "fam/solve.h"
#include "fam/tolerance.h"

#include "scene/load_visitor.h"

#include <Eigen/Geometry>

#include <limits>
#include <numeric>

namespace fam {

using scene::Status;

BatchResult room_for(Eigen::Index rods) {
  BatchResult result;
  result.position_mm.resize(rods, 3);
  result.rotation_wxyz.resize(rods, 4);
  result.error_estimate_mm.resize(rods);
  result.status.resize(static_cast<std::size_t>(rods));
  return result;
}

void set_value(Solver& solver, std::size_t index, const scene::Load& value) {
  scene::visit_load(
      value, [&](const scene::Force& force) { solver.set_force_N(index, force.value_N); },
      [&](const scene::Moment& moment) { solver.set_moment_Nmm(index, moment.value_Nmm); },
      [&](const scene::DistributedForce& force) { solver.set_distributed_N_per_mm(index, force.value_N_per_mm); },
      [&](const scene::Gravity& gravity) { solver.set_acceleration_m_per_s2(index, gravity.acceleration_m_per_s2); },
      [&](const scene::Tendon& tendon) { solver.set_tension_N(index, tendon.tension_N); });
}

BatchRows::BatchRows(const scene::Scene& scene, std::span<const BatchColumn> columns,
                     const Eigen::Ref<const RowMajorMatrix>& values, const Options& options, BatchResult& result,
                     const LaneUnit& unit)
    : scene_(scene),
      columns_(columns),
      values_(values),
      options_(options),
      result_(result),
      unit_(unit),
      length_mm_(scene::length_mm(scene)),
      lanes_(scene, columns, options),
      row_scene_(scene) {
  tolerance_mm_ = tolerance_mm(options, length_mm_);
  for (const BatchColumn& column : columns) changing_.insert(column.load);
}

void BatchRows::solve(Eigen::Index begin, Eigen::Index end) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  result_.position_mm.middleRows(begin, end - begin).setConstant(nan);
  result_.rotation_wxyz.middleRows(begin, end - begin).setConstant(nan);
  result_.error_estimate_mm.segment(begin, end - begin).setConstant(nan);
  first_row_ = begin;
  tips_.resize(static_cast<std::size_t>(end - begin));
  left_.clear();
  sort(begin, end);
  for (const auto& [kind, rows] : kinds_) {
    if (!rows.empty()) solve_in_lanes(kind, rows);
  }
  for (const std::ptrdiff_t row : left_) solve_one_by_one(row);
  for (std::ptrdiff_t row = begin; row < end; ++row) {
    if (result_.status[static_cast<std::size_t>(row)] != Status::converged) solve_by_itself(row);
  }
}

void BatchRows::set_values(Eigen::Index row) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    scene::numbers_of(row_scene_.loads[columns_[i].load])[static_cast<std::size_t>(columns_[i].component)] =
        values_(row, static_cast<Eigen::Index>(i));
  }
}

// By the model that fam::solve would take for each, and the arcs that bounds ask for; the same for all where the arcs
// are given.
void BatchRows::sort(Eigen::Index begin, Eigen::Index end) {
  left_out_mm_.assign(tips_.size(), 0);
  for (auto& [kind, rows] : kinds_) rows.clear();
  if (options_.arcs > 0) {
    Rows& rows = kinds_[{lanes_.choice().rod.model, scene::cells_per_span(lanes_.spans(), options_.arcs)}];
    for (std::ptrdiff_t row = begin; row < end; ++row) rows.push_back(row);
    return;
  }
  Kind kind;
  for (std::ptrdiff_t row = begin; row < end; ++row) {
    set_values(row);
    problem_.set(row_scene_, options_);
    const Choice& choice = problem_.choice();
    kind.model = choice.rod.model;
    left_out_mm_[static_cast<std::size_t>(row - begin)] = choice.rod.left_out_mm;
    set_first_arcs(problem_.way().bounds, choice.plane.has_value(), kind.arcs_per_span,
                   arcs_factor(choice.law, tolerance_mm_ / length_mm_));
    kinds_[kind].push_back(row);
  }
}

void BatchRows::solve_in_lanes(const Kind& kind, const Rows& rows) {
  const int arcs = std::accumulate(kind.arcs_per_span.begin(), kind.arcs_per_span.end(), 0);
  if (!lanes_.is_solvable(kind.model) || (options_.arcs == 0 && arcs > options_.reserved_arcs / 2)) {
    left_.insert(left_.end(), rows.begin(), rows.end());
    return;
  }
  LaneRods& rods = lanes_.set(kind.model, kind.arcs_per_span);
  rods.row_stride = values_.outerStride();
  rods.estimate = options_.estimate_error;
  rods.longest_load_length = longest_load_length;
  rods.largest_swing_rad =
      options_.arcs > 0 ? longest_swing_rad : allowed_swing_rad(lanes_.choice().law, tolerance_mm_ / length_mm_);
  unit_.solve(rods, values_.data(), rows, tips_.data() - first_row_);
  const double safety = options_.arcs > 0 ? 1 : coarse_safety;
  for (const std::ptrdiff_t row : rows) {
    const auto k = static_cast<std::size_t>(row - first_row_);
    const LaneTip& tip = tips_[k];
    if (!tip.solved) {
      left_.push_back(row);
      continue;
    }
    const double* q = tip.rotation_wxyz;
    Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
    if (rods.round) rotation = rotation * Eigen::AngleAxisd(tip.twist_rad, Eigen::Vector3d::UnitX());
    keep(row, Eigen::Map<const Eigen::Vector3d>(tip.position_mm), rotation,
         rods.estimate ? safety * (tip.error_mm + left_out_mm_[k]) : 0);
  }
}

void BatchRows::solve_one_by_one(std::ptrdiff_t row) {
  if (!solver_) solver_.emplace(Solver::make(scene_, options_));
  Status& status = result_.status[static_cast<std::size_t>(row)];
  if (const auto* refusal = std::get_if<Refusal>(&*solver_)) {
    status = refusal->status;
    return;
  }
  auto& solver = std::get<Solver>(*solver_);
  set_values(row);
  for (const std::size_t index : changing_) set_value(solver, index, row_scene_.loads[index]);
  status = solver.solve(Solver::Start::unloaded).status;
  if (status != Status::converged) return;
  keep(row, solver.tip().position_B_mm, Eigen::Quaterniond(solver.tip().rotation_BS),
       options_.estimate_error ? solver.error_estimate_mm() : 0);
}

// Lanes and a kept solver take as many arcs as bounds ask for; this tells from solutions how many do, and where the rod
// snaps.
void BatchRows::solve_by_itself(std::ptrdiff_t row) {
  set_values(row);
  Options options = options_;
  options.whole_rod = false;
  const scene::Equilibrium found = fam::solve(row_scene_, options);
  result_.status[static_cast<std::size_t>(row)] = found.status;
  if (!found.converged()) return;
  const scene::Pose& tip = found.tip();
  keep(row, tip.position_B_mm, Eigen::Quaterniond(tip.rotation_BS), found.error_estimate_mm);
}

void BatchRows::keep(std::ptrdiff_t row, const Eigen::Vector3d& position_mm, const Eigen::Quaterniond& rotation,
                     double error_mm) {
  Status& status = result_.status[static_cast<std::size_t>(row)];
  status = options_.arcs > 0 || error_mm <= tolerance_mm_ ? Status::converged : Status::tolerance_not_met;
  if (status != Status::converged) return;
  const Eigen::Quaterniond unit = rotation.normalized();
  const double sign = unit.w() < 0 ? -1 : 1;
  result_.position_mm.row(row) = position_mm;
  result_.rotation_wxyz.row(row) = sign * Eigen::RowVector4d(unit.w(), unit.x(), unit.y(), unit.z());
  result_.error_estimate_mm[row] = error_mm;
}

}  // namespace fam
