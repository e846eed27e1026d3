#include "fam/solver.h"

#include "scene/load_visitor.h"

#include <Eigen/Geometry>

#include <charconv>
#include <cmath>
#include <limits>
#include <set>

namespace fam {
namespace {

using scene::Load;
using scene::SceneError;
using scene::Status;

std::string text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

[[noreturn]] void refuse(const std::string& path, const std::string& value, const std::string& rule) {
  throw SceneError(path + " = " + value + ": " + rule);
}

// The numbers of a load that columns may replace.
std::span<double> numbers_of(Load& load) {
  return scene::visit_load(
      load, [](scene::Force& force) { return std::span(force.value_N.data(), 3); },
      [](scene::Moment& moment) { return std::span(moment.value_Nmm.data(), 3); },
      [](scene::DistributedForce& force) { return std::span(force.value_N_per_mm.data(), 3); },
      [](scene::Gravity& gravity) { return std::span(gravity.acceleration_m_per_s2.data(), 3); },
      [](scene::Tendon& tendon) { return std::span(&tendon.tension_N, 1); });
}

void set(Solver& solver, std::size_t index, const Load& load) {
  scene::visit_load(
      load, [&](const scene::Force& force) { solver.set_force_N(index, force.value_N); },
      [&](const scene::Moment& moment) { solver.set_moment_Nmm(index, moment.value_Nmm); },
      [&](const scene::DistributedForce& force) { solver.set_distributed_N_per_mm(index, force.value_N_per_mm); },
      [&](const scene::Gravity& gravity) { solver.set_acceleration_m_per_s2(index, gravity.acceleration_m_per_s2); },
      [&](const scene::Tendon& tendon) { solver.set_tension_N(index, tendon.tension_N); });
}

void check(std::vector<Load>& loads, std::span<const BatchColumn> columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto [load, component] = columns[i];
    const std::string path = "columns[" + std::to_string(i) + "]";
    if (load >= loads.size()) {
      refuse(path + ".load", std::to_string(load),
             "must name one of the scene's " + std::to_string(loads.size()) + " loads, counted from 0");
    }
    const std::size_t components = numbers_of(loads[load]).size();
    if (component < 0 || static_cast<std::size_t>(component) >= components) {
      refuse(path + ".component", std::to_string(component),
             components == 1 ? "must be 0, the tension of a tendon" : "must be 0, 1 or 2");
    }
    for (std::size_t before = 0; before < i; ++before) {
      if (columns[before].load == load && columns[before].component == component)
        refuse(path, std::to_string(load) + "." + std::to_string(component), "the column is given twice");
    }
  }
}

void check(const std::vector<Load>& loads, std::span<const BatchColumn> columns,
           const Eigen::Ref<const RowMajorMatrix>& values) {
  if (static_cast<std::size_t>(values.cols()) != columns.size()) {
    refuse("values", std::to_string(values.cols()) + " columns",
           "must have " + std::to_string(columns.size()) + ", one for each of columns");
  }
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      const double value = values(row, column);
      const bool tension = scene::tendon_of(loads[columns[static_cast<std::size_t>(column)].load]) != nullptr;
      if (std::isfinite(value) && (value >= 0 || !tension)) continue;
      refuse("values[" + std::to_string(row) + "][" + std::to_string(column) + "]", text(value),
             tension ? "must be >= 0" : "must be finite");
    }
  }
}

BatchResult all_failed(Eigen::Index rows, Status status) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BatchResult result;
  result.position_mm.setConstant(rows, 3, nan);
  result.rotation_wxyz.setConstant(rows, 4, nan);
  result.status.assign(static_cast<std::size_t>(rows), status);
  result.error_estimate_mm.setConstant(rows, nan);
  return result;
}

Eigen::RowVector4d quaternion_wxyz(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  const double sign = q.w() < 0 ? -1 : 1;
  return sign * Eigen::RowVector4d(q.w(), q.x(), q.y(), q.z());
}

// A cold solve with the values set, into one row of the result.
void solve_row(Solver& solver, Eigen::Index row, const Options& options, double tolerance_mm, BatchResult& result) {
  Status& status = result.status[static_cast<std::size_t>(row)];
  status = solver.solve(Solver::Start::unloaded).status;
  if (status != Status::converged) return;
  const double error_mm = options.estimate_error ? solver.error_estimate_mm() : 0;
  if (options.arcs == 0 && !(error_mm <= tolerance_mm)) {
    status = Status::tolerance_not_met;
    return;
  }
  result.position_mm.row(row) = solver.tip().position_B_mm;
  result.rotation_wxyz.row(row) = quaternion_wxyz(solver.tip().rotation_BS);
  result.error_estimate_mm[row] = error_mm;
}

}  // namespace

BatchResult solve_batch(const scene::Scene& scene, std::span<const BatchColumn> columns,
                        Eigen::Ref<const RowMajorMatrix> values, const Options& options) {
  scene::validate(scene);
  std::vector<Load> loads = scene.loads;
  check(loads, columns);
  check(loads, columns, values);
  std::variant<Solver, Refusal> made = Solver::make(scene, options);
  if (const auto* refusal = std::get_if<Refusal>(&made)) return all_failed(values.rows(), refusal->status);
  Solver& solver = std::get<Solver>(made);

  std::set<std::size_t> changing;
  for (const BatchColumn& column : columns) changing.insert(column.load);
  const double tolerance_mm = options.tolerance_mm > 0 ? options.tolerance_mm : 1e-3 * scene::length_mm(scene);
  BatchResult result = all_failed(values.rows(), Status::not_converged);
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      numbers_of(loads[columns[i].load])[static_cast<std::size_t>(columns[i].component)] =
          values(row, static_cast<Eigen::Index>(i));
    }
    for (const std::size_t index : changing) set(solver, index, loads[index]);
    solve_row(solver, row, options, tolerance_mm, result);
  }
  return result;
}

}  // namespace fam
