// What the work-precision study measured; its tables, pictures and page are pure functions of it.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/report/page.h"
#include "studies/work_precision/aims.h"
#include "studies/work_precision/random_races.h"

#include <filesystem>
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
  bool unsupported() const { return status == "unsupported"; }
};

// What the tables and pictures tell apart: the studies' scenes whose loads all turn with the rod, their others, and
// robots (studies/cases/robots) under whatever loads they have.
enum class WorkGroup { follower, fixed, robots };
inline const std::vector<WorkGroup> work_groups = {WorkGroup::follower, WorkGroup::fixed, WorkGroup::robots};
std::string key(WorkGroup group);    // in CSV files and places of the page: "follower", ...
std::string title(WorkGroup group);  // "Follower loads", ...

struct WorkScene {
  std::string name;
  std::string folder;  // of the scene file in studies/cases
  WorkGroup group = WorkGroup::fixed;
  bool has_tendons = false;
};

// One bare solve, memory and caches warm. `scene` and `folder` as of WorkScene.
struct CountedSolve {
  std::string scene, folder, series, model, resolution;
  double target = 0;        // tip error over L, that it is within
  double instructions = 0;  // NaN where they were not counted
};

struct WorkData {
  std::vector<WorkScene> scenes;
  std::vector<WorkPoint> points;
  std::vector<AimRow> aims;
  std::vector<CountedSolve> counted;  // studies/work_precision/instructions.h
  std::vector<RandomRace> races;

  // The resolutions of a series on a scene, in order of rising effort.
  std::vector<const WorkPoint*> of(const std::string& scene, const std::string& series, const std::string& model) const;
  std::vector<std::string> names(WorkGroup group) const;
  // Resolutions that were tried on any of the scenes, in order of rising effort.
  std::vector<std::string> labels(const std::string& series, const std::string& model,
                                  const std::vector<std::string>& of_scenes) const;
};

inline const std::vector<double> work_targets = {1e-2, 1e-3, 1e-5, 1e-8};  // tip error over L
inline const std::vector<std::string> work_models = {"Kirchhoff", "Reissner"};

constexpr double work_error_floor = 1e-12;  // smaller errors are written as this
std::string work_error_text(double error);  // over L, in CSV files; "–" where it is not finite
constexpr double lost_error = 0.1;          // converged at the finest resolution, but so far away: another equilibrium

std::string target_text(double target);  // "1e-03 L"

// A row of the page's tables and a curve of its pictures: a series, or the faster of two of the same method.
struct Contestant {
  std::string method;  // key in the registry
  std::string model;
  std::vector<std::string> series;

  std::string name() const;
};
const std::vector<Contestant>& contestants();
const Contestant& contestant(const std::string& method);

// Median time, µs, of the cheapest resolution that is within the target on the scene; of FAM's automatic choice, which
// is asked for a tolerance, the time when it is asked for the target. Infinite where none is within it.
double time_to_us(const WorkData& data, const std::string& scene, const std::string& series, const std::string& model,
                  double target, bool warm = false);
double time_to_us(const WorkData& data, const std::string& scene, const Contestant& contestant, double target);

// Quantiles over all scenes; one where the target is not reached counts as infinitely slow.
struct Spread {
  double median = 0, lower = 0, upper = 0;
  int reached = 0, scenes = 0;
};
Spread spread_of(const std::vector<double>& values);
Spread times_to_us(const WorkData& data, WorkGroup group, const Contestant& contestant, double target);
// Time over that of FAM's automatic choice, on the scenes where that reaches the target.
Spread ratios_to_automatic(const WorkData& data, WorkGroup group, const Contestant& contestant, double target);

// On how many scenes each of these is the fastest within the target.
std::vector<int> wins_of(const WorkData& data, WorkGroup group, const std::vector<Contestant>& among, double target);

// File name to content; the tables of the page are Markdown.
std::map<std::string, std::string> work_precision_tables(const WorkData& data);
std::string times_table(const WorkData& data, WorkGroup group);
std::string ratios_table(const WorkData& data, WorkGroup group);
std::string resolutions_table(const WorkData& data, WorkGroup group);
std::string failures_table(const WorkData& data);
std::string aims_table(const WorkData& data);

std::string work_precision_picture(const WorkData& data);
std::string work_precision_page(const WorkData& data, const std::filesystem::path& page_md);
Answers work_precision_answers(const WorkData& data);

}  // namespace studies
