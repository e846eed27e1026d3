// fam-studies torsion: reads studies/cases/study1/S1_follower.json, adds a follower torque at the tip from 0 to 1000 N
// mm, solves by the arc laws, exactly and by finite elements, times the march with and without torsion, and writes
// tables, pictures and the page to results/torsion. Some ten seconds.
#include "studies/compare/error_measures.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/study.h"
#include "studies/torsion/data.h"

#include <fmt/format.h>

#include <cmath>

namespace studies {
namespace {

using Eigen::Vector3d;
using scene::RodModel;

const std::vector<double> torques_Nmm = {0,  5,  10,  15,  20,  25,  30,  35,  40,  45,
                                         50, 75, 100, 150, 200, 300, 500, 700, 1000};

double distance_mm(const scene::Equilibrium& a, const scene::Equilibrium& b) {
  return a.converged() && b.converged() ? (a.tip().position_B_mm - b.tip().position_B_mm).norm() : NAN;
}

scene::Equilibrium solved(const TorsionLaw& law, int arcs, const scene::Scene& scene) {
  return law.row(law.with(arcs))->solve(scene);
}

scene::Equilibrium exact(const scene::Scene& scene, RodModel model) {
  Request request;
  request.model = model;
  return method_row("exact")(request)->solve(scene);
}

TorsionRod rod_of(const scene::Scene& s1) {
  const scene::Stiffness stiffness = scene::stiffness_of(s1.sections[0]);
  TorsionRod rod{scene::length_mm(s1), stiffness.bending_Nmm2[1], stiffness.torsion_Nmm2,
                 std::get<scene::CircularSection>(s1.sections[0].cross_section).outer_diameter_mm};
  for (const scene::Load& load : s1.loads) {
    if (const auto* force = known_load<scene::Force>(load)) rod.tip_force_N += force->value_N;
    if (const auto* moment = known_load<scene::Moment>(load)) rod.tip_moment_Nmm += moment->value_Nmm;
  }
  return rod;
}

scene::Scene with_torque(scene::Scene scene, double torque_Nmm) {
  scene.loads.push_back(scene::Moment{scene::length_mm(scene), scene::Frame::follower, {torque_Nmm, 0, 0}});
  return scene;
}

// The rest curvature that tendons along e_x amount to: K^-1 sum -r x T e_x.
scene::Scene with_straight_tendons(scene::Scene scene) {
  const scene::Stiffness stiffness = scene::stiffness_of(scene.sections[0]);
  Vector3d moment_Nmm = Vector3d::Zero();
  std::erase_if(scene.loads, [&](const scene::Load& load) {
    const auto* tendon = known_load<scene::Tendon>(load);
    if (tendon) moment_Nmm += tendon->tension_N * Vector3d(0, -tendon->offset_mm[1], tendon->offset_mm[0]);
    return tendon != nullptr;
  });
  scene.sections[0].rest_curvature_per_mm +=
      Vector3d(0, moment_Nmm[1] / stiffness.bending_Nmm2[0], moment_Nmm[2] / stiffness.bending_Nmm2[1]);
  return scene;
}

// Doubling, then bisection.
template <class Error>
int fewest_arcs(double limit_mm, const Error& error_mm) {
  int high = 1;
  while (high <= 100'000 && !(error_mm(high) < limit_mm)) high *= 2;
  if (high > 100'000) return 0;
  int low = high / 2;
  while (high - low > 1) (error_mm((low + high) / 2) < limit_mm ? high : low) = (low + high) / 2;
  return high;
}

class Torsion {
 public:
  explicit Torsion(const StudyOptions& options)
      : options_(options),
        s1_(read_case(options.cases, "study1/S1_follower")),
        tendons_(read_case(options.cases, "torsion/three_tendons")),
        progress_("torsion", torques_Nmm.size() + 1, options.progress) {
    data_.rod = rod_of(s1_);
    data_.torques_Nmm = torques_Nmm;
  }

  void run() {
    for (const double torque : torques_Nmm) solve_torque(torque);
    for (const double torque : {0., 20., largest_printed_Nmm}) find_orders(torque);
    for (const double torque : {0., 5., 10., 20., 30., 40., 50.}) tilt_tendons(torque);
    progress_.step("times");
    take_times();
    std::map<std::string, std::string> files = torsion_tables(data_);
    files.merge(torsion_pictures(data_));
    files.merge(torsion_pages(data_, options_.pages / "torsion" / "page.md"));
    write_results(options_.output / "torsion", "fam-studies torsion", files);
  }

 private:
  void solve_torque(double torque) {
    progress_.step(fmt::format("{} N mm", torque));
    const scene::Scene scene = with_torque(s1_, torque);
    const scene::Equilibrium kirchhoff = exact(scene, RodModel::kirchhoff);
    const scene::Equilibrium reissner = exact(scene, RodModel::reissner);
    const scene::Equilibrium fe = method_row("fe")()->solve(scene);
    const auto record = [&](const std::string& method, const scene::Equilibrium& result,
                            const scene::Equilibrium& own) {
      const Vector3d tip = result.converged() ? result.tip().position_B_mm : Vector3d(Vector3d::Constant(NAN));
      data_.tips.push_back(
          {torque, method, scene::name(result.status), tip, distance_mm(result, own), distance_mm(result, fe)});
    };
    for (const TorsionLaw& law : torsion_laws()) {
      for (const int arcs : {12, 50, 500}) {
        const scene::Equilibrium result = solved(law, arcs, scene);
        record(fmt::format("{}_{}", law.key, arcs), result, kirchhoff);
        if (law.key == "bend_twist" && arcs == 12) record_shape(torque, "published_12", result);
      }
    }
    Request with_shear;
    with_shear.count = 50;
    with_shear.model = RodModel::reissner;
    with_shear.estimate_error = false;
    record("fourth_order_reissner_50", method_row("fam_fourth_order")(with_shear)->solve(scene), reissner);
    record("exact_kirchhoff", kirchhoff, kirchhoff);
    record("exact_reissner", reissner, reissner);
    record("fe", fe, reissner);
    record_shape(torque, "exact_kirchhoff", kirchhoff);
  }

  void record_shape(double torque, const std::string& method, const scene::Equilibrium& result) {
    if (torque != 0 && torque != 20 && torque != 50) return;
    TorsionShape shape{torque, method, {}};
    for (int i = 0; i <= 40; ++i) shape.positions_mm.push_back(position_at_mm(result, data_.rod.length_mm * i / 40));
    data_.shapes.push_back(std::move(shape));
  }

  void find_orders(double torque) {
    const scene::Scene scene = with_torque(s1_, torque);
    const scene::Equilibrium kirchhoff = exact(scene, RodModel::kirchhoff);
    for (const TorsionLaw& law : torsion_laws()) {
      const auto error_mm = [&](int arcs) { return distance_mm(solved(law, arcs, scene), kirchhoff); };
      for (const int arcs : {3, 6, 12, 24, 48, 96, 192}) {
        data_.orders.push_back({torque, law.key, arcs, error_mm(arcs)});
      }
      for (const double limit_mm : {0.1, 0.01, 0.001}) {
        data_.arcs.push_back({torque, law.key, limit_mm, fewest_arcs(limit_mm, error_mm)});
      }
    }
  }

  void tilt_tendons(double torque) {
    const scene::Scene scene = with_torque(tendons_, torque);
    Request fine;
    fine.tolerance = 1e-8 / scene::length_mm(scene);
    const auto fam = method_row("fam")(fine);
    const scene::Equilibrium tilted = fam->solve(scene), straight = fam->solve(with_straight_tendons(scene));
    data_.tilts.push_back({torque, tilted.tip().position_B_mm, straight.tip().position_B_mm,
                           distance_mm(tilted, exact(scene, RodModel::kirchhoff)),
                           distance_mm(tilted, method_row("fe")()->solve(scene))});
  }

  struct Timed {
    std::string scene, law;
    int arcs;
    std::function<void()> work;
    std::vector<double> rounds_us;
  };

  std::vector<Timed> works() const {
    std::vector<Timed> list;
    scene::Scene plane = s1_;
    std::erase_if(plane.loads, [](const scene::Load& load) { return known_load<scene::Moment>(load) != nullptr; });
    const scene::Scene torque = with_torque(s1_, largest_printed_Nmm);
    for (const auto& [name, scene] :
         {std::pair<std::string, const scene::Scene&>{"plane", plane}, {"space", s1_}, {"torque", torque}}) {
      for (const TorsionLaw& law : torsion_laws()) {
        list.push_back({name, law.key, 12, law.row(law.with(12))->bare_solve(scene), {}});
      }
      list.push_back({name, "fam", 0, method_row("fam")()->bare_solve(scene), {}});
    }
    for (const TorsionLaw& law : torsion_laws()) {  // as many as it takes
      const int arcs = data_.fewest_arcs(largest_printed_Nmm, law.key, 0.1);
      if (arcs != 12 && arcs > 0)
        list.push_back({"torque", law.key, arcs, law.row(law.with(arcs))->bare_solve(torque), {}});
    }
    return list;
  }

  // All in turn, round by round: a processor that slows down slows all of them.
  void take_times() {
    std::vector<Timed> list = works();
    const int rounds = options_.quick ? 1 : 15;
    for (int i = 0; i < rounds; ++i) {
      for (Timed& timed : list) timed.rounds_us.push_back(time_of(options_, timed.work, 0.01).median_us);
    }
    for (const Timed& timed : list) {
      const auto quartile = [&](double share) { return quantile(timed.rounds_us, share); };
      data_.times.push_back(
          {timed.scene, timed.law, timed.arcs, {quartile(0.5), quartile(0.25), quartile(0.75), rounds}});
    }
  }

  StudyOptions options_;
  scene::Scene s1_, tendons_;
  TorsionData data_;
  Progress progress_;
};

}  // namespace

void torsion(const StudyOptions& options) {
  Torsion(options).run();
}

}  // namespace studies
