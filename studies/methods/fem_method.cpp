#include "studies/methods/fem_method.h"

namespace studies {
namespace {

class FemMethod : public Method {
 public:
  explicit FemMethod(const fem_reference::Options& options) : options_(options) {}

  std::string name() const override {
    return options_.model == fem_reference::RodModel::kirchhoff ? "fem kirchhoff" : "fem";
  }
  std::string resolution() const override {
    const char* orders[] = {"", "linear", "quadratic", "cubic"};
    return std::to_string(options_.elements) + " " + orders[options_.order] + " elements";
  }
  scene::Equilibrium solve(const scene::Scene& scene) const override { return fem_reference::solve(scene, options_); }

  std::function<void()> bare_solve(const scene::Scene& scene) const override {
    fem_reference::Options bare = options_;
    bare.estimate_error = false;
    return [scene, bare] { fem_reference::solve(scene, bare); };
  }

 private:
  fem_reference::Options options_;
};

}  // namespace

std::unique_ptr<Method> fem_method(const fem_reference::Options& options) {
  return std::make_unique<FemMethod>(options);
}

}  // namespace studies
