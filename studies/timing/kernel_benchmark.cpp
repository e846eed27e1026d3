// Google Benchmark of what a solve is made of, in space and in the plane:
//   build/release/bin/kernel_benchmark --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
// ./reproduce keeps the medians in results/work_precision/timing_kernels.csv. Not a test: machines are shared.
#include "fam/boundary_value.h"
#include "fam/march.h"
#include "fam/solve.h"
#include "fam/solver.h"
#include "scene/scene_file.h"

#include <benchmark/benchmark.h>

namespace {

using fam::Law, fam::RodModel;

std::vector<scene::Span> spans_of(const std::string& case_name) {
  return scene::spans_of(scene::read_scene_file(STUDY_CASES_DIR "/" + case_name + ".json"));
}

template <int D>
std::string kernel() {
  return D == 2 ? "planar" : "spatial";
}

template <int D>
void exponential() {
  benchmark::RegisterBenchmark(("exponential/" + kernel<D>()).c_str(), [](benchmark::State& state) {
    fam::BasicScrew<double, D> screw;
    screw.rotation.setConstant(0.1);
    screw.translation_mm.setConstant(1);
    while (state.KeepRunning()) {
      benchmark::DoNotOptimize(screw);
      benchmark::DoNotOptimize(fam::exponential(screw));
    }
  });
}

template <int D>
void march(const std::string& what, const std::string& case_name, Law law, RodModel model, int arcs) {
  const std::string name = "march/" + what + "/" + fam::name(law) + "/" + kernel<D>() + "/" + std::to_string(arcs);
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const std::vector<scene::Span> spans = spans_of(case_name);
    const std::vector<int> counts = scene::cells_per_span(spans, arcs);
    fam::BasicMarch<D> solver;
    solver.set(spans, counts, law, model);
    while (state.KeepRunning()) {
      if (solver.run() != scene::Status::converged) state.SkipWithError("not converged");
    }
  });
}

template <int D>
void boundary_value(const std::string& case_name, int arcs) {
  const std::string name = "boundary_value/" + case_name + "/" + kernel<D>() + "/" + std::to_string(arcs);
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const std::vector<scene::Span> spans = spans_of(case_name);
    const fam::GrowingLoads loads(spans);
    fam::BasicBoundaryValue<D> solver;
    solver.set(loads.way(), scene::cells_per_span(spans, arcs), Law::sixth_order, RodModel::kirchhoff);
    while (state.KeepRunning()) {
      if (solver.run() != scene::Status::converged) state.SkipWithError("not converged");
    }
    state.SetLabel(std::to_string(solver.newton_steps()) + " Newton iterations");
  });
}

// A kept solver from no load; then also its compliance at the tip and the derivatives by all loads there.
void cold_solve(const std::string& case_name, bool with_derivatives) {
  const std::string name = std::string(with_derivatives ? "solve_and_differentiate/" : "solve/") + case_name;
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const scene::Scene scene = scene::read_scene_file(STUDY_CASES_DIR "/" + case_name + ".json");
    fam::Options options;
    options.tolerance_mm = 1e-4 * scene::length_mm(scene);
    auto made = fam::Solver::make(scene, options);
    fam::Solver& solver = std::get<fam::Solver>(made);
    const double tip_mm = scene::length_mm(scene);
    while (state.KeepRunning()) {
      if (!solver.solve(fam::Solver::Start::unloaded).converged()) state.SkipWithError("not converged");
      if (!with_derivatives) continue;
      benchmark::DoNotOptimize(solver.compliance(tip_mm));
      for (std::size_t i = 0; i < scene.loads.size(); ++i) benchmark::DoNotOptimize(solver.by_load(i, tip_mm));
    }
    state.SetLabel(std::to_string(solver.s_mm().size() - 1) + " arcs");
  });
}

// fam::solve for clamp and tip, to the same tolerance: choice, memory, two resolutions, stability.
void one_shot(const std::string& case_name) {
  benchmark::RegisterBenchmark(("one_shot/" + case_name).c_str(), [=](benchmark::State& state) {
    const scene::Scene scene = scene::read_scene_file(STUDY_CASES_DIR "/" + case_name + ".json");
    fam::Options options;
    options.tolerance_mm = 1e-4 * scene::length_mm(scene);
    options.whole_rod = false;
    while (state.KeepRunning()) {
      if (!fam::solve(scene, options).converged()) state.SkipWithError("not converged");
    }
  });
}

template <int below, int above>
void band(const std::string& name, int size) {
  benchmark::RegisterBenchmark(("band_solver/" + name + "/" + std::to_string(size)).c_str(),
                               [=](benchmark::State& state) {
                                 fam::BandSystem<below, above> system;
                                 system.resize(size);
                                 while (state.KeepRunning()) {
                                   system.set_zero();
                                   for (int i = 0; i < size; ++i) {
                                     for (int j = std::max(0, i - below); j <= std::min(size - 1, i + above); ++j)
                                       system(i, j) = 1.0 / (1 + i + j);
                                     system(i, i) += 2;
                                     system.right()[i] = 1;
                                   }
                                   benchmark::DoNotOptimize(system.factorise());
                                   system.substitute();
                                 }
                               });
}

}  // namespace

int main(int argc, char** argv) {
  exponential<2>();
  exponential<3>();
  for (const int arcs : {1, 12}) {
    for (const Law law : fam::all_laws()) {
      if (!fam::facts_of(law).coupled) {
        march<3>("kirchhoff", "study1/S4_follower", law, RodModel::kirchhoff, arcs);
        continue;
      }
      march<2>("kirchhoff", "study1/P4_follower", law, RodModel::kirchhoff, arcs);
      march<3>("kirchhoff", "study1/S4_follower", law, RodModel::kirchhoff, arcs);
      march<2>("reissner", "study1/P4_follower", law, RodModel::reissner, arcs);
      march<3>("reissner", "study1/S4_follower", law, RodModel::reissner, arcs);
    }
  }
  for (const int arcs : {3, 12}) {
    boundary_value<2>("study1/P2_fixed", arcs);
    boundary_value<3>("study1/P2_fixed", arcs);
    boundary_value<3>("study1/S4_fixed", arcs);
    boundary_value<2>("work_precision/work_precision_load_10", arcs);
  }
  for (const char* name :
       {"study1/S4_follower", "study1/P4_follower", "study1/S4_fixed", "study1/P2_fixed", "stream/catheter"}) {
    cold_solve(name, false);
    cold_solve(name, true);
    one_shot(name);
  }
  band<4, 6>("planar", 33);
  band<11, 14>("spatial", 75);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
