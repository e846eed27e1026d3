#include "studies/fe_verification/data.h"

#include "studies/methods/registry.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::string error_over_L_text(double error) {
  return error < 0 ? "×" : scientific(std::max(error, fe_floor_over_L), 1);
}

std::string order_text(double order) {
  return std::isfinite(order) ? fixed(order, 1) : "–";
}

}  // namespace

double fe_error(const FeVerification& data, const std::string& rod, int order, bool full, int elements) {
  return std::find_if(data.convergence.begin(), data.convergence.end(),
                      [&](const FeConvergence& c) {
                        return c.rod == rod && c.order == order && c.full_integration == full && c.elements == elements;
                      })
      ->error_over_L;
}

double observed_order(const FeVerification& data, const std::string& rod, int order, bool full) {
  double observed = NAN;
  for (int elements = 2; elements <= 256; elements *= 2) {
    const double coarse = fe_error(data, rod, order, full, elements / 2);
    const double fine = fe_error(data, rod, order, full, elements);
    if (coarse > 0 && fine > 10 * fe_floor_over_L) observed = std::log2(coarse / fine);
  }
  return observed;
}

std::string fe_convergence_csv(const FeVerification& data) {
  Table table({"rod", "order", "integration", "elements", "tip_error_over_L"});
  for (const FeConvergence& c : data.convergence) {
    table.add({c.rod, std::to_string(c.order), c.full_integration ? "full" : "reduced", std::to_string(c.elements),
               error_over_L_text(c.error_over_L)});
  }
  return table.csv({"Against the exact rod. Errors below 1e-11 are written as 1e-11; x: not converged."});
}

std::string fe_own_error_csv(const FeVerification& data) {
  Table table({"scene", "tip_error_over_L", "estimate_over_L", "kirchhoff_tip_error_over_L", "load_steps",
               "newton_iterations"});
  for (const FeOwnError& e : data.own_errors) {
    table.add({e.scene, error_over_L_text(e.error_over_L), error_over_L_text(e.estimate_over_L),
               error_over_L_text(e.kirchhoff_error_over_L), std::to_string(e.load_steps),
               std::to_string(e.newton_iterations)});
  }
  return table.csv({"50 quadratic elements, reduced integration, against the exact rod of the same model."});
}

std::string fe_work_csv(const FeVerification& data) {
  Table table({"model", "F_L2_over_EI", "status", "load_steps", "newton_iterations"});
  for (const FeWork& w : data.work) {
    table.add({w.model, fmt::format("{:g}", w.load), w.status, std::to_string(w.load_steps),
               std::to_string(w.newton_iterations)});
  }
  return table.csv({"Fixed transverse tip force, 50 quadratic elements."});
}

std::string fe_order_table(const FeVerification& data) {
  const std::string at = fmt::format("error / L, {} elements", fe_coarse);
  Table table({"elements", "integration", "S4: order", "S4: " + at, "thin rod: order", "thin rod: " + at});
  const char* keys[] = {"fe_linear", "fe", "fe_cubic"};
  for (const bool full : {false, true}) {
    for (int order = 1; order <= 3; ++order) {
      std::vector<std::string> cells{order == 2 ? "FE (quadratic)" : method_row(keys[order - 1]).name,
                                     full ? "full" : "reduced"};
      for (const char* rod : {"thick", "thin"}) {
        cells.push_back(order_text(observed_order(data, rod, order, full)));
        cells.push_back(error_over_L_text(fe_error(data, rod, order, full, fe_coarse)));
      }
      table.add(cells);
    }
  }
  return table.markdown();
}

// A row a load; the real section, then Kirchhoff's rod.
std::string fe_work_table(const FeVerification& data) {
  Table table({"F L²/EI", "FE: load steps", "FE: Newton iterations", "FE, Kirchhoff: load steps",
               "FE, Kirchhoff: Newton iterations"});
  for (std::size_t i = 0; i + 1 < data.work.size(); i += 2) {
    std::vector<std::string> cells{fmt::format("{:g}", data.work[i].load)};
    for (const FeWork* w : {&data.work[i], &data.work[i + 1]}) {
      const bool converged = w->status == "converged";
      cells.push_back(converged ? std::to_string(w->load_steps) : w->status);
      cells.push_back(converged ? std::to_string(w->newton_iterations) : "–");
    }
    table.add(cells);
  }
  return table.markdown();
}

}  // namespace studies
