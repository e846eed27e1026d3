#include "studies/methods/rk4_method.h"

#include "scene/span_facts.h"
#include "studies/methods/rk4_shooting.h"

#include <fmt/format.h>

#include <cmath>

namespace studies {
namespace {

constexpr double earlier_share = 0.99;  // of the loads, where the warm start comes from

std::shared_ptr<Rk4Shooting> prepared(const scene::Scene& scene, const Rk4Options& options, double load_share = 1) {
  std::vector<scene::Span> spans = scene::spans_of(scene);
  for (scene::Span& span : spans) {
    for (scene::Wrench* load : {&span.follower_load_S, &span.fixed_load_B}) {
      load->force_N *= load_share;
      load->moment_Nmm *= load_share;
    }
    span.fixed_force_arms_BS_Nmm *= load_share;
    span.follower_force_S_N_per_mm *= load_share;
    span.fixed_force_B_N_per_mm *= load_share;
    for (scene::SectionTendon& tendon : span.tendons) tendon.tension_N *= load_share;
  }
  return std::make_shared<Rk4Shooting>(spans, scene::cells_per_span(spans, options.steps), options.with_shear);
}

std::string reason(const Rk4Shooting& solver) {
  return fmt::format("plain Newton ended with a residual of {:.1e} after {} iterations; tolerance {:.0e}",
                     solver.residual(), solver.iterations(), Rk4Shooting::tolerance);
}

class Rk4Method : public Method {
 public:
  explicit Rk4Method(const Rk4Options& options) : options_(options) {}

  std::string name() const override { return "rk4 shooting"; }
  std::string resolution() const override {
    return std::to_string(options_.steps) + (options_.steps == 1 ? " step" : " steps");
  }

  scene::Equilibrium solve(const scene::Scene& scene) const override {
    scene::Equilibrium result;
    const std::shared_ptr<Rk4Shooting> solver = prepared(scene, options_);
    result.status = solver->run();
    result.model = {{"steps", options_.steps}, {"shear", options_.with_shear}, {"iterations", solver->iterations()}};
    if (!result.converged()) {
      result.message = reason(*solver);
      return result;
    }
    result.stations = solver->stations();
    result.tip_angle_rad = scene::tip_angle_rad(result.stations, scene::plane_normal(scene::spans_of(scene)));
    result.error_estimate_mm = error_estimate_mm(scene, result.tip().position_B_mm);
    return result;
  }

  std::function<void()> bare_solve(const scene::Scene& scene) const override {
    return [solver = prepared(scene, options_)] { solver->run(); };
  }

  std::function<void()> warm_solve(const scene::Scene& scene) const override {
    const std::shared_ptr<Rk4Shooting> earlier = prepared(scene, options_, earlier_share);
    if (earlier->run() != scene::Status::converged) return {};
    const std::shared_ptr<Rk4Shooting> solver = prepared(scene, options_);
    const Rk4Shooting::Vector6d guess = earlier->base_wrench();
    if (solver->run(guess) != scene::Status::converged) return {};
    return [solver, guess] { solver->run(guess); };
  }

 private:
  double error_estimate_mm(const scene::Scene& scene, const Eigen::Vector3d& tip_B_mm) const {
    const std::shared_ptr<Rk4Shooting> twice = prepared(scene, {2 * options_.steps, options_.with_shear});
    if (twice->run() != scene::Status::converged) return INFINITY;
    return 16.0 / 15.0 * (twice->stations().back().X_BS.position_B_mm - tip_B_mm).norm();
  }

  Rk4Options options_;
};

}  // namespace

std::unique_ptr<Method> rk4_method(const Rk4Options& options) {
  return std::make_unique<Rk4Method>(options);
}

}  // namespace studies
