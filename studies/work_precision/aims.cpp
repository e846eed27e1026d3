#include "studies/work_precision/aims.h"

#include "exact_reference/solve.h"
#include "studies/methods/registry.h"
#include "studies/scenes/cases.h"

#include <limits>

namespace studies {
namespace {

std::unique_ptr<Method> kirchhoff_kernel(const std::string& key, int count) {
  Request request;
  request.count = count;
  request.model = scene::RodModel::kirchhoff;
  request.estimate_error = false;
  return method_row(key)(request);
}

AimRow measured(const std::string& key, const scene::Scene& scene, double target_mm, const StudyOptions& options) {
  exact_reference::Options kirchhoff;
  kirchhoff.model = exact_reference::RodModel::kirchhoff;
  const Eigen::Vector3d tip_B_mm = exact_reference::solve(scene, kirchhoff).tip().position_B_mm;
  const auto error_mm = [&](int count) {
    const scene::Equilibrium found = kirchhoff_kernel(key, count)->solve(scene);
    return found.converged() ? (found.tip().position_B_mm - tip_B_mm).norm() : std::numeric_limits<double>::infinity();
  };
  AimRow row;
  row.method = key;
  constexpr int most = 1000;
  for (int n = 1; n <= most && row.resolution == 0; n += 1 + n / 20) {
    if (error_mm(n) > target_mm || error_mm(n + 1) > target_mm || error_mm(2 * n) > target_mm) continue;
    row.resolution = n;
    row.error_mm = error_mm(n);
    row.time = time_of(options, kirchhoff_kernel(key, n)->bare_solve(scene));
  }
  return row;
}

}  // namespace

std::vector<AimRow> measured_aims(const StudyOptions& options) {
  struct Aim {
    std::string scene;
    double target_mm, aim_us;
  };
  std::vector<AimRow> rows;
  for (const Aim& aim : {Aim{"S4_follower", 1e-3, 0.5}, {"S4_follower", 1e-8, 10}, {"P2_fixed", 2e-4, 4}}) {
    const scene::Scene scene = read_case(options.cases, "study1/" + aim.scene);
    for (const char* key : {"fam_sixth_order", "fam_fourth_order", "rk4"}) {
      AimRow row = measured(key, scene, aim.target_mm, options);
      row.scene = aim.scene;
      row.target_mm = aim.target_mm;
      row.aim_us = aim.aim_us;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace studies
