// fam-studies study1: reads studies/cases/study1/{P,S}{1..8}_{follower,fixed}.json, solves each with the methods of
// study1_groups(), compares them pair by pair and writes results/study1.
#include "studies/compare/error_measures.h"
#include "studies/report/provenance.h"
#include "studies/study.h"
#include "studies/study1/page.h"

namespace studies {
namespace {

class Study1 {
 public:
  explicit Study1(const StudyOptions& options)
      : options_(options), progress_("study1", 2 * study1_cases().size() * study1_groups().size(), options.progress) {}

  void run() {
    for (const Study1Group& group : study1_groups()) {
      for (const std::string frame : {"follower", "fixed"}) {
        for (const std::string& load_case : study1_cases()) solve_case(group, load_case, frame);
      }
    }
    write_results(options_.output / "study1", "fam-studies study1",
                  study1_files(data_, options_.pages / "study1" / "page.md"));
  }

 private:
  void solve_case(const Study1Group& group, const std::string& load_case, const std::string& frame) {
    const std::string name = load_case + "_" + frame;
    progress_.step(load_case + " " + frame);
    const scene::Scene scene = read_case(options_.cases, "study1/" + name);
    data_.length_mm = scene::length_mm(scene);
    auto& results = results_[name];
    for (const Study1Method& m : group.methods) {
      const std::unique_ptr<Method> method = method_row(m.row)(m.request);
      const scene::Equilibrium& result = results[m.key] = method->solve(scene);
      data_.tips.push_back({load_case, frame, m.key, scene::name(result.status), {}});
      if (!result.converged()) continue;
      data_.tips.back().position_mm = result.tip().position_B_mm;
      record_shape(load_case, frame, m.key, result);
      data_.times.push_back({load_case, frame, m.key, time_of(options_, method->bare_solve(scene))});
    }
    for (const auto& [a, b] : group.pairs) record_difference(load_case, frame, a, b, results.at(a), results.at(b));
  }

  void record_shape(const std::string& load_case, const std::string& frame, const std::string& method,
                    const scene::Equilibrium& result) {
    if (method != fam12 && method != "fe") return;
    Study1Shape shape{load_case, frame, method, {}};
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

  StudyOptions options_;
  std::map<std::string, std::map<std::string, scene::Equilibrium>> results_;  // by case and frame, by method
  Study1Data data_;
  Progress progress_;
};

}  // namespace

void study1(const StudyOptions& options) {
  Study1(options).run();
}

}  // namespace studies
