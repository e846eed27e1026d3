#include "studies/work_precision/aims.h"
#include "studies/scenes/cases.h"

#include "exact_reference/solve.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/rk4_method.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <limits>

namespace studies {
namespace {

struct Series {
  std::string name;
  std::function<std::unique_ptr<Method>(int resolution)> method;
};

std::unique_ptr<Method> fam_arcs(fam::Law law, int arcs) {
  fam::Options options;
  options.law = law;
  options.arcs = arcs;
  options.model = fam::RodModel::kirchhoff;
  options.estimate_error = false;
  return fam_method(options);
}

const std::vector<Series>& all_series() {
  static const std::vector<Series> series = {
      {"fam sixth_order", [](int arcs) { return fam_arcs(fam::Law::sixth_order, arcs); }},
      {"fam fourth_order", [](int arcs) { return fam_arcs(fam::Law::fourth_order, arcs); }},
      {"rk4 shooting", [](int steps) {
         return rk4_method({steps, false});
       }}};
  return series;
}

AimRow measured(const Series& series, const scene::Scene& scene, double target_mm, const StudyOptions& options) {
  exact_reference::Options kirchhoff;
  kirchhoff.model = exact_reference::RodModel::kirchhoff;
  const Eigen::Vector3d tip_B_mm = exact_reference::solve(scene, kirchhoff).tip().position_B_mm;
  const auto error_mm = [&](int resolution) {
    const scene::Equilibrium found = series.method(resolution)->solve(scene);
    return found.converged() ? (found.tip().position_B_mm - tip_B_mm).norm() : std::numeric_limits<double>::infinity();
  };
  AimRow row;
  row.series = series.name;
  constexpr int most = 1000;
  for (int n = 1; n <= most && row.resolution == 0; n += 1 + n / 20) {
    if (error_mm(n) > target_mm || error_mm(n + 1) > target_mm || error_mm(2 * n) > target_mm) continue;
    row.resolution = n;
    row.error_mm = error_mm(n);
    row.time = time_of(options, series.method(n)->bare_solve(scene));
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
    for (const Series& series : all_series()) {
      AimRow row = measured(series, scene, aim.target_mm, options);
      row.scene = aim.scene;
      row.target_mm = aim.target_mm;
      row.aim_us = aim.aim_us;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string aims_table(const std::vector<AimRow>& rows) {
  Table table({"scene", "tip error wanted, mm", "aim, µs", "method", "arcs or steps", "tip error, mm",
               "median, µs (quartiles)", "ratio"});
  const AimRow* first = nullptr;
  for (const AimRow& row : rows) {
    if (first == nullptr || row.scene != first->scene || row.target_mm != first->target_mm) first = &row;
    const bool none = row.resolution == 0;
    table.add({row.scene, scientific(row.target_mm, 0), fmt::format("{}", row.aim_us), row.series,
               none ? "–" : std::to_string(row.resolution), none ? "–" : scientific(row.error_mm, 1),
               none ? "–"
                    : fmt::format("{:.3g} ({:.3g} … {:.3g})", row.time.median_us, row.time.lower_quartile_us,
                                  row.time.upper_quartile_us),
               none ? "–" : fmt::format("{:.1f}", row.time.median_us / first->time.median_us)});
  }
  return table.markdown();
}

}  // namespace studies
