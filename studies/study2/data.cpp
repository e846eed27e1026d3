#include "studies/study2/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace studies {

const std::vector<std::vector<Study2Method>>& study2_groups() {
  static const std::vector<std::vector<Study2Method>> groups = {
      {{"exact", "exact", {}},
       {"exact_kirchhoff", "exact", {.model = scene::RodModel::kirchhoff}},
       {"fe", "fe", {}},
       {"fam_1e-3", "fam", {}, 1e-3},
       {"fam_1e-6", "fam", {}, 1e-6},
       {"fam_published_12", "fam_published", {.count = 12}, 0, true},
       {"fam_published_50", "fam_published", {.count = 50}, 0, true}},
      {{"fam", "fam", {}}, {"fam_sixth_order_12", "fam_sixth_order", {.count = 12}}}};
  return groups;
}

const Study2Method& study2_method(const std::string& key) {
  for (const auto& group : study2_groups()) {
    for (const Study2Method& method : group) {
      if (method.key == key) return method;
    }
  }
  throw std::out_of_range("Study II has no method " + key);
}

std::string study2_label(const std::string& key) {
  const Study2Method& method = study2_method(key);
  const std::string text = label(method_row(method.row), method.request);
  if (method.tolerance_mm == 0) return text;
  return fmt::format("{}, 1e{} mm", text, std::lround(std::log10(method.tolerance_mm)));
}

const Study2Row& row(const Study2Data& data, const std::string& scene, const std::string& method) {
  for (const Study2Row& r : data.rows) {
    if (r.scene == scene && r.method == method) return r;
  }
  throw std::out_of_range(method + " was not asked to solve " + scene);
}

double largest_error_mm(const Study2Row& row) {
  return row.errors_mm.empty() ? NAN : *std::max_element(row.errors_mm.begin(), row.errors_mm.end());
}

double largest_deflection_mm(const Study2Row& row) {
  double deflection = row.positions_mm.empty() ? NAN : 0;
  for (const auto& p : row.positions_mm) deflection = std::max(deflection, p.tail<2>().norm());
  return deflection;
}

}  // namespace studies
