// fam-studies third-party: the scenes of studies/cases/third_party by CalculiX with more and more elements, beside FAM,
// our finite elements and the exact reference. Moments in space first: CalculiX's do not keep their axis, and the
// scenes that have one are named and left out.
#include "studies/compare/data_file.h"
#include "studies/methods/registry.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/study.h"
#include "studies/third_party/data.h"
#include "studies/third_party/deck.h"

#include <fmt/format.h>

namespace studies {
namespace {

class ThirdParty {
 public:
  explicit ThirdParty(const StudyOptions& options) : options_(options) {
    data_.has_calculix = calculix_is_there();
    names_ = cases_in(options.cases, "third_party");
  }

  void run() {
    read_committed();
    compare_moments();
    if (data_.has_calculix) bend_a_little("small_force_circle", data_.circle_way);
    if (data_.has_calculix) bend_a_little("small_force_tube", data_.tube_way);
    Progress progress("third-party", names_.size(), options_.progress);
    for (const std::string& name : names_) {
      progress.step(name);
      solve_case(name);
    }
    read_abaqus();
    write_results(options_.output / "third_party", "fam-studies third-party",
                  third_party_files(data_, options_.pages / "third_party" / "page.md"));
  }

 private:
  static constexpr int most_quick_elements = 10;  // of 20 and 40, P4_thin takes longest: 15 s

  static scene::Equilibrium exact(const scene::Scene& scene) { return method_row("exact")()->solve(scene); }

  scene::Scene trial(const std::string& name) const { return read_case(options_.cases, "third_party/trials/" + name); }

  // A moment on degree of freedom 5 of the tip's node, beside a force across it, at 0.4 of S1's loads: from the exact
  // rod whose moment keeps its axis, and from the one whose moment follows the section.
  void compare_moments() {
    const scene::Scene fixed = trial("moment_fixed");
    const Eigen::Vector3d keeps_axis_mm = exact(fixed).tip().position_B_mm;
    const Eigen::Vector3d follows_mm = exact(trial("moment_follower")).tip().position_B_mm;
    data_.frames_apart_mm = (keeps_axis_mm - follows_mm).norm();
    if (!data_.has_calculix) return;
    const double moment_Nmm = std::get<scene::Moment>(fixed.loads.back()).value_Nmm[1];
    scene::Scene force_alone = fixed;
    force_alone.loads.pop_back();
    for (std::size_t i = 0; i < 2; ++i) {
      const int elements = i == 0 ? 20 : 40;
      std::string text = deck(force_alone, fixed.title, DeckFormat::calculix, elements);
      text.insert(text.find("*NODE PRINT"), fmt::format("*CLOAD\nTIP, 5, {:.15g}\n", moment_Nmm));
      const Eigen::Vector3d tip_mm = solve_by_calculix(fixed, text, elements).position_mm;
      data_.from_fixed_mm[i] = (tip_mm - keeps_axis_mm).norm();
      data_.from_follower_mm[i] = (tip_mm - follows_mm).norm();
    }
  }

  // The way of the tip by CalculiX over the exact one, without lateral contraction and with it.
  void bend_a_little(const std::string& name, double (&way)[2]) {
    scene::Scene scene = trial(name);
    for (std::size_t i = 0; i < 2; ++i) {
      std::get<scene::CircularSection>(scene.sections[0].cross_section).poissons_ratio = i == 0 ? 0 : 0.3;
      way[i] = solve_by_calculix(scene, 20).position_mm[2] / exact(scene).tip().position_B_mm[2];
    }
  }

  // A moment about more than one axis, or beside forces out of its plane: all of S1 ... S8.
  static bool turns_in_space(const std::string& name) { return name.size() == 2 && name[0] == 'S'; }

  void solve_case(const std::string& name) {
    const scene::Scene scene = read_case(options_.cases, "third_party/" + name);
    const Eigen::Vector3d truth_mm = exact(scene).tip().position_B_mm;
    truths_[name] = truth_mm;
    length_mm_[name] = scene::length_mm(scene);
    for (const std::string key : {"fam", "fe", "exact"}) {
      const std::unique_ptr<Method> method = method_row(key)();
      ThirdPartyTip tip{name, key, 0, "converged"};
      tip.position_mm = method->solve(scene).tip().position_B_mm;
      tip.time_us = time_of(options_, method->bare_solve(scene)).median_us;
      add(tip);
    }
    if (!data_.has_calculix) return;
    if (turns_in_space(name)) return add({name, calculix_key, 0, "left_out"});
    for (const int elements : {5, 10, 20, 40}) {
      const ThirdPartyTip* known = committed_tip(name, elements);
      ThirdPartyTip tip = known ? *known : solve_by_calculix(scene, elements);
      tip.load_case = name;
      add(tip);
    }
  }

  // With --quick the longer runs of CalculiX are those of results/.
  void read_committed() {
    const std::filesystem::path file = options_.committed / "third_party" / "tips.csv";
    if (!options_.quick || !std::filesystem::exists(file)) return;
    for (const DataRow& row : data_rows(file)) {
      ThirdPartyTip tip{row.at("case"), row.at("method"), std::stoi(row.at("elements")), row.at("status")};
      if (tip.method != calculix_key || tip.elements <= most_quick_elements) continue;
      tip.load_share = std::stod(row.at("load_share"));
      if (tip.status == "converged")
        tip.position_mm = {std::stod(row.at("x_mm")), std::stod(row.at("y_mm")), std::stod(row.at("z_mm"))};
      committed_.push_back(tip);
    }
  }

  const ThirdPartyTip* committed_tip(const std::string& name, int elements) const {
    for (const ThirdPartyTip& tip : committed_) {
      if (tip.load_case == name && tip.elements == elements) return &tip;
    }
    return nullptr;
  }

  void add(ThirdPartyTip tip) {
    if (tip.status == "converged")
      tip.error_over_L = (tip.position_mm - truths_.at(tip.load_case)).norm() / length_mm_.at(tip.load_case);
    data_.tips.push_back(std::move(tip));
  }

  // case,elements,x_mm,y_mm,z_mm of somebody who holds Abaqus.
  void read_abaqus() {
    const std::filesystem::path file = options_.committed / "third_party" / "abaqus_tips.csv";
    if (!std::filesystem::exists(file)) return;
    for (const DataRow& row : data_rows(file)) {
      ThirdPartyTip tip{row.at("case"), abaqus_key, std::stoi(row.at("elements")), "converged"};
      if (truths_.count(tip.load_case) == 0) throw scene::SceneError(file.string() + ": no case " + tip.load_case);
      tip.position_mm = {std::stod(row.at("x_mm")), std::stod(row.at("y_mm")), std::stod(row.at("z_mm"))};
      add(tip);
    }
  }

  const StudyOptions& options_;
  std::vector<std::string> names_;
  std::map<std::string, Eigen::Vector3d> truths_;
  std::map<std::string, double> length_mm_;
  std::vector<ThirdPartyTip> committed_;  // of more elements than --quick solves
  ThirdPartyData data_;
};

}  // namespace

void third_party(const StudyOptions& options) {
  ThirdParty(options).run();
}

}  // namespace studies
