// The finite arc method as a competitor. All in this header: the command fam uses it without the studies.
#pragma once

#include "fam/solver.h"
#include "studies/methods/method.h"

namespace studies {

class FamMethod : public Method {
 public:
  FamMethod(const fam::Options& options, double tolerance_over_L)
      : options_(options), tolerance_over_L_(tolerance_over_L) {}

  std::string name() const override { return std::string("fam ") + fam::name(options_.law); }
  std::string resolution() const override {
    return options_.arcs > 0 ? std::to_string(options_.arcs) + " arcs" : "automatic";
  }
  scene::Equilibrium solve(const scene::Scene& scene) const override { return fam::solve(scene, options_for(scene)); }

  std::function<void()> bare_solve(const scene::Scene& scene) const override {
    if (options_.arcs == 0) {
      fam::Options tip_alone = options_for(scene);
      tip_alone.whole_rod = false;
      return [scene, tip_alone] { fam::solve(scene, tip_alone); };
    }
    auto made = fam::Solver::make(scene, options_);
    if (std::holds_alternative<fam::Refusal>(made)) return [] {};
    return [solver = std::make_shared<fam::Solver>(std::get<fam::Solver>(std::move(made)))] {
      solver->solve(fam::Solver::Start::unloaded);
    };
  }

 private:
  fam::Options options_for(const scene::Scene& scene) const {
    fam::Options options = options_;
    if (tolerance_over_L_ > 0) options.tolerance_mm = tolerance_over_L_ * scene::length_mm(scene);
    return options;
  }

  fam::Options options_;
  double tolerance_over_L_;
};

// With a fixed number of arcs the bare solve is that of a kept solver; with a tolerance it is all of fam::solve for the
// tip: choice, memory, estimate and stability.
// tolerance_over_L > 0: in place of options.tolerance_mm, for each scene its own length's.
inline std::unique_ptr<Method> fam_method(const fam::Options& options, double tolerance_over_L = 0) {
  return std::make_unique<FamMethod>(options, tolerance_over_L);
}

}  // namespace studies
