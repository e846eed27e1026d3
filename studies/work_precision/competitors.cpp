#include "studies/work_precision/competitors.h"

#include "studies/methods/elastica_method.h"
#include "studies/methods/exact_method.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/fem_method.h"
#include "studies/methods/rk4_method.h"

#include <fmt/format.h>

namespace studies {
namespace {

const std::vector<int> arc_counts = {1, 2, 4, 8, 12, 16, 32, 64, 128, 256, 512};
const std::vector<int> step_counts = {2, 4, 8, 16, 32, 64, 128, 256, 512};

std::string counted(int count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

const char* model_name(bool with_shear) {
  return with_shear ? "Reissner" : "Kirchhoff";
}

void add_fam(std::vector<Competitor>& list, bool with_shear) {
  for (const fam::Law law : fam::all_laws()) {
    if (with_shear && !fam::facts_of(law).coupled) continue;
    for (const int arcs : arc_counts) {
      fam::Options options;
      options.law = law;
      options.model = with_shear ? fam::RodModel::reissner : fam::RodModel::kirchhoff;
      options.arcs = arcs;
      options.estimate_error = false;
      list.push_back({std::string("fam ") + fam::name(law), model_name(with_shear), counted(arcs, "arc"),
                      std::to_string(arcs), fam_method(options)});
    }
  }
}

// Its tolerance is a length in mm; the rest of the study counts in rod lengths.
class FamAutomatic : public Method {
 public:
  explicit FamAutomatic(double tolerance) : tolerance_(tolerance) {}
  std::string name() const override { return "fam automatic"; }
  std::string resolution() const override { return fmt::format("{:.0e} L", tolerance_); }
  scene::Equilibrium solve(const scene::Scene& scene) const override { return fam::solve(scene, options(scene)); }
  std::function<void()> bare_solve(const scene::Scene& scene) const override {
    return fam_method(options(scene))->bare_solve(scene);
  }

 private:
  fam::Options options(const scene::Scene& scene) const {
    fam::Options options;
    options.tolerance_mm = tolerance_ * scene::length_mm(scene);
    return options;
  }
  double tolerance_;
};

void add_fam_automatic(std::vector<Competitor>& list) {
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    auto method = std::make_unique<FamAutomatic>(tolerance);
    const std::string text = method->resolution();
    list.push_back({"fam automatic", "Reissner", text, text, std::move(method)});
  }
}

void add_shooting(std::vector<Competitor>& list, bool with_shear) {
  for (const int steps : step_counts) {
    list.push_back({"rk4 shooting", model_name(with_shear), counted(steps, "step"), std::to_string(steps),
                    rk4_method({steps, with_shear})});
  }
}

void add_exact(std::vector<Competitor>& list, bool with_shear) {
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    exact_reference::Options options;
    options.tolerance = tolerance;
    options.model = with_shear ? exact_reference::RodModel::reissner : exact_reference::RodModel::kirchhoff;
    const std::string text = fmt::format("{:.0e} L", tolerance);
    list.push_back({"exact reference", model_name(with_shear), text, text, exact_method(options)});
  }
}

std::vector<int> element_counts(FeMeshes meshes, bool with_shear, int order) {
  if (meshes == FeMeshes::few && !with_shear) return {};
  if (meshes == FeMeshes::few && order == 1) return {1, 4, 16, 50};
  if (meshes == FeMeshes::few) return {1, 2, 4, 8, 16, 32, 50};
  std::vector<int> counts = {1, 2, 4, 8, 16, 32, 50, 100};
  if (meshes == FeMeshes::most && with_shear) counts.insert(counts.end(), {200, 400});
  return counts;
}

void add_finite_elements(std::vector<Competitor>& list, bool with_shear, FeMeshes meshes) {
  for (const int order : {1, 2}) {
    for (const bool whole_load : {true, false}) {
      for (const int elements : element_counts(meshes, with_shear, order)) {
        fem_reference::Options options;
        options.elements = elements;
        options.order = order;
        options.model = with_shear ? fem_reference::RodModel::reissner : fem_reference::RodModel::kirchhoff;
        options.estimate_error = false;
        if (whole_load) {
          options.initial_load_step = 1;
          options.largest_rotation_rad = 3;
        }
        const std::string series =
            std::string(order == 1 ? "fe linear" : "fe quadratic") + (whole_load ? " whole load" : " adaptive");
        list.push_back({series, model_name(with_shear), counted(elements, "element"), std::to_string(elements),
                        fem_method(options)});
      }
    }
  }
}

}  // namespace

std::vector<Competitor> competitors(FeMeshes meshes) {
  std::vector<Competitor> list;
  for (const bool with_shear : {false, true}) {
    add_fam(list, with_shear);
    if (with_shear) add_fam_automatic(list);
    add_shooting(list, with_shear);
    add_exact(list, with_shear);
    if (!with_shear) {
      list.push_back({"closed form", "Kirchhoff", "elliptic functions", "exact", elastica_method()});
    }
    add_finite_elements(list, with_shear, meshes);
  }
  return list;
}

}  // namespace studies
