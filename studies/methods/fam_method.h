// The finite arc method as a competitor. All in this header: the command fam uses it without the studies.
#pragma once

#include "fam/solve.h"
#include "studies/methods/method.h"

namespace studies {

// With a fixed number of arcs the bare solve is the march; with a tolerance it is all of fam::solve, choice included.
class FamMethod : public Method {
 public:
  explicit FamMethod(const fam::Options& options) : options_(options) {}

  std::string name() const override { return std::string("fam ") + fam::name(options_.law); }
  std::string resolution() const override {
    return options_.arcs > 0 ? std::to_string(options_.arcs) + " arcs" : "automatic";
  }
  scene::Equilibrium solve(const scene::Scene& scene) const override { return fam::solve(scene, options_); }

  std::function<void()> bare_solve(const scene::Scene& scene) const override {
    if (options_.arcs == 0) return [scene, options = options_] { fam::solve(scene, options); };
    std::string reason;
    std::optional<fam::Prepared> solver = fam::prepare(scene, options_, reason);
    if (!solver) return [] {};
    return [shared = std::make_shared<fam::Prepared>(std::move(*solver))] { fam::run_prepared(*shared); };
  }

 private:
  fam::Options options_;
};

inline std::unique_ptr<Method> fam_method(const fam::Options& options) {
  return std::make_unique<FamMethod>(options);
}

}  // namespace studies
