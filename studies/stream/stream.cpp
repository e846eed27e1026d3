// fam-studies stream: a catheter of studies/cases/stream under gravity, two tendons and a force at its tip, and the
// catheter tube of studies/cases/robots with one tendon and a force at its middle. Their values go along smooth paths
// at 1 kHz for 100 s. A kept solver follows, with its Jacobians at the tip; the exact reference judges every 500th
// solve.
#include "fam/solver.h"
#include "studies/methods/registry.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/stream/data.h"
#include "studies/study.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

namespace studies {
namespace {

constexpr int solves = 100'000, every = 500;
constexpr double solves_per_s = 1000;

// Of as many tendons as there are.
struct Inputs {
  double tensions_N[2];
  Eigen::Vector3d force_N;
};

// Periods of some seconds that never repeat together, as a hand or a heart would drive it.
Inputs catheter_inputs(double t) {
  const double size_N = 0.01 * (1 + std::sin(0.13 * t));
  return {{2 + 2 * std::sin(0.31 * t), 2 + 2 * std::cos(0.47 * t)},
          size_N * Eigen::Vector3d(0.5 * std::sin(0.23 * t), std::cos(0.71 * t), std::sin(0.71 * t))};
}
// A fifth about the values in the scene.
Inputs tube_inputs(double t) {
  return {{0.5 + 0.1 * std::sin(0.31 * t), 0},
          0.02 * Eigen::Vector3d(0, 0.2 * std::cos(0.71 * t), 1 + 0.2 * std::sin(0.23 * t))};
}

struct StreamedRod {
  const char* file;  // of studies/cases
  double tolerance_mm;
  std::vector<std::size_t> tendons;  // the loads' numbers in the scene file
  std::size_t force;
  Inputs (*inputs)(double t);  // 2 pi t: seconds

  Inputs inputs_at(int solve) const { return inputs(2 * std::numbers::pi * solve / solves_per_s); }
  scene::Scene with(scene::Scene scene, const Inputs& values) const {
    for (std::size_t i = 0; i < tendons.size(); ++i)
      known_load<scene::Tendon>(scene.loads[tendons[i]])->tension_N = values.tensions_N[i];
    known_load<scene::Force>(scene.loads[force])->value_N = values.force_N;
    return scene;
  }
};
const StreamedRod streamed_catheter{"stream/catheter", 0.01, {1, 2}, 3, catheter_inputs};
const StreamedRod streamed_tube{"robots/catheter_tube", 0.3, {1}, 2, tube_inputs};

class Stream {
 public:
  Stream(const StreamedRod& rod, const StudyOptions& options)
      : options_(options),
        rod_(rod),
        scene_(read_case(options.cases, rod.file)),
        solver_(made(scene_)),
        judged_(made(scene_)) {
    data_.length_mm = length_mm(scene_);
    data_.tolerance_mm = rod.tolerance_mm;
    data_.samples.reserve(solves / every);
  }

  StreamData run(Progress& progress) {
    progress.step(fmt::format("follow {}", rod_.file));
    follow();
    progress.step("exact");
    for (StreamSample& sample : data_.samples) judge(sample);
    return std::move(data_);
  }

 private:
  fam::Solver made(const scene::Scene& scene) const {
    fam::Options options;
    options.tolerance_mm = rod_.tolerance_mm;
    options.model = scene::RodModel::kirchhoff;
    return std::get<fam::Solver>(fam::Solver::make(scene, options));
  }

  // --quick: the judged solves alone, half a second apart.
  void follow() {
    const int stride = options_.quick ? every : 1;
    data_.latency_us.reserve(solves);
    solve(rod_.inputs_at(0));  // cold, not counted
    data_.not_converged = data_.without_slopes = 0;
    const std::size_t before = options_.allocations ? options_.allocations() : 0;
    for (int i = 0; i < solves; i += stride) {
      const Inputs inputs = rod_.inputs_at(i);
      const auto start = std::chrono::steady_clock::now();
      solve(inputs);
      const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - start;
      data_.latency_us.push_back(spent.count());
      if (i % every == 0) {
        const auto& [first, second] = inputs.tensions_N;
        set(judged_, inputs);
        judged_.solve();
        data_.samples.push_back({i, {first, second}, inputs.force_N, judged_.tip().position_B_mm});
      }
    }
    if (options_.allocations) data_.allocations = static_cast<long>(options_.allocations() - before);
  }

  void set(fam::Solver& solver, const Inputs& inputs) const {
    for (std::size_t i = 0; i < rod_.tendons.size(); ++i) solver.set_tension_N(rod_.tendons[i], inputs.tensions_N[i]);
    solver.set_force_N(rod_.force, inputs.force_N);
  }

  // What a controller asks for at each tick.
  void solve(const Inputs& inputs) {
    set(solver_, inputs);
    if (!solver_.solve().converged()) ++data_.not_converged;
    double sum = solver_.compliance(data_.length_mm).sum() + solver_.by_load(rod_.force, data_.length_mm).sum();
    for (const std::size_t tendon : rod_.tendons) sum += solver_.by_load(tendon, data_.length_mm).col(0).sum();
    if (!std::isfinite(sum)) ++data_.without_slopes;
  }

  void judge(StreamSample& sample) const {
    Request request;
    request.model = scene::RodModel::kirchhoff;
    const scene::Equilibrium exact =
        method_row("exact")(request)->solve(rod_.with(scene_, rod_.inputs_at(sample.solve)));
    sample.exact_tip_mm =
        exact.converged() ? exact.tip().position_B_mm : Eigen::Vector3d(Eigen::Vector3d::Constant(NAN));
  }

  StudyOptions options_;
  const StreamedRod& rod_;
  scene::Scene scene_;
  fam::Solver solver_;
  fam::Solver judged_;  // goes from one judged solve to the next, so that they do not depend on those between
  StreamData data_;
};

}  // namespace

void stream(const StudyOptions& options) {
  Progress progress("stream", 4, options.progress);
  const StreamData data = Stream(streamed_catheter, options).run(progress),
                   of_tube = Stream(streamed_tube, options).run(progress);
  std::map<std::string, std::string> files = {{"accuracy.csv", stream_accuracy_csv(data)},
                                              {"accuracy_tube.csv", stream_accuracy_csv(of_tube)},
                                              {"timing_latency.csv", stream_latency_csv(data)},
                                              {"timing_latency_tube.csv", stream_latency_csv(of_tube)},
                                              {"timing_latency.svg", stream_latency_picture(data)}};
  files.merge(stream_pages(data, of_tube, options.pages / "stream" / "page.md"));
  write_results(options.output / "stream", "fam-studies stream", files);
}

}  // namespace studies
