// fam-studies work-precision: the 16 cases of Study I in both frames, Study II with gravity,
// studies/cases/work_precision and studies/cases/robots, each solved by every method at every resolution and timed; and
// 1000 random scenes by two. Some six minutes; with --quick one scene is timed.
#include "studies/study.h"

#include "exact_reference/solve.h"
#include "scene/load_visitor.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/work_precision/competitors.h"
#include "studies/work_precision/data.h"
#include "studies/work_precision/instructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace studies {
namespace {

const std::string quick_scene = "P1_follower", robots = "robots";
const std::vector<std::string> many_meshes = {"S4_fixed", "study2_gravity_y"};
const std::vector<std::string> most_meshes = {"P2_fixed", "S4_follower"};

std::vector<WorkScene> work_scenes(const std::filesystem::path& cases) {
  std::vector<WorkScene> scenes;
  for (const std::string frame : {"follower", "fixed"}) {
    for (const std::string& load_case : study1_cases())
      scenes.push_back({fmt::format("{}_{}", load_case, frame), "study1"});
  }
  scenes.push_back({"study2_gravity_y", "study2"});
  for (const std::string name : {"load_10", "load_100", "load_1000", "moment", "torque"}) {
    scenes.push_back({"work_precision_" + name, "work_precision"});
  }
  for (const std::string& name : cases_in(cases, robots)) scenes.push_back({name, robots});
  return scenes;
}

bool follows(const scene::Load& load) {
  return std::visit(
      [](const auto& l) {
        if constexpr (requires { l.frame; }) return l.frame == scene::Frame::follower;
        else return std::is_same_v<std::decay_t<decltype(l)>, scene::Tendon>;
      },
      load);
}

WorkGroup group_of(const std::string& folder, const scene::Scene& scene) {
  if (folder == robots) return WorkGroup::robots;
  return std::all_of(scene.loads.begin(), scene.loads.end(), follows) ? WorkGroup::follower : WorkGroup::fixed;
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
        data_{work_scenes(options.cases), {}, {}, {}, {}},
        progress_("work-precision", data_.scenes.size() + 3, options.progress) {}

  void run() {
    for (WorkScene& scene : data_.scenes) solve_scene(scene);
    progress_.step("aims");
    data_.aims = measured_aims(options_);
    progress_.step("random scenes");
    data_.races = random_races(options_);
    progress_.step("instructions");
    if (!options_.quick) {
      data_.counted = counted_solves(data_);
      count_instructions(data_.races);
    }
    write();
  }

 private:
  void solve_scene(WorkScene& of_study) {
    const std::string& name = of_study.name;
    progress_.step(name);
    const scene::Scene scene = read_case(options_.cases, of_study.folder + "/" + name);
    of_study.group = group_of(of_study.folder, scene);
    of_study.has_tendons = std::any_of(scene.loads.begin(), scene.loads.end(), scene::tendon_of);
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
    files["timing_overview.svg"] = work_precision_picture(data_);
    files["timing_random.svg"] = races_picture(data_.races);
    files["README.md"] = work_precision_page(data_, options_.pages / "work_precision/page.md");
    files[answers_file] = answers_json(work_precision_answers(data_));
    write_results(options_.output / "work_precision", "fam-studies work-precision", files);
  }

  StudyOptions options_;
  WorkData data_;
  Progress progress_;
};

}  // namespace

void work_precision(const StudyOptions& options) {
  WorkPrecision(options).run();
}

}  // namespace studies
