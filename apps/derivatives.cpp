#include "apps/derivatives.h"

#include "fam/solver.h"
#include "scene/load_visitor.h"

#include <nlohmann/json.hpp>

namespace apps {
namespace {

using nlohmann::ordered_json;

template <class Matrix>
ordered_json rows(const Matrix& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

const char* value_name(const scene::Load& load) {
  return scene::visit_load(
      load, [](const scene::Force&) { return "value_N"; }, [](const scene::Moment&) { return "value_Nmm"; },
      [](const scene::DistributedForce&) { return "value_N_per_mm"; },
      [](const scene::Gravity&) { return "acceleration_m_per_s2"; }, [](const scene::Tendon&) { return "tension_N"; });
}

ordered_json derivatives(const fam::Solver& solver) {
  const scene::Scene& scene = solver.scene();
  const double tip_mm = scene::length_mm(scene);
  ordered_json loads = ordered_json::array(), sections = ordered_json::array();
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const auto tip = solver.by_load(i, tip_mm);
    const Eigen::Index columns = scene::tendon_of(scene.loads[i]) ? 1 : 3;
    loads.push_back({{"load", i}, {"by", value_name(scene.loads[i])}, {"tip", rows(tip.leftCols(columns))}});
  }
  for (std::size_t i = 0; i < scene.sections.size(); ++i) {
    const auto stiffness = solver.by_stiffness(i, tip_mm);
    sections.push_back({{"section", i},
                        {"bending_Nmm2", rows(stiffness.rightCols<2>())},
                        {"torsion_Nmm2", rows(stiffness.leftCols<1>())},
                        {"rest_curvature_per_mm", rows(solver.by_rest_curvature(i, tip_mm))}});
  }
  return {{"tip_compliance", rows(solver.compliance(tip_mm))}, {"loads", loads}, {"sections", sections}};
}

// Of a solver that is asked for a tenth of the tolerance, or less until its own estimate meets it; null: none does.
ordered_json derivatives(const scene::Scene& scene, fam::Options options) {
  const double wanted_mm = fam::tolerance_mm(options, scene::length_mm(scene));
  options.reserved_arcs = 1 << 14;
  for (options.tolerance_mm = wanted_mm / 10; options.tolerance_mm > 1e-5 * wanted_mm; options.tolerance_mm /= 10) {
    auto made = fam::Solver::make(scene, options);
    fam::Solver* solver = std::get_if<fam::Solver>(&made);
    if (!solver || !solver->solve().converged()) return nullptr;
    if (options.arcs > 0 || solver->error_estimate_mm() <= wanted_mm) return derivatives(*solver);
  }
  return nullptr;
}

}  // namespace

std::string with_derivatives(const std::string& solved_json, const scene::Scene& scene, const fam::Options& options) {
  ordered_json result = ordered_json::parse(solved_json);
  result["derivatives"] = derivatives(scene, options);
  return result.dump(2) + "\n";
}

}  // namespace apps
