#include "studies/methods/exact_method.h"

#include <fmt/format.h>

namespace studies {
namespace {

class ExactMethod : public Method {
 public:
  explicit ExactMethod(const exact_reference::Options& options) : options_(options) {}

  std::string name() const override {
    return options_.model == exact_reference::RodModel::kirchhoff ? "exact kirchhoff" : "exact";
  }
  std::string resolution() const override {
    const bool full = options_.tolerance == exact_reference::Options().tolerance;
    return full ? "round-off" : fmt::format("tolerance {:.0e} L", options_.tolerance);
  }
  scene::Equilibrium solve(const scene::Scene& scene) const override { return exact_reference::solve(scene, options_); }

  std::function<void()> bare_solve(const scene::Scene& scene) const override {
    return [scene, options = options_] { exact_reference::solve(scene, options); };
  }

 private:
  exact_reference::Options options_;
};

}  // namespace

std::unique_ptr<Method> exact_method(const exact_reference::Options& options) {
  return std::make_unique<ExactMethod>(options);
}

}  // namespace studies
