#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/work_precision/data.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace studies {
namespace {

void add_once(std::vector<std::string>& list, const std::string& text) {
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

std::string error_cell(double error) {
  return std::isfinite(error) ? scientific(std::max(error, work_error_floor), 1) : "–";
}

std::string accuracy_csv(const WorkData& data) {
  Table table({"scene", "method", "model", "resolution", "status", "tip_error_over_L", "reference_error_over_L"});
  for (const WorkPoint& p : data.points) {
    table.add({p.scene, p.series, p.model, p.resolution, p.status, error_cell(p.error),
               scientific(std::max(p.reference_error, work_error_floor), 0)});
  }
  return table.csv(
      {"Tip error over L against the exact rod of the method's own model (shear and stretch: Reissner; "
       "without: Kirchhoff); fam automatic chooses its model and is held to Reissner's.",
       "Errors below 1e-12 are written as 1e-12."});
}

std::string timing_csv(const WorkData& data) {
  Table table({"scene", "method", "model", "resolution", "status", "start", "median_us", "lower_quartile_us",
               "upper_quartile_us", "repeats"});
  const auto add = [&](const WorkPoint& p, const char* start, const Timing& t) {
    table.add({p.scene, p.series, p.model, p.resolution, p.status, start, fixed(t.median_us, 2),
               fixed(t.lower_quartile_us, 2), fixed(t.upper_quartile_us, 2), std::to_string(t.repeats)});
  };
  for (const WorkPoint& p : data.points) {
    if (p.time) add(p, "cold", *p.time);
    if (p.warm) add(p, "warm", *p.warm);
  }
  return table.csv({machine_line(), "The bare solve; where the status is not converged, until it gave up."});
}

std::string time_to_csv(const WorkData& data) {
  Table table({"scene", "method", "model", "start", "target_over_L", "time_us"});
  const auto add = [&](const std::string& scene, const std::string& series, const std::string& model, bool warm) {
    for (const double target : work_targets) {
      const double time = time_to_us(data, scene, series, model, target, warm);
      table.add({scene, series, model, warm ? "warm" : "cold", scientific(target, 0),
                 std::isfinite(time) ? fixed(time, 2) : "nan"});
    }
  };
  for (const WorkGroup& group : data.groups) {
    for (const std::string& scene : group.scenes) {
      for (const std::string& model : work_models) {
        for (const std::string& series : data.series(model)) {
          add(scene, series, model, false);
          if (series == "rk4 shooting") add(scene, series, model, true);
        }
      }
    }
  }
  return table.csv({machine_line(), "Cheapest resolution whose tip error over L is within the target; nan: none is."});
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace

std::vector<const WorkPoint*> WorkData::of(const std::string& scene, const std::string& series,
                                           const std::string& model) const {
  std::vector<const WorkPoint*> list;
  for (const WorkPoint& p : points) {
    if (p.scene == scene && p.series == series && p.model == model) list.push_back(&p);
  }
  return list;
}

std::vector<std::string> WorkData::series(const std::string& model) const {
  std::vector<std::string> list;
  for (const WorkPoint& p : points) {
    if (p.model == model) add_once(list, p.series);
  }
  return list;
}

std::vector<std::string> WorkData::labels(const std::string& series, const std::string& model,
                                          const std::vector<std::string>& scenes) const {
  std::vector<std::string> list;
  for (const std::string& scene : scenes) {
    for (const WorkPoint* p : of(scene, series, model)) add_once(list, p->label);
  }
  return list;
}

double time_to_us(const WorkData& data, const std::string& scene, const std::string& series, const std::string& model,
                  double target, bool warm) {
  double best = std::numeric_limits<double>::quiet_NaN();
  for (const WorkPoint* p : data.of(scene, series, model)) {
    const std::optional<Timing>& time = warm ? p->warm : p->time;
    if (p->converged() && p->error <= target && time) best = std::fmin(best, time->median_us);
  }
  return best;
}

GroupTime group_time(const WorkData& data, const WorkGroup& group, const std::string& series, const std::string& model,
                     double target, bool warm) {
  std::vector<double> times;
  GroupTime result;
  for (const std::string& scene : group.scenes) {
    const std::vector<const WorkPoint*> points = data.of(scene, series, model);
    if (!points.empty() && points.front()->status != "unsupported") ++result.tried;
    const double time = time_to_us(data, scene, series, model, target, warm);
    if (std::isfinite(time)) times.push_back(time);
  }
  result.median_us = median(times);
  result.reached = static_cast<int>(times.size());
  return result;
}

std::map<std::string, std::string> work_precision_tables(const WorkData& data) {
  return {{"accuracy.csv", accuracy_csv(data)},
          {"timing.csv", timing_csv(data)},
          {"timing_to_accuracy.csv", time_to_csv(data)}};
}

}  // namespace studies
