// fam-studies torsion: reads studies/cases/study1/S1_follower.json, adds a follower torque at the tip from 0 to 1000 N
// mm, solves by the arc laws, exactly and by finite elements, and writes tables, pictures and the page to
// results/torsion. Some five seconds.
#include "studies/scenes/cases.h"
#include "studies/study.h"

#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "fem_reference/solve.h"
#include "scene/load_visitor.h"
#include "studies/compare/error_measures.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"
#include "studies/torsion/page.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace studies {
namespace {

using Eigen::Vector3d;

const std::vector<double> torques_Nmm = {0,  5,  10,  15,  20,  25,  30,  35,  40,  45,
                                         50, 75, 100, 150, 200, 300, 500, 700, 1000};
const std::vector<double> order_torques_Nmm = {0, 20, 50};

fam::Options arc_options(const std::string& law, int arcs, fam::RodModel model = fam::RodModel::kirchhoff) {
  fam::Options options;
  options.law = fam::law_named(law).value_or(fam::Law::published);  // or a twist order of it
  options.twist_order = law == "twist_bend" ? fam::TwistOrder::twist_bend : fam::TwistOrder::bend_twist;
  options.model = model;
  options.arcs = arcs;
  options.estimate_error = false;
  return options;
}

double distance_mm(const scene::Equilibrium& a, const scene::Equilibrium& b) {
  return a.converged() && b.converged() ? (a.tip().position_B_mm - b.tip().position_B_mm).norm() : NAN;
}

class Torsion {
 public:
  explicit Torsion(const StudyOptions& options)
      : folder_(options.output / "torsion"),
        s1_(read_case(options.cases, "study1/S1_follower")),
        tendons_(read_case(options.cases, "torsion/three_tendons")),
        progress_("torsion", torques_Nmm.size(), options.progress) {
    const auto& circle = std::get<scene::CircularSection>(s1_.sections[0].cross_section);
    const double d = circle.outer_diameter_mm;
    data_.rod = {scene::length_mm(s1_), scene::stiffness_of(s1_.sections[0]).torsion_Nmm2, std::numbers::pi * d * d / 4,
                 d / 4};
    data_.torques_Nmm = torques_Nmm;
  }

  void run() {
    for (const double torque : torques_Nmm) solve_torque(torque);
    for (const double torque : order_torques_Nmm) find_orders(torque);
    for (const double torque : {0, 5, 10, 20, 30, 40, 50}) tilt_tendons(torque);
    write();
  }

 private:
  scene::Scene with_torque(double torque_Nmm) const {
    scene::Scene scene = s1_;
    scene.loads.push_back(scene::Moment{scene::length_mm(s1_), scene::Frame::follower, {torque_Nmm, 0, 0}});
    return scene;
  }

  static scene::Equilibrium exact(const scene::Scene& scene, exact_reference::RodModel model) {
    exact_reference::Options options;
    options.model = model;
    return exact_reference::solve(scene, options);
  }

  void solve_torque(double torque) {
    progress_.step(fmt::format("{} N mm", torque));
    const scene::Scene scene = with_torque(torque);
    const scene::Equilibrium kirchhoff = exact(scene, exact_reference::RodModel::kirchhoff);
    const scene::Equilibrium reissner = exact(scene, exact_reference::RodModel::reissner);
    const scene::Equilibrium fe = fem_reference::solve(scene);
    const auto record = [&](const std::string& method, const scene::Equilibrium& result,
                            const scene::Equilibrium& own) {
      const Vector3d tip = result.converged() ? result.tip().position_B_mm : Vector3d(Vector3d::Constant(NAN));
      data_.tips.push_back(
          {torque, method, scene::name(result.status), tip, distance_mm(result, own), distance_mm(result, fe)});
    };
    for (const std::string& law : torsion_laws()) {
      for (const int arcs : {12, 50, 500}) {
        const scene::Equilibrium result = fam::solve(scene, arc_options(law, arcs));
        record(fmt::format("{}_{}", law, arcs), result, kirchhoff);
        if (law == "bend_twist" && arcs == 12) record_shape(torque, "published_12", result);
      }
    }
    record("fourth_order_reissner_50", fam::solve(scene, arc_options("fourth_order", 50, fam::RodModel::reissner)),
           reissner);
    record("exact_kirchhoff", kirchhoff, kirchhoff);
    record("exact_reissner", reissner, reissner);
    record("fe", fe, reissner);
    record_shape(torque, "exact_kirchhoff", kirchhoff);
  }

  void record_shape(double torque, const std::string& method, const scene::Equilibrium& result) {
    if (torque != 0 && torque != 20 && torque != 50 && torque != 200) return;
    TorsionShape shape{torque, method, {}};
    for (int s_mm = 0; s_mm <= 40; ++s_mm) shape.positions_mm.push_back(position_at_mm(result, s_mm));
    data_.shapes.push_back(std::move(shape));
  }

  void find_orders(double torque) {
    const scene::Scene scene = with_torque(torque);
    const scene::Equilibrium kirchhoff = exact(scene, exact_reference::RodModel::kirchhoff);
    const auto error_mm = [&](const std::string& law, int arcs) {
      return distance_mm(fam::solve(scene, arc_options(law, arcs)), kirchhoff);
    };
    for (const std::string& law : torsion_laws()) {
      for (const int arcs : {3, 6, 12, 24, 48, 96, 192}) {
        data_.orders.push_back({torque, law, arcs, error_mm(law, arcs)});
      }
      for (const double limit_mm : {0.1, 0.01, 0.001}) {
        data_.arcs.push_back({torque, law, limit_mm, fewest_arcs(limit_mm, [&](int n) { return error_mm(law, n); })});
      }
    }
  }

  // The rest curvature that tendons along e_x amount to: K^-1 sum -r x T e_x.
  scene::Scene with_straight_tendons(scene::Scene scene) const {
    const scene::Stiffness stiffness = scene::stiffness_of(scene.sections[0]);
    Vector3d moment_Nmm = Vector3d::Zero();
    std::erase_if(scene.loads, [&](const scene::Load& load) {
      const scene::Tendon* tendon = scene::tendon_of(load);
      if (tendon) moment_Nmm += tendon->tension_N * Vector3d(0, -tendon->offset_mm[1], tendon->offset_mm[0]);
      return tendon != nullptr;
    });
    scene.sections[0].rest_curvature_per_mm +=
        Vector3d(0, moment_Nmm[1] / stiffness.bending_Nmm2[0], moment_Nmm[2] / stiffness.bending_Nmm2[1]);
    return scene;
  }

  void tilt_tendons(double torque) {
    scene::Scene scene = tendons_;
    scene.loads.push_back(scene::Moment{scene::length_mm(scene), scene::Frame::follower, {torque, 0, 0}});
    fam::Options fine;
    fine.tolerance_mm = 1e-8;
    const scene::Equilibrium fam = fam::solve(scene, fine), straight = fam::solve(with_straight_tendons(scene), fine);
    data_.tilts.push_back({torque, fam.tip().position_B_mm, straight.tip().position_B_mm,
                           distance_mm(fam, exact(scene, exact_reference::RodModel::kirchhoff)),
                           distance_mm(fam, fem_reference::solve(scene))});
  }

  // Doubling, then bisection.
  template <class Error>
  static int fewest_arcs(double limit_mm, const Error& error_mm) {
    int high = 1;
    while (high <= 100'000 && !(error_mm(high) < limit_mm)) high *= 2;
    if (high > 100'000) return 0;
    int low = high / 2;
    while (high - low > 1) (error_mm((low + high) / 2) < limit_mm ? high : low) = (low + high) / 2;
    return high;
  }

  void write() const {
    std::map<std::string, std::string> files = torsion_files(data_);
    files.merge(torsion_pictures(data_));
    write_results(folder_, "fam-studies torsion", files);
  }

  std::filesystem::path folder_;
  scene::Scene s1_, tendons_;
  TorsionData data_;
  Progress progress_;
};

}  // namespace

void torsion(const StudyOptions& options) {
  Torsion(options).run();
}

}  // namespace studies
