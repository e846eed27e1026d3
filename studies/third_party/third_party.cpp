// fam-studies third-party: the scenes of studies/cases/third_party by CalculiX with more and more elements, beside FAM,
// our finite elements and the exact reference. Moments in space first: where CalculiX's do not keep their axis, the
// scenes that have one are named and left out.
#include "studies/compare/data_file.h"
#include "studies/methods/registry.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/study.h"
#include "studies/third_party/data.h"

namespace studies {
namespace {

class ThirdParty {
 public:
  explicit ThirdParty(const StudyOptions& options) : options_(options) {
    data_.has_calculix = calculix_is_there();
    names_ = cases_in(options.cases, "third_party");
  }

  void run() {
    compare_moments();
    Progress progress("third-party", names_.size(), options_.progress);
    for (const std::string& name : names_) {
      progress.step(name);
      if (name != small_moment) solve_case(name);
    }
    read_abaqus();
    write_results(options_.output / "third_party", "fam-studies third-party",
                  third_party_files(data_, options_.pages / "third_party" / "page.md"));
  }

 private:
  inline static const std::string small_moment = "moment_small";

  static scene::Equilibrium exact(const scene::Scene& scene) { return method_row("exact")()->solve(scene); }

  // A small moment in space: how far CalculiX is from the exact rod whose moment keeps its axis, and how far that is
  // from the one whose moment follows the section.
  void compare_moments() {
    const scene::Scene fixed = read_case(options_.cases, "third_party/" + small_moment);
    scene::Scene follower = fixed;
    follower.loads = read_case(options_.cases, "third_party/" + small_moment + "_follower").loads;
    const Eigen::Vector3d keeps_axis_mm = exact(fixed).tip().position_B_mm;
    data_.moment_frames_apart_mm = (keeps_axis_mm - exact(follower).tip().position_B_mm).norm();
    if (!data_.has_calculix) return;
    data_.moment_error_mm = (solve_by_calculix(fixed, 20).position_mm - keeps_axis_mm).norm();
  }

  // A moment about more than one axis, or beside forces out of its plane: all of S1 ... S8.
  static bool turns_in_space(const std::string& name) { return name.size() == 2 && name[0] == 'S'; }

  void solve_case(const std::string& name) {
    const scene::Scene scene = read_case(options_.cases, "third_party/" + name);
    if (name == small_moment + "_follower") return;
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
      ThirdPartyTip tip = solve_by_calculix(scene, elements);
      tip.load_case = name;
      add(tip);
    }
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
  ThirdPartyData data_;
};

}  // namespace

void third_party(const StudyOptions& options) {
  ThirdParty(options).run();
}

}  // namespace studies
