// fam-studies work-precision: reads studies/cases/{P,S}{1..8}_{follower,fixed}.json, study2_gravity_y.json and
// work_precision_*.json, solves each with every method at every resolution, times the solves, and writes tables,
// pictures and pages to results/work_precision. Some three minutes; ten seconds with --quick, which times one scene.
#include "studies/study.h"

#include "exact_reference/solve.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/work_precision/competitors.h"
#include "studies/work_precision/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace studies {
namespace {

const std::string quick_scene = "P1_follower";
const std::vector<std::string> many_meshes = {"S4_fixed", "study2_gravity_y"};
const std::vector<std::string> most_meshes = {"P2_fixed", "S4_follower"};

std::vector<WorkGroup> scene_groups() {
  std::vector<WorkGroup> groups;
  for (const std::string frame : {"follower", "fixed"}) {
    WorkGroup group{"Study I, " + frame + " loads", "study1", {}};
    for (const std::string& load_case : study1_cases()) group.scenes.push_back(fmt::format("{}_{}", load_case, frame));
    groups.push_back(std::move(group));
  }
  groups.push_back({"catheter with gravity", "study2", {"study2_gravity_y"}});
  for (const std::string load : {"10", "100", "1000"}) {
    groups.push_back({"transverse force, F L²/EI = " + load, "work_precision", {"work_precision_load_" + load}});
  }
  groups.push_back({"end moment, a full circle", "work_precision", {"work_precision_moment"}});
  groups.push_back({"torque with a force", "work_precision", {"work_precision_torque"}});
  return groups;
}

FeMeshes meshes_for(const std::string& scene) {
  const auto among = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), scene) != list.end();
  };
  return among(most_meshes) ? FeMeshes::most : among(many_meshes) ? FeMeshes::many : FeMeshes::few;
}

scene::Equilibrium exact_rod(const scene::Scene& scene, const std::string& model) {
  exact_reference::Options options;
  if (model == "Kirchhoff") options.model = exact_reference::RodModel::kirchhoff;
  return exact_reference::solve(scene, options);
}

class WorkPrecision {
 public:
  explicit WorkPrecision(const StudyOptions& options)
      : options_(options),
        folder_(options.output / "work_precision"),
        progress_("work-precision", 39, options.progress) {}

  void run() {
    data_.groups = scene_groups();
    for (const WorkGroup& group : data_.groups) {
      for (const std::string& scene : group.scenes) solve_scene(group.folder, scene);
    }
    progress_.step("aims");
    data_.aims = measured_aims(options_);
    write();
  }

 private:
  void solve_scene(const std::string& folder, const std::string& name) {
    progress_.step(name);
    const scene::Scene scene = read_case(options_.cases, folder + "/" + name);
    std::map<std::string, scene::Equilibrium> exact;
    for (const std::string& model : work_models) exact[model] = exact_rod(scene, model);
    for (const Competitor& competitor : competitors(meshes_for(name))) {
      WorkPoint point = solved(name, scene, competitor, exact[competitor.model]);
      if (point.status != "unsupported" && (!options_.quick || name == quick_scene)) {
        take_times(scene, *competitor.method, point);
      }
      data_.points.push_back(std::move(point));
    }
  }

  static WorkPoint solved(const std::string& name, const scene::Scene& scene, const Competitor& competitor,
                          const scene::Equilibrium& exact) {
    const scene::Equilibrium result = competitor.method->solve(scene);
    const double length_mm = scene::length_mm(scene);
    WorkPoint point;
    point.scene = name;
    point.series = competitor.series;
    point.model = competitor.model;
    point.resolution = competitor.resolution;
    point.label = competitor.label;
    point.status = scene::name(result.status);
    point.reference_error = exact.error_estimate_mm / length_mm;
    point.error = result.converged() ? (result.tip().position_B_mm - exact.tip().position_B_mm).norm() / length_mm
                                     : std::numeric_limits<double>::quiet_NaN();
    return point;
  }

  void take_times(const scene::Scene& scene, const Method& method, WorkPoint& point) const {
    point.time = time_of(options_, method.bare_solve(scene), 0.008);
    const std::function<void()> warm = method.warm_solve(scene);
    if (warm) point.warm = time_of(options_, warm, 0.008);
  }

  void write() const {
    std::map<std::string, std::string> files = work_precision_tables(data_);
    files.merge(work_precision_pictures(data_));
    files["README.md"] = work_precision_page(data_);
    files["headline.md"] = work_precision_headline(data_);
    files["timing.md"] = work_precision_timing_page(data_);
    write_results(folder_, "fam-studies work-precision", files);
  }

  StudyOptions options_;
  std::filesystem::path folder_;
  WorkData data_;
  Progress progress_;
};

}  // namespace

void work_precision(const StudyOptions& options) {
  WorkPrecision(options).run();
}

}  // namespace studies
