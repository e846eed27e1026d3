// fam-studies study1: reads studies/cases/study1/{P,S}{1..8}_{follower,fixed}.json, solves each with the methods below,
// writes tips.csv, differences.csv, summary.csv, shapes.csv, pictures and README.md (study1_page.cpp), timing.csv and
// timing.md to results/study1. Some ten seconds.
#include "studies/scenes/cases.h"
#include "studies/study.h"

#include "studies/compare/error_measures.h"
#include "studies/compare/stopwatch.h"
#include "studies/methods/exact_method.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/fem_method.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"
#include "studies/study1/page.h"

#include <map>

namespace studies {
namespace {

using Eigen::Vector3d;

fam::Options fam_options(fam::Law law, int arcs, fam::RodModel model,
                         fam::TwistOrder order = fam::TwistOrder::bend_twist) {
  fam::Options options;
  options.law = law;
  options.arcs = arcs;
  options.model = model;
  options.twist_order = order;
  return options;
}

fem_reference::Options fem_options(fem_reference::RodModel model) {
  fem_reference::Options options;
  options.model = model;
  return options;
}

// The competitors, by the name that the CSV files use.
std::map<std::string, std::unique_ptr<Method>> competitors() {
  using fam::Law, fam::TwistOrder;
  constexpr auto kirchhoff = fam::RodModel::kirchhoff;
  std::map<std::string, std::unique_ptr<Method>> methods;
  methods["fam_published_12"] = fam_method(fam_options(Law::published, 12, kirchhoff));
  methods["fam_published_12_twist_bend"] =
      fam_method(fam_options(Law::published, 12, kirchhoff, TwistOrder::twist_bend));
  methods["fam_published_50"] = fam_method(fam_options(Law::published, 50, kirchhoff));
  methods["fam_fourth_order_50"] = fam_method(fam_options(Law::fourth_order, 50, kirchhoff));
  methods["fam_sixth_order_12"] = fam_method(fam_options(Law::sixth_order, 12, kirchhoff));
  methods["fam_fourth_order_50_reissner"] = fam_method(fam_options(Law::fourth_order, 50, fam::RodModel::reissner));
  methods["fe"] = fem_method(fem_options(fem_reference::RodModel::reissner));
  methods["exact"] = exact_method({});
  exact_reference::Options exact_kirchhoff;
  exact_kirchhoff.model = exact_reference::RodModel::kirchhoff;
  methods["exact_kirchhoff"] = exact_method(exact_kirchhoff);
  methods["fe_kirchhoff"] = fem_method(fem_options(fem_reference::RodModel::kirchhoff));
  return methods;
}

class Study1 {
 public:
  explicit Study1(const StudyOptions& options)
      : options_(options),
        folder_(options.output / "study1"),
        methods_(competitors()),
        progress_("study1", 32, options.progress) {}

  void run() {
    for (const std::string frame : {"follower", "fixed"}) {
      for (const std::string& load_case : study1_cases()) solve_case(load_case, frame);
    }
    write();
  }

 private:
  void solve_case(const std::string& load_case, const std::string& frame) {
    progress_.step(load_case + " " + frame);
    const scene::Scene scene = read_case(options_.cases, "study1/" + load_case + "_" + frame);
    std::map<std::string, scene::Equilibrium> results;
    for (const auto& [name, method] : methods_) {
      const scene::Equilibrium& result = results[name] = method->solve(scene);
      record_tip(load_case, frame, name, result);
      if (result.converged()) {
        record_shape(load_case, frame, name, result);
        record_time(load_case, frame, name, *method, scene);
      }
    }
    for (const auto& [a, b] : study1_pairs()) record_difference(load_case, frame, a, b, results[a], results[b]);
  }

  void record_tip(const std::string& load_case, const std::string& frame, const std::string& name,
                  const scene::Equilibrium& result) {
    data_.tips.push_back({load_case, frame, name, scene::name(result.status), {}});
    if (result.converged()) data_.tips.back().position_mm = result.tip().position_B_mm;
  }

  void record_shape(const std::string& load_case, const std::string& frame, const std::string& name,
                    const scene::Equilibrium& result) {
    if (name != "fam_published_12" && name != "fe") return;
    Study1Shape shape{load_case, frame, name, {}};
    for (int s_mm = 0; s_mm <= 40; ++s_mm) shape.positions_mm.push_back(position_at_mm(result, s_mm));
    data_.shapes.push_back(std::move(shape));
  }

  void record_difference(const std::string& load_case, const std::string& frame, const std::string& a,
                         const std::string& b, const scene::Equilibrium& of_a, const scene::Equilibrium& of_b) {
    if (!of_a.converged() || !of_b.converged()) return;
    const ShapeDifference shape = shape_difference(of_a, of_b);
    data_.differences.push_back(
        {load_case, frame, a, b, of_a.tip().position_B_mm - of_b.tip().position_B_mm, shape.largest_mm, shape.rms_mm});
  }

  void record_time(const std::string& load_case, const std::string& frame, const std::string& name,
                   const Method& method, const scene::Scene& scene) {
    data_.times.push_back({load_case, frame, name, time_of(options_, method.bare_solve(scene))});
  }

  void write() const {
    const std::map<std::string, std::string> files = study1_files(data_);
    write_results(folder_, "fam-studies study1", files);
  }

  StudyOptions options_;
  std::filesystem::path folder_;
  std::map<std::string, std::unique_ptr<Method>> methods_;
  Study1Data data_;
  Progress progress_;
};

}  // namespace

void study1(const StudyOptions& options) {
  Study1(options).run();
}

}  // namespace studies
