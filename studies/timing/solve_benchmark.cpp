// Google Benchmark of the solves of Study I and of the work-precision study: build/release/bin/solve_benchmark
// --benchmark_repetitions=9
// --benchmark_report_aggregates_only=true prints medians and spread. Not a test: machines are shared.
#include "scene/scene_file.h"
#include "studies/methods/elastica_method.h"
#include "studies/methods/exact_method.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/fem_method.h"
#include "studies/methods/rk4_method.h"

#include <benchmark/benchmark.h>

namespace {

// A solve that fails is skipped with its reason; one that cannot start warm is not benchmarked warm.
void run(benchmark::State& state, const studies::Method& method, const std::string& case_name, bool warm) {
  const scene::Scene scene = scene::read_scene_file(STUDY_CASES_DIR "/" + case_name + ".json");
  const scene::Equilibrium result = method.solve(scene);
  const auto solve = warm ? method.warm_solve(scene) : method.bare_solve(scene);
  if (!result.converged() || !solve) {
    state.SkipWithError(result.converged() ? "no warm start" : result.message.c_str());
    return;
  }
  while (state.KeepRunning()) solve();
}

void add(const std::string& name, const std::shared_ptr<studies::Method>& method, benchmark::TimeUnit unit,
         bool warm = false) {
  for (const char* case_name : {"study1/P2_follower", "study1/P2_fixed", "study1/P4_follower", "study1/S4_follower",
                                "study1/S4_fixed", "study2/study2_gravity_y", "work_precision/work_precision_load_10",
                                "work_precision/work_precision_load_100", "work_precision/work_precision_load_1000",
                                "work_precision/work_precision_moment", "work_precision/work_precision_torque"}) {
    benchmark::RegisterBenchmark((name + "/" + case_name).c_str(), [method, case_name, warm](benchmark::State& state) {
      run(state, *method, case_name, warm);
    })->Unit(unit);
  }
}

}  // namespace

int main(int argc, char** argv) {
  using fam::Law;
  for (const fam::Law law : fam::all_laws()) {
    for (const int arcs : {1, 12, 50, 1000}) {
      fam::Options options;
      options.law = law;
      options.arcs = arcs;
      options.model = fam::RodModel::kirchhoff;
      add(std::string("fam/") + fam::name(law) + "/" + std::to_string(arcs), studies::fam_method(options),
          benchmark::kMicrosecond);
    }
  }
  add("fam/automatic", studies::fam_method({}), benchmark::kMicrosecond);
  for (const int elements : {50, 200}) {
    fem_reference::Options options;
    options.elements = elements;
    add("fem/quadratic/" + std::to_string(elements), studies::fem_method(options), benchmark::kMillisecond);
  }
  for (const int steps : {16, 64}) {
    const std::shared_ptr<studies::Method> shooting = studies::rk4_method({steps, true});
    add("rk4_shooting/" + std::to_string(steps), shooting, benchmark::kMicrosecond);
    add("rk4_shooting_warm/" + std::to_string(steps), shooting, benchmark::kMicrosecond, true);
  }
  add("exact_reference", studies::exact_method({}), benchmark::kMicrosecond);
  add("closed_form", studies::elastica_method(), benchmark::kMicrosecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
