// fam-studies fe-verification: solves Study I scenes and a thin rod with the finite elements and the exact reference,
// writes convergence.csv, own_error.csv, work.csv, pictures and a page.
#include "studies/study.h"

#include "exact_reference/solve.h"
#include "fem_reference/solve.h"
#include "studies/fe_verification/data.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"

namespace studies {
namespace {

double tip_error_over_L(const scene::Equilibrium& found, const scene::Equilibrium& exact) {
  if (!found.converged() || !exact.converged()) return -1;
  return (found.tip().position_B_mm - exact.tip().position_B_mm).norm() / exact.stations.back().s_mm;
}

int fact(const scene::Equilibrium& result, const std::string& key) {
  for (const auto& [name, value] : result.model) {
    if (name == key) return std::get<int>(value);
  }
  return 0;
}

// The loads of S4 on a rod whose shear stiffness is a thousandfold: EI / (kGA L^2) = 1e-6.
scene::Scene thin_rod(const scene::Scene& thick) {
  scene::Scene thin = thick;
  scene::Stiffness stiffness = stiffness_of(thick.sections[0]);
  stiffness.axial_N = 3e6;
  stiffness.shear_N = Eigen::Vector2d::Constant(1e6);
  thin.sections[0].cross_section = stiffness;
  return thin;
}

class FeVerificationStudy {
 public:
  explicit FeVerificationStudy(const StudyOptions& options)
      : options_(options), progress_("fe-verification", 38, options.progress) {}

  void run() {
    const scene::Scene thick = read_case(options_.cases, "study1/S4_fixed");
    converge("thick", thick);
    converge("thin", thin_rod(thick));
    for (const char* frame : {"follower", "fixed"}) {
      for (const std::string& load_case : study1_cases()) own_error(load_case + "_" + frame);
    }
    for (const double load : {0.1, 1.0, 10.0, 100.0, 1000.0}) work(thick, load);
    write();
  }

 private:
  void converge(const std::string& rod, const scene::Scene& scene) {
    const scene::Equilibrium exact = exact_reference::solve(scene);
    fem_reference::Options options;
    options.estimate_error = false;
    for (const int order : {1, 2, 3}) {
      progress_.step(rod + " rod, order " + std::to_string(order));
      for (const bool full : {false, true}) {
        for (int elements = 1; elements <= 256; elements *= 2) {
          options.order = order;
          options.full_integration = full;
          options.elements = elements;
          data_.convergence.push_back(
              {rod, order, full, elements, tip_error_over_L(fem_reference::solve(scene, options), exact)});
        }
      }
    }
  }

  void own_error(const std::string& name) {
    progress_.step(name);
    const scene::Scene scene = read_case(options_.cases, "study1/" + name);
    const double length_mm = scene::length_mm(scene);
    const scene::Equilibrium exact = exact_reference::solve(scene);
    const scene::Equilibrium found = fem_reference::solve(scene);
    exact_reference::Options exact_kirchhoff;
    exact_kirchhoff.model = exact_reference::RodModel::kirchhoff;
    fem_reference::Options kirchhoff;
    kirchhoff.model = fem_reference::RodModel::kirchhoff;
    kirchhoff.estimate_error = false;
    data_.own_errors.push_back(
        {name, tip_error_over_L(found, exact), found.error_estimate_mm / length_mm,
         tip_error_over_L(fem_reference::solve(scene, kirchhoff), exact_reference::solve(scene, exact_kirchhoff)),
         exact.stations.back().s_mm, fact(found, "load_steps"), fact(found, "newton_iterations")});
  }

  void work(scene::Scene scene, double load) {
    const double length = scene::length_mm(scene);
    const double force_N = load * stiffness_of(scene.sections[0]).bending_Nmm2[0] / (length * length);
    scene.loads = {scene::Force{length, scene::Frame::fixed, {0, force_N, 0}}};
    for (const auto model : {fem_reference::RodModel::reissner, fem_reference::RodModel::kirchhoff}) {
      fem_reference::Options options;
      options.estimate_error = false;
      options.model = model;
      const scene::Equilibrium found = fem_reference::solve(scene, options);
      data_.work.push_back({model == fem_reference::RodModel::reissner ? "real section" : "kirchhoff", load,
                            scene::name(found.status), fact(found, "load_steps"), fact(found, "newton_iterations")});
    }
  }

  void write() const {
    write_results(options_.output / "fe_verification", "fam-studies fe-verification",
                  fe_verification_files(data_, options_.pages / "fe_verification/page.md"));
  }

  StudyOptions options_;
  FeVerification data_;
  Progress progress_;
};

}  // namespace

void fe_verification(const StudyOptions& options) {
  FeVerificationStudy(options).run();
}

}  // namespace studies
