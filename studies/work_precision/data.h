// What the work-precision study measured; its tables, pictures and pages are pure functions of it.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/work_precision/aims.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace studies {

// A method at one resolution on one scene. Errors are tip errors over the rod's length L, against the exact rod of the
// method's own model.
struct WorkPoint {
  std::string scene, series, model, resolution, label;
  std::string status;
  double error = 0;            // NaN where it did not converge
  double reference_error = 0;  // the exact rod's own, as it estimates it
  std::optional<Timing> time;  // of the bare solve; of a failing one, until it gives up
  std::optional<Timing> warm;

  bool converged() const { return status == "converged"; }
};

struct WorkGroup {
  std::string name;
  std::string folder;  // of the scene files in studies/cases
  std::vector<std::string> scenes;
};

struct WorkData {
  std::vector<AimRow> aims;
  std::vector<WorkGroup> groups;
  std::vector<WorkPoint> points;

  std::vector<const WorkPoint*> of(const std::string& scene, const std::string& series, const std::string& model) const;
  std::vector<std::string> series(const std::string& model) const;  // in the order of the competitors
  std::vector<std::string> labels(const std::string& series, const std::string& model,
                                  const std::vector<std::string>& scenes) const;  // resolutions, rising effort
};

inline const std::vector<double> work_targets = {1e-2, 1e-3, 1e-5, 1e-8};  // tip error over L
inline const std::vector<std::string> work_models = {"Kirchhoff", "Reissner"};

constexpr double work_error_floor = 1e-12;  // smaller errors are written as this
constexpr double lost_error = 0.1;          // converged, but so far away: another equilibrium

// Median time, µs, of the cheapest resolution that is within the target on the scene; NaN where none is.
double time_to_us(const WorkData& data, const std::string& scene, const std::string& series, const std::string& model,
                  double target, bool warm = false);

// Median over the scenes of a group of time_to_us, over those that reach the target.
struct GroupTime {
  double median_us = 0;  // NaN where none reaches it
  int reached = 0;
  int tried = 0;  // and not refused
};
GroupTime group_time(const WorkData& data, const WorkGroup& group, const std::string& series, const std::string& model,
                     double target, bool warm = false);

// File name to content.
std::map<std::string, std::string> work_precision_tables(const WorkData& data);
std::map<std::string, std::string> work_precision_pictures(const WorkData& data);
std::string work_precision_page(const WorkData& data);
std::string work_precision_headline(const WorkData& data);
std::string work_precision_timing_page(const WorkData& data);

}  // namespace studies
