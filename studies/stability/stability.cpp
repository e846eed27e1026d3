// fam-studies stability: solves the scenes of maps.h by every method, judges each answer against the exact rod, and
// writes maps, tables, the smallest breaking scenes and a page to results/stability.
#include "studies/study.h"

#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "scene/scene_file.h"
#include "scene/span_facts.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"
#include "studies/stability/data.h"
#include "studies/stability/folds.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

using exact_reference::RodModel;

double tip_distance(const scene::Equilibrium& a, const scene::Equilibrium& b, double length_mm) {
  return (a.tip().position_B_mm - b.tip().position_B_mm).norm() / length_mm;
}

// The exact tip, and how far what checks it lies from it; NaN: nothing to check it by.
struct Truth {
  scene::Equilibrium tip;
  double check = NAN;
  bool closed_form = false;
};

scene::Equilibrium marched(const scene::Scene& scene) {
  fam::Options options;
  options.law = fam::Law::fourth_order;
  options.model = fam::RodModel::reissner;
  options.arcs = 4096;
  options.estimate_error = false;
  return fam::solve(scene, options);
}

// By FAM's march from the tip in 4096 arcs, the fixed loads turned with the tip that multiple shooting found. Where a
// turn of the tip by 1e-12 rad moves the march's end by more than 1e-6 L, it cannot tell: NaN.
double check_by_march(const scene::Scene& scene, const scene::Equilibrium& found) {
  const double length_mm = scene::length_mm(scene);
  scene::Equilibrium nudged = found;
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 1, 1).normalized();
  nudged.stations.back().X_BS.rotation_BS *= Eigen::AngleAxisd(1e-12, axis).toRotationMatrix();
  const std::optional<scene::Scene> turned = turned_to_follower(scene, found);
  if (!turned) return NAN;
  const scene::Equilibrium march = marched(*turned), beside = marched(*turned_to_follower(scene, nudged));
  if (!march.converged() || !beside.converged() || tip_distance(march, beside, length_mm) > 1e-6) return NAN;
  return tip_distance(march, found, length_mm);
}

Truth truth_of(const StabilityMap& map, double x, double y) {
  const scene::Scene scene = map.scene(x, y);
  Truth truth{exact_reference::solve(scene, {RodModel::reissner, 1e-12}), NAN, false};
  const std::optional<Eigen::Vector3d> closed_form = map.closed_form(x, y);
  if (closed_form) {
    scene::Equilibrium exact = truth.tip;  // for its stability
    exact.status = scene::Status::converged;
    exact.stations = {{scene::length_mm(scene), {Eigen::Matrix3d::Identity(), *closed_form}}};
    truth.closed_form = true;
    if (truth.tip.converged()) truth.check = tip_distance(truth.tip, exact, scene::length_mm(scene));
    truth.tip = exact;
  } else if (truth.tip.converged()) {
    truth.check = check_by_march(scene, truth.tip);
  }
  return truth;
}

class Stability {
 public:
  explicit Stability(const StudyOptions& options)
      : options_(options), progress_("stability", stability_maps().size(), options.progress) {
    data_.maps = stability_maps();
    for (const Contender& contender : contenders()) data_.methods.push_back(contender.key);
  }

  void run() {
    for (const StabilityMap& map : data_.maps) fill(map);
    measure_sensitivity();
    collect_breaking_scenes();
    write();
  }

 private:
  void fill(const StabilityMap& map) {
    progress_.step(map.name);
    ReferenceCheck check{map.name, 0, 0, 0, 0, 0, 0};
    for (const double x : map.x.values) {
      Truth truth;
      for (const double y : map.y.values) {
        // With the resolution on the y axis the scene is the same in the whole column.
        if (!map.y_is_cells || y == map.y.values.front()) {
          truth = checked_truth(map, x, y, check);
          add_index(map, x, y, truth.tip);
        }
        for (const Contender& contender : contenders()) ask(map, contender, x, y, truth.tip);
      }
    }
    data_.checks.push_back(check);
  }

  static Truth checked_truth(const StabilityMap& map, double x, double y, ReferenceCheck& check) {
    Truth truth = truth_of(map, x, y);
    ++check.scenes;
    if (!truth.tip.converged()) {
      ++check.unsolved;
    } else if (std::isnan(truth.check)) {
      ++check.unchecked;
    } else {
      ++(truth.closed_form ? check.by_closed_form : check.by_march);
      check.largest_difference = std::max(check.largest_difference, truth.check);
    }
    return truth;
  }

  void add_index(const StabilityMap& map, double x, double y, const scene::Equilibrium& truth) {
    if (!truth.converged() || !scene::is_conservative(scene::spans_of(map.scene(x, y)))) return;
    ExactIndex index{map.name, x, y, std::nullopt};
    for (const auto& [name, value] : truth.model) {
      if (name == "falling_directions") index.falling = std::get<int>(value);
    }
    data_.indices.push_back(index);
  }

  void ask(const StabilityMap& map, const Contender& contender, double x, double y, const scene::Equilibrium& truth) {
    const int cells = contender.automatic() ? 0 : map.y_is_cells ? static_cast<int>(y) : contender.fixed_cells;
    if (cells > contender.most_cells || x > contender.largest_x || !truth.converged()) return;
    if (contender.automatic() && map.y_is_cells && y != map.y.values.front()) return;
    if (cells == 0 && !contender.automatic()) return;
    if ((map.name == "precision" || !contender.only_in.empty()) && contender.only_in != map.name) return;
    const scene::Scene scene = map.scene(x, y);
    const scene::Equilibrium answer = contender.solve(scene, cells);
    const auto refined = [&] { return contender.solve(scene, 4 * cells); };
    const Judgement judgement = judge(answer, truth, scene::length_mm(scene), refined);
    data_.cells.push_back(
        {map.name, contender.key, x, y, cells, judgement, scene::name(answer.status), answer.message, answer.stable});
  }

  // The tip's direction under a fixed transverse force, turned by 1e-8 rad and marched to the clamp.
  void measure_sensitivity() {
    const StabilityMap& fixed = data_.map_named("fixed");
    for (const double load : {1.0, 10.0, 30.0, 100.0, 200.0}) {
      constexpr double nudge_rad = 1e-8;
      const scene::Scene scene = fixed.scene(load, 0);
      scene::Equilibrium found = exact_reference::solve(scene, {RodModel::kirchhoff, 1e-12});
      const auto angle_rad = [&] { return marched(*turned_to_follower(scene, found)).tip_angle_rad; };
      const double before_rad = angle_rad();
      found.stations.back().X_BS.rotation_BS *=
          Eigen::AngleAxisd(nudge_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      data_.sensitivities.push_back({load, std::abs(angle_rad() - before_rad) / nudge_rad});
    }
  }

  // Of each method: the first silent answer, else the first that failed or was flagged, in the order of the maps, of
  // the loads and of the cells.
  void collect_breaking_scenes() {
    for (const Contender& contender : contenders()) {
      if (!contender.only_in.empty()) continue;
      const StabilityCell* worst = nullptr;
      const auto rank = [](Verdict v) { return is_silent(v) ? 3 : v == Verdict::flagged ? 1 : 2; };
      for (const StabilityCell& cell : data_.cells) {
        const Verdict verdict = cell.judgement.verdict;
        if (cell.method != contender.key || is_right(verdict) || verdict == Verdict::unsupported) continue;
        if (worst == nullptr || rank(verdict) > rank(worst->judgement.verdict)) worst = &cell;
      }
      if (worst != nullptr) data_.breaking.push_back(breaking_scene(contender, *worst));
    }
  }

  BreakingScene breaking_scene(const Contender& contender, const StabilityCell& cell) const {
    const StabilityMap& map = data_.map_named(cell.map);
    std::string name = contender.key;
    std::replace(name.begin(), name.end(), ' ', '_');
    scene::Scene scene = map.scene(cell.x, cell.y);
    scene.title = map.title + ": " + axis_text(cell.x) + (map.y_is_cells ? "" : ", " + axis_text(cell.y));
    const std::string place = cell.map + " at " + axis_text(cell.x) + (map.y_is_cells ? "" : ", " + axis_text(cell.y));
    return {name, place, contender.command(cell.cells), cell, scene};
  }

  void write() const {
    std::map<std::string, std::string> files = stability_tables(data_);
    files.merge(stability_pictures(data_));
    files.merge(fold_files(fold_curves()));
    files["README.md"] = stability_page(data_, options_.pages / "stability/page.md");
    files[answers_file] = answers_json(stability_answers(data_));
    for (const BreakingScene& b : data_.breaking) files["scenes/" + b.name + ".json"] = scene::write_scene(b.scene);
    write_results(options_.output / "stability", "fam-studies stability", files);
  }

  StudyOptions options_;
  StabilityData data_;
  Progress progress_;
};

}  // namespace

void stability(const StudyOptions& options) {
  Stability(options).run();
}

}  // namespace studies
