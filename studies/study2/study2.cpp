// fam-studies study2: reads studies/cases/study2/study2*.json, solves each with the methods of study2_groups(),
// compares the shapes with the exact one and writes results/study2.
#include "studies/compare/error_measures.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/study.h"
#include "studies/study2/page.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

bool has_station(const scene::Equilibrium& result, double s_mm) {
  const double hair_mm = 1e-9 * result.stations.back().s_mm;
  return std::any_of(result.stations.begin(), result.stations.end(),
                     [&](const scene::Station& station) { return std::abs(station.s_mm - s_mm) < hair_mm; });
}

// The frames that the published law needs: each fixed force as a follower force with the components that it has in the
// section at its place, read off a solution. The forces stand at stations of the solution.
scene::Scene in_section_frames(scene::Scene scene, const scene::Equilibrium& solution) {
  for (scene::Load& load : scene.loads) {
    auto* force = known_load<scene::Force>(load);
    if (!force) continue;
    for (const scene::Station& station : solution.stations) {
      if (std::abs(station.s_mm - force->at_mm) > 1e-9 * force->at_mm) continue;
      force->value_N = station.X_BS.rotation_BS.transpose() * force->value_N;
      force->frame = scene::Frame::follower;
      break;
    }
  }
  return scene;
}

class Study2 {
 public:
  explicit Study2(const StudyOptions& options)
      : options_(options), progress_("study2", study2_scenes.size() * study2_groups().size(), options.progress) {}

  void run() {
    for (const auto& group : study2_groups()) {
      for (const std::string& name : study2_scenes) solve_scene(group, name);
    }
    data_.forces_alone = read("study2");
    data_.with_weight = read("study2_gravity_y");
    write_results(options_.output / "study2", "fam-studies study2",
                  study2_files(data_, options_.pages / "study2" / "page.md"));
  }

 private:
  scene::Scene read(const std::string& name) const { return read_case(options_.cases, "study2/" + name); }

  void solve_scene(const std::vector<Study2Method>& group, const std::string& name) {
    progress_.step(name);
    const scene::Scene scene = read(name);
    const double length_mm = scene::length_mm(scene);
    const scene::Equilibrium exact = method_row("exact")()->solve(scene);
    const auto precise = method_row("fam")({.tolerance = 1e-6 / length_mm});
    const scene::Scene in_frames = in_section_frames(scene, precise->solve(scene));
    for (const Study2Method& m : group) {
      Request request = m.request;
      request.tolerance = m.tolerance_mm / length_mm;
      add(name, m.key, *method_row(m.row)(request), m.section_frames ? in_frames : scene, exact);
    }
  }

  void add(const std::string& name, const std::string& key, const Method& method, const scene::Scene& scene,
           const scene::Equilibrium& exact) {
    const scene::Equilibrium result = method.solve(scene);
    Study2Row row{name, key, scene::name(result.status), {}, {}, {}, false, {}};
    if (result.converged()) {
      for (const scene::Station& station : exact.stations) {
        row.s_mm.push_back(station.s_mm);
        row.positions_mm.push_back(position_at_mm(result, station.s_mm));
        row.errors_mm.push_back((row.positions_mm.back() - station.X_BS.position_B_mm).norm());
        row.interpolated = row.interpolated || !has_station(result, station.s_mm);
      }
      row.timing = time_of(options_, method.bare_solve(scene), 0.1);
    }
    data_.rows.push_back(std::move(row));
  }

  StudyOptions options_;
  Study2Data data_;
  Progress progress_;
};

}  // namespace

void study2(const StudyOptions& options) {
  Study2(options).run();
}

}  // namespace studies
