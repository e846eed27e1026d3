// fam-studies stream: a catheter of studies/cases/stream under gravity, two tendons and a force at its tip, whose
// values go along a smooth path at 1 kHz for 100 s. A kept solver follows, with its Jacobians at the tip; the exact
// reference judges every 500th solve.
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
constexpr double tolerance_mm = 0.01;

// The loads' numbers in the scene file.
constexpr std::size_t stream_tendons[] = {1, 2}, stream_force = 3;

struct Inputs {
  double tensions_N[2];
  Eigen::Vector3d force_N;
};

// Periods of some seconds that never repeat together, as a hand or a heart would drive it.
Inputs inputs_at(int solve) {
  const double t = 2 * std::numbers::pi * solve / solves_per_s;
  const double size_N = 0.01 * (1 + std::sin(0.13 * t));
  return {{2 + 2 * std::sin(0.31 * t), 2 + 2 * std::cos(0.47 * t)},
          size_N * Eigen::Vector3d(0.5 * std::sin(0.23 * t), std::cos(0.71 * t), std::sin(0.71 * t))};
}

scene::Scene with(scene::Scene scene, const Inputs& inputs) {
  for (int i = 0; i < 2; ++i)
    known_load<scene::Tendon>(scene.loads[stream_tendons[i]])->tension_N = inputs.tensions_N[i];
  known_load<scene::Force>(scene.loads[stream_force])->value_N = inputs.force_N;
  return scene;
}

class Stream {
 public:
  explicit Stream(const StudyOptions& options)
      : options_(options),
        scene_(read_case(options.cases, "stream/catheter")),
        solver_(made(scene_)),
        judged_(made(scene_)) {
    data_.length_mm = length_mm(scene_);
    data_.tolerance_mm = tolerance_mm;
    data_.samples.reserve(solves / every);
  }

  void run() {
    Progress progress("stream", 2, options_.progress);
    progress.step("follow");
    follow();
    progress.step("exact");
    for (StreamSample& sample : data_.samples) judge(sample);
    std::map<std::string, std::string> files = {{"accuracy.csv", stream_accuracy_csv(data_)},
                                                {"timing_latency.csv", stream_latency_csv(data_)},
                                                {"timing_latency.svg", stream_latency_picture(data_)}};
    files.merge(stream_pages(data_, options_.pages / "stream" / "page.md"));
    write_results(options_.output / "stream", "fam-studies stream", files);
  }

 private:
  static fam::Solver made(const scene::Scene& scene) {
    fam::Options options;
    options.tolerance_mm = tolerance_mm;
    options.model = scene::RodModel::kirchhoff;
    return std::get<fam::Solver>(fam::Solver::make(scene, options));
  }

  // --quick: the judged solves alone, half a second apart.
  void follow() {
    const int stride = options_.quick ? every : 1;
    data_.latency_us.reserve(solves);
    solve(inputs_at(0));  // cold, not counted
    data_.not_converged = data_.without_slopes = 0;
    const std::size_t before = options_.allocations ? options_.allocations() : 0;
    for (int i = 0; i < solves; i += stride) {
      const Inputs inputs = inputs_at(i);
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

  static void set(fam::Solver& solver, const Inputs& inputs) {
    for (int i = 0; i < 2; ++i) solver.set_tension_N(stream_tendons[i], inputs.tensions_N[i]);
    solver.set_force_N(stream_force, inputs.force_N);
  }

  // What a controller asks for at each tick.
  void solve(const Inputs& inputs) {
    set(solver_, inputs);
    if (!solver_.solve().converged()) ++data_.not_converged;
    double sum = solver_.compliance(data_.length_mm).sum() + solver_.by_load(stream_force, data_.length_mm).sum();
    for (const std::size_t tendon : stream_tendons) sum += solver_.by_load(tendon, data_.length_mm).col(0).sum();
    if (!std::isfinite(sum)) ++data_.without_slopes;
  }

  void judge(StreamSample& sample) const {
    Request request;
    request.model = scene::RodModel::kirchhoff;
    const scene::Equilibrium exact = method_row("exact")(request)->solve(with(scene_, inputs_at(sample.solve)));
    sample.exact_tip_mm =
        exact.converged() ? exact.tip().position_B_mm : Eigen::Vector3d(Eigen::Vector3d::Constant(NAN));
  }

  StudyOptions options_;
  scene::Scene scene_;
  fam::Solver solver_;
  fam::Solver judged_;  // goes from one judged solve to the next, so that they do not depend on those between
  StreamData data_;
};

}  // namespace

void stream(const StudyOptions& options) {
  Stream(options).run();
}

}  // namespace studies
