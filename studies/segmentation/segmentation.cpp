// fam-studies segmentation: reads studies/cases/study1/{P,S}{1..8}_follower.json (P4_fixed.json for the frame), marches
// them with 1 to 1 000 000 arcs, finds the load budgets, runs the ablation (ablation.h), and writes tables, pictures
// and pages to results/segmentation. Some fifteen seconds.
#include "studies/study.h"

#include "exact_reference/elastica.h"
#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "fem_reference/solve.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/segmentation/ablation.h"
#include "studies/segmentation/data.h"

#include <cmath>
#include <optional>

namespace studies {
namespace {

using Eigen::Vector3d;

const std::vector<int> all_arcs = {1,   2,    3,    4,    6,     8,     12,    20,     30,     50,     100,    200,
                                   500, 1000, 2000, 5000, 10000, 20000, 50000, 100000, 200000, 500000, 1000000};
const std::vector<int> few_arcs = {1, 2, 4, 12, 50, 500, 5000};
const std::vector<std::string> laws = {"published", "midpoint", "fourth_order", "fourth_order_reissner", "sixth_order"};

fam::Options march_options(const std::string& law, int arcs) {
  fam::Options options;
  options.law = fam::law_named(law).value_or(fam::Law::fourth_order);  // fourth_order_reissner
  options.model = law == "fourth_order_reissner" ? fam::RodModel::reissner : fam::RodModel::kirchhoff;
  options.arcs = arcs;
  options.estimate_error = false;
  return options;
}

fam::Prepared ready_march(const scene::Scene& scene, const std::string& law, int arcs) {
  std::string reason;
  return fam::prepare(scene, march_options(law, arcs), reason).value();
}

// Empty where an arc's angle was not found.
std::optional<Vector3d> marched_tip_mm(const scene::Scene& scene, const std::string& law, int arcs) {
  fam::Prepared march = ready_march(scene, law, arcs);
  if (fam::run_prepared(march) != scene::Status::converged) return {};
  return fam::poses_of(march).back().position_B_mm;
}

// P4 and its relatives: uniform, planar, loaded at the tip by (0, F_y) and M_z.
scene::Scene planar_scene(const scene::Scene& p4, double force_N, double moment_Nmm) {
  scene::Scene scene = p4;
  const double length = scene::length_mm(p4);
  scene.loads = {scene::Force{length, scene::Frame::follower, {0, force_N, 0}},
                 scene::Moment{length, scene::Frame::follower, {0, 0, moment_Nmm}}};
  return scene;
}

exact_reference::Elastica elastica(const scene::Scene& p4, double force_N, double moment_Nmm) {
  return exact_reference::Elastica::with_follower_load(
      {scene::length_mm(p4), scene::stiffness_of(p4.sections[0]).bending_Nmm2[1], {0, force_N}, moment_Nmm});
}

Vector3d in_space(const exact_reference::PlanarPose& pose) {
  return {pose.position_B_mm[0], pose.position_B_mm[1], 0};
}

constexpr double p4_force_N = -1.5, p4_moment_Nmm = 60;  // studies/cases/study1/P4_follower.json

class Segmentation {
 public:
  explicit Segmentation(const StudyOptions& options)
      : options_(options),
        folder_(options.output / "segmentation"),
        p4_(read_case(options.cases, "study1/P4_follower")),
        progress_("segmentation", study1_cases().size() + 3, options.progress) {}

  void run() {
    for (const std::string& load_case : study1_cases()) sweep(load_case);
    progress_.step("budgets");
    find_budgets();
    progress_.step("ablation");
    const Vector3d fe_tip = fem_reference::solve(p4_).tip().position_B_mm;
    ablation_ = run_ablation(fe_tip.head<2>());
    draw_shapes();
    progress_.step("times");
    take_times();
    write();
  }

 private:
  void sweep(const std::string& load_case) {
    progress_.step(load_case);
    const scene::Scene scene = read_case(options_.cases, "study1/" + load_case + "_follower");
    exact_reference::Options exact;
    const scene::Equilibrium reissner = exact_reference::solve(scene, exact);
    exact.model = exact_reference::RodModel::kirchhoff;
    const scene::Equilibrium kirchhoff = exact_reference::solve(scene, exact);
    const scene::Equilibrium fe = fem_reference::solve(scene);
    fem_reference::Options fe_options;
    fe_options.estimate_error = false;
    const scene::Equilibrium fe_fixed =
        fem_reference::solve(read_case(options_.cases, "study1/" + load_case + "_fixed"), fe_options);

    const bool closed_form = load_case == "P4";
    const Vector3d tip =
        closed_form ? in_space(elastica(p4_, p4_force_N, p4_moment_Nmm).tip()) : kirchhoff.tip().position_B_mm;
    const Vector3d fe_tip = fe.tip().position_B_mm, reissner_tip = reissner.tip().position_B_mm;
    data_.references.push_back({load_case, closed_form ? 1e-13 * scene::length_mm(scene) : kirchhoff.error_estimate_mm,
                                fe.error_estimate_mm, (reissner_tip - tip).norm(),
                                (fe_fixed.tip().position_B_mm - fe_tip).norm()});
    for (const std::string& law : laws) {
      for (const int arcs : closed_form ? all_arcs : few_arcs) {
        const std::optional<Vector3d> marched = marched_tip_mm(scene, law, arcs);
        if (!marched) continue;
        const Vector3d& own = law == "fourth_order_reissner" ? reissner_tip : tip;
        data_.points.push_back({load_case, law, arcs, (*marched - own).norm(), (*marched - fe_tip).norm()});
      }
    }
  }

  // Tip error of a planar load in units of |F| L^2/EI.
  double budget_error_mm(const std::string& load, const std::string& law, int arcs, double size) const {
    const double length = scene::length_mm(p4_);
    const double force = size * scene::stiffness_of(p4_.sections[0]).bending_Nmm2[1] / (length * length);
    const double force_N = load == "P4 scaled" ? -force : force;
    const double moment_Nmm = load == "P4 scaled" ? force * p4_moment_Nmm / std::abs(p4_force_N) : 0;
    const std::optional<Vector3d> tip = marched_tip_mm(planar_scene(p4_, force_N, moment_Nmm), law, arcs);
    return tip ? (*tip - in_space(elastica(p4_, force_N, moment_Nmm).tip())).norm() : INFINITY;
  }

  // Upwards in steps of 5 % until the error passes the limit, then bisection.
  Budget budget(const std::string& load, const std::string& law, int arcs, double limit_mm) const {
    const auto holds = [&](double size) { return budget_error_mm(load, law, arcs, size) < limit_mm; };
    double low = 0, high = 0.01;
    while (high < budget_load_max && holds(high)) {
      low = high;
      high *= 1.05;
    }
    if (high >= budget_load_max) return {load, law, arcs, limit_mm, budget_load_max, true};
    for (int i = 0; i < 30; ++i) (holds((low + high) / 2) ? low : high) = (low + high) / 2;
    return {load, law, arcs, limit_mm, low, false};
  }

  void find_budgets() {
    for (const std::string load : {"P4 scaled", "transverse force"}) {
      for (const std::string law : {"published", "midpoint", "fourth_order", "sixth_order"}) {
        for (const int arcs : {1, 2, 4, 8, 12, 20, 50, 100, 200, 500}) {
          for (const double limit_mm : {0.01, 0.1, 1.0}) data_.budgets.push_back(budget(load, law, arcs, limit_mm));
        }
      }
    }
  }

  void draw_shapes() {
    const double length = scene::length_mm(p4_);
    for (const int arcs : {1, 2, 3, 12, 500}) {
      fam::Prepared march = ready_march(p4_, "published", arcs);
      if (fam::run_prepared(march) != scene::Status::converged) continue;
      const std::vector<fam::Arc> solved = fam::arcs_of(march);
      const std::vector<fam::SectionPose> poses = fam::poses_of(march);
      SweepShape shape{std::to_string(arcs) + (arcs == 1 ? " arc" : " arcs"), {}};
      for (int i = 0; i <= 48; ++i) {
        const int arc = std::min(arcs - 1, i * arcs / 48);
        const auto index = static_cast<std::size_t>(arc);
        const double fraction = static_cast<double>(i) * arcs / 48 - arc;
        shape.positions_mm.push_back(fam::pose_on(solved[index], poses[index], fraction).position_B_mm);
      }
      data_.shapes.push_back(std::move(shape));
    }
    SweepShape exact{"exact", {}};
    for (int i = 0; i <= 20; ++i) {
      exact.positions_mm.push_back(in_space(elastica(p4_, p4_force_N, p4_moment_Nmm).at(length * i / 20)));
    }
    data_.shapes.push_back(std::move(exact));
  }

  void take_times() {
    for (const std::string& law : laws) {
      for (const int arcs : all_arcs) {
        if (options_.quick && arcs > 10'000) continue;
        const auto march = std::make_shared<fam::Prepared>(ready_march(p4_, law, arcs));
        data_.times.push_back({law, arcs, measure([march] { fam::run_prepared(*march); }, options_.quick ? 0 : 0.05)});
      }
    }
  }

  void write() const {
    std::map<std::string, std::string> files = segmentation_tables(data_);
    files.merge(segmentation_pictures(data_));
    files.merge(ablation_files(ablation_, data_.reference("P4").frame_mm));
    files["README.md"] = segmentation_page(data_);
    files["headline.md"] = segmentation_headline(data_);
    files["timing.md"] = segmentation_timing_page(data_);
    write_results(folder_, "fam-studies segmentation", files);
  }

  StudyOptions options_;
  std::filesystem::path folder_;
  scene::Scene p4_;
  SegmentationData data_;
  AblationData ablation_;
  Progress progress_;
};

}  // namespace

void segmentation(const StudyOptions& options) {
  Segmentation(options).run();
}

}  // namespace studies
