// Google Benchmark of fam::Estimator on problems of the study `sensing`: build/release/bin/estimator_benchmark
// --benchmark_repetitions=9 --benchmark_report_aggregates_only=true prints medians and spread. Not a test.
#include "fam/estimator.h"
#include "studies/scenes/sensing_problem.h"

#include <benchmark/benchmark.h>

namespace {

using studies::Sensing;

constexpr int variants = 64;  // of one truth's measurements, noise of the standard deviation on each

scene::EstimationProblem problem_of(Sensing kind, std::uint64_t seed, double noise, int positions) {
  return studies::sensing_problem(kind, seed, noise, STUDY_CASES_DIR, studies::Mismatch::none, positions).estimation;
}

std::vector<scene::EstimationProblem> noisy_problems(const scene::EstimationProblem& exact) {
  studies::Noise noise(7);
  std::vector<scene::EstimationProblem> problems(variants, exact);
  for (scene::EstimationProblem& problem : problems)
    for (scene::MeasuredScene& scene : problem.scenes)
      for (scene::Measurement& measurement : scene.measurements) measurement = studies::noisy(measurement, noise);
  return problems;
}

// An Estimator made and asked once. Ends where one does not converge.
void cold(benchmark::State& state, const scene::EstimationProblem& exact) {
  const auto problems = noisy_problems(exact);
  std::size_t next = 0, iterations = 0;
  for (auto _ : state) {
    const fam::Estimate estimate = fam::Estimator(problems[next++ % variants]).estimate();
    if (!estimate.converged()) return state.SkipWithError(estimate.message.c_str());
    iterations += static_cast<std::size_t>(estimate.iterations);
  }
  state.counters["steps"] = benchmark::Counter(static_cast<double>(iterations), benchmark::Counter::kAvgIterations);
}

// One Estimator that is given the next measurements each time.
void warm(benchmark::State& state, const scene::EstimationProblem& exact) {
  const auto problems = noisy_problems(exact);
  fam::Estimator estimator(exact);
  std::size_t next = 0, iterations = 0;
  for (auto _ : state) {
    const scene::EstimationProblem& problem = problems[next++ % variants];
    for (std::size_t i = 0; i < problem.scenes.size(); ++i)
      for (std::size_t k = 0; k < problem.scenes[i].measurements.size(); ++k)
        estimator.set_measurement(i, k, problem.scenes[i].measurements[k]);
    const fam::Estimate& estimate = estimator.track();
    if (!estimate.converged()) return state.SkipWithError(estimate.message.c_str());
    iterations += static_cast<std::size_t>(estimate.iterations);
  }
  state.counters["steps"] = benchmark::Counter(static_cast<double>(iterations), benchmark::Counter::kAvgIterations);
}

void add(const std::string& name, Sensing kind, double noise, int positions = 4) {
  for (const auto& [way, run] : {std::pair{"/cold", &cold}, std::pair{"/warm", &warm}}) {
    benchmark::RegisterBenchmark((name + way).c_str(), [=, run = run](benchmark::State& state) {
      run(state, problem_of(kind, 1, noise, positions));
    })->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace

int main(int argc, char** argv) {
  add("tip_position", Sensing::four_positions, 0.01, 1);
  add("tip_pose", Sensing::tip_pose, 0.01);
  add("four_positions", Sensing::four_positions, 0.01);
  add("two_contacts", Sensing::two_contacts, 1e-5);
  add("catheter", Sensing::catheter, 0.1);
  add("base_wrench", Sensing::base_wrench, 0.01);
  add("calibration", Sensing::calibration, 0.1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
