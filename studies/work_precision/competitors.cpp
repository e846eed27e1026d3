#include "studies/work_precision/competitors.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace studies {
namespace {

const std::vector<int> arc_counts = {1, 2, 4, 8, 12, 16, 32, 64, 128, 256, 512};
const std::vector<int> step_counts = {2, 4, 8, 16, 32, 64, 128, 256, 512};

std::vector<int> element_counts(FeMeshes meshes, bool with_shear, bool linear) {
  if (meshes == FeMeshes::few && !with_shear) return {};
  if (meshes == FeMeshes::few && linear) return {1, 4, 16, 50};
  if (meshes == FeMeshes::few) return {1, 2, 4, 8, 16, 32, 50};
  std::vector<int> counts = {1, 2, 4, 8, 16, 32, 50, 100};
  if (meshes == FeMeshes::most && with_shear) counts.insert(counts.end(), {200, 400});
  return counts;
}

std::vector<double> tolerances(const Series& series) {
  if (series.method == "fam") return {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
  if (series.method == "exact") return {1e-3, 1e-6, 1e-9, 1e-12};
  return {};
}

std::vector<int> counts(const Series& series, FeMeshes meshes, bool with_shear) {
  const std::string& thing = series.row().counts;
  if (thing == "arc") return arc_counts;
  if (thing == "step") return step_counts;
  if (thing == "element") return element_counts(meshes, with_shear, series.method == "fe_linear");
  return {};
}

// FAM's automatic choice takes its rod model itself.
Request request_of(const Series& series, bool with_shear) {
  Request request;
  if (series.method != "fam") {
    request.model = with_shear ? scene::RodModel::reissner : scene::RodModel::kirchhoff;
    request.estimate_error = false;
  }
  request.whole_load = series.whole_load;
  return request;
}

void add(std::vector<Competitor>& list, const Series& series, FeMeshes meshes, bool with_shear) {
  const MethodRow& row = series.row();
  const std::string model = with_shear ? "Reissner" : "Kirchhoff";
  Request request = request_of(series, with_shear);
  for (const int count : counts(series, meshes, with_shear)) {
    request.count = count;
    list.push_back({series.key, model, counted(count, row.counts), std::to_string(count), row(request)});
  }
  for (const double tolerance : tolerances(series)) {
    request.tolerance = tolerance;
    const std::string text = fmt::format("{:.0e} L", tolerance);
    list.push_back({series.key, model, text, text, row(request)});
  }
  if (row.key == "elastica") list.push_back({series.key, model, "elliptic functions", "exact", row()});
}

}  // namespace

std::string Series::name() const {
  return row().name + (whole_load ? ", whole load first" : "");
}

const std::vector<Series>& all_series() {
  static const std::vector<Series> series = {{"fam published", "fam_published", true, false},
                                             {"fam midpoint", "fam_midpoint"},
                                             {"fam fourth_order", "fam_fourth_order"},
                                             {"fam sixth_order", "fam_sixth_order"},
                                             {"fam automatic", "fam", false, true},
                                             {"rk4 shooting", "rk4"},
                                             {"exact reference", "exact"},
                                             {"closed form", "elastica", true, false},
                                             {"fe linear whole load", "fe_linear", true, true, true},
                                             {"fe linear adaptive", "fe_linear"},
                                             {"fe quadratic whole load", "fe", true, true, true},
                                             {"fe quadratic adaptive", "fe"}};
  return series;
}

const Series& series_named(const std::string& key) {
  for (const Series& series : all_series()) {
    if (series.key == key) return series;
  }
  throw std::out_of_range("no series has the key " + key);
}

std::vector<Competitor> competitors(FeMeshes meshes) {
  std::vector<Competitor> list;
  for (const bool with_shear : {false, true}) {
    for (const Series& series : all_series()) {
      if (with_shear ? series.reissner : series.kirchhoff) add(list, series, meshes, with_shear);
    }
  }
  return list;
}

}  // namespace studies
