// fam-studies study2: reads studies/cases/study2/study2*.json, solves each by the methods below, writes results/study2:
// shapes.csv, errors.csv, pictures, README.md; timing.csv and timing.md apart. A few seconds.
#include "studies/scenes/cases.h"
#include "studies/study.h"

#include "scene/load_visitor.h"
#include "studies/compare/error_measures.h"
#include "studies/methods/exact_method.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/fem_method.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"
#include "studies/study2/page.h"

namespace studies {
namespace {

fam::Options automatic(double tolerance_mm) {
  fam::Options options;
  options.tolerance_mm = tolerance_mm;
  return options;
}

fam::Options published(int arcs) {
  fam::Options options;
  options.law = fam::Law::published;
  options.arcs = arcs;
  return options;
}

// The frames that the published law needs: each fixed force as a follower force with the components that it has in the
// section at its place, read off a solution. The forces stand at stations of the solution.
scene::Scene in_section_frames(scene::Scene scene, const scene::Equilibrium& solution) {
  for (scene::Load& load : scene.loads) {
    const auto turn = [&](scene::Force& force) {
      for (const scene::Station& station : solution.stations) {
        if (std::abs(station.s_mm - force.at_mm) > 1e-9 * force.at_mm) continue;
        force.value_N = station.X_BS.rotation_BS.transpose() * force.value_N;
        force.frame = scene::Frame::follower;
        break;
      }
    };
    scene::visit_load(
        load, turn, [](scene::Moment&) {}, [](scene::DistributedForce&) {}, [](scene::Gravity&) {},
        [](scene::Tendon&) {});
  }
  return scene;
}

class Study2 {
 public:
  explicit Study2(const StudyOptions& options) : options_(options), progress_("study2", 3, options.progress) {}

  void run() {
    for (const char* name : {"study2", "study2_gravity_y", "study2_gravity_z"}) solve_scene(name);
    write_results(options_.output / "study2", "fam-studies study2", study2_files(rows_));
  }

 private:
  void solve_scene(const std::string& name) {
    progress_.step(name);
    const scene::Scene scene = read_case(options_.cases, "study2/" + name);
    const scene::Equilibrium exact = exact_reference::solve(scene);
    exact_reference::Options kirchhoff;
    kirchhoff.model = exact_reference::RodModel::kirchhoff;
    add(name, "exact", *exact_method({}), scene, exact);
    add(name, "exact_kirchhoff", *exact_method(kirchhoff), scene, exact);
    add(name, "fe", *fem_method({}), scene, exact);
    add(name, "fam_1e-3", *fam_method(automatic(1e-3)), scene, exact);
    add(name, "fam_1e-6", *fam_method(automatic(1e-6)), scene, exact);
    const scene::Scene frames = in_section_frames(scene, fam::solve(scene, automatic(1e-6)));
    for (const int arcs : {12, 50}) {
      add(name, "fam_published_" + std::to_string(arcs), *fam_method(published(arcs)), frames, exact);
    }
  }

  void add(const std::string& name, const std::string& method_name, const Method& method, const scene::Scene& scene,
           const scene::Equilibrium& exact) {
    const scene::Equilibrium result = method.solve(scene);
    Study2Row row{name, method_name, scene::name(result.status), {}, {}, {}, {}};
    if (result.converged()) {
      for (const scene::Station& station : exact.stations) {
        row.s_mm.push_back(station.s_mm);
        row.positions_mm.push_back(position_at_mm(result, station.s_mm));
        row.errors_mm.push_back((row.positions_mm.back() - station.X_BS.position_B_mm).norm());
      }
    }
    if (result.converged()) row.timing = measure(method.bare_solve(scene), options_.quick ? 0 : 0.1);
    rows_.push_back(std::move(row));
  }

  StudyOptions options_;
  std::vector<Study2Row> rows_;
  Progress progress_;
};

}  // namespace

void study2(const StudyOptions& options) {
  Study2(options).run();
}

}  // namespace studies
