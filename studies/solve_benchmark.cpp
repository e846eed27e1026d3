// Google Benchmark of the solves of Study I: build/release/bin/solve_benchmark --benchmark_repetitions=9
// --benchmark_report_aggregates_only=true prints medians and spread. Not a test: machines are shared.
#include "scene/scene_file.h"
#include "studies/fam_method.h"
#include "studies/fem_method.h"

#include <benchmark/benchmark.h>

namespace {

void bare_solve(benchmark::State& state, const studies::Method& method, const std::string& case_name) {
  const auto solve = method.bare_solve(scene::read_scene_file(STUDY_CASES_DIR "/" + case_name + ".json"));
  while (state.KeepRunning()) solve();
}

void add(const std::string& name, const std::shared_ptr<studies::Method>& method, benchmark::TimeUnit unit) {
  for (const char* case_name : {"P2_follower", "P2_fixed", "P4_follower", "S4_follower", "S4_fixed"}) {
    benchmark::RegisterBenchmark((name + "/" + case_name).c_str(), [method, case_name](benchmark::State& state) {
      bare_solve(state, *method, case_name);
    })->Unit(unit);
  }
}

}  // namespace

int main(int argc, char** argv) {
  using fam::Law;
  for (const Law law : {Law::published, Law::midpoint, Law::fourth_order}) {
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
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
