#include "studies/segmentation/sweep.h"

#include "fam/march.h"
#include "fam/solver.h"
#include "studies/report/table.h"
#include "studies/scenes/cases.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace studies {

const std::vector<int> all_arcs = {1,   2,    3,    4,    6,     8,     12,    20,     30,     50,     100,    200,
                                   500, 1000, 2000, 5000, 10000, 20000, 50000, 100000, 200000, 500000, 1000000};
const std::vector<int> few_arcs = {1, 2, 4, 12, 50, 500, 5000};

namespace {

using Eigen::Vector3d;
using exact_reference::Elastica;
using exact_reference::PlanarCantilever;

fam::Solver kept_solver(const scene::Scene& scene, const SweepLaw& law, int arcs) {
  fam::Options options;
  options.law = law.law;
  options.model = law.model;
  options.arcs = arcs;
  options.estimate_error = false;
  return std::get<fam::Solver>(fam::Solver::make(scene, options));
}

// Empty where an arc's angle was not found, or its series does not reach its end.
std::optional<Vector3d> marched_tip_mm(const scene::Scene& scene, const SweepLaw& law, int arcs) {
  fam::Solver solver = kept_solver(scene, law, arcs);
  if (!solver.solve().converged()) return {};
  return solver.tip().position_B_mm;
}

Vector3d in_space(const exact_reference::PlanarPose& pose) {
  return {pose.position_B_mm[0], pose.position_B_mm[1], 0};
}

Vector3d tip_mm(const char* method, const scene::Scene& scene, scene::RodModel model) {
  Request request;
  request.model = model;
  request.estimate_error = false;
  return method_row(method)(request)->solve(scene).tip().position_B_mm;
}

// The error of the tip with N arcs, as a user gets it: infinite where there is no answer.
class TipError {
 public:
  TipError(const scene::Scene& scene, const SweepLaw& law, const Vector3d& exact_mm)
      : scene_(scene), law_(law), exact_mm_(exact_mm) {}

  double operator()(int arcs) const {
    const scene::Equilibrium result = law_.row(law_.with(arcs))->solve(scene_);
    return result.converged() ? (result.tip().position_B_mm - exact_mm_).norm() : INFINITY;
  }

 private:
  const scene::Scene& scene_;
  const SweepLaw& law_;
  Vector3d exact_mm_;
};

int next_arcs(int arcs) {
  return arcs < 20 ? arcs + 1 : arcs + arcs / 10;
}

// For all arc_limits_mm: errors at growing numbers of arcs until they are safely below the least, then bisection
// between the last number that misses a limit and the next.
std::vector<int> fewest_for_limits(const TipError& error_mm) {
  const double least_mm = *std::min_element(arc_limits_mm.begin(), arc_limits_mm.end());
  std::vector<std::pair<int, double>> errors;
  int small_in_a_row = 0;
  for (int arcs = 1; arcs <= most_arcs_tried && small_in_a_row < 3; arcs = next_arcs(arcs)) {
    errors.emplace_back(arcs, error_mm(arcs));
    small_in_a_row = errors.back().second < 0.7 * least_mm ? small_in_a_row + 1 : 0;
  }
  std::vector<int> fewest;
  for (const double limit_mm : arc_limits_mm) {
    int low = 0, high = 0;
    for (const auto& [arcs, error] : errors) {
      if (!(error < limit_mm)) low = arcs, high = 0;
      else if (high == 0) high = arcs;
    }
    while (high - low > 1) (error_mm((low + high) / 2) < limit_mm ? high : low) = (low + high) / 2;
    fewest.push_back(high);
  }
  return fewest;
}

int arcs_chosen(const scene::Scene& scene, double tolerance_mm) {
  Request request;
  request.tolerance = tolerance_mm / scene::length_mm(scene);
  const scene::Equilibrium result = method_row("fam")(request)->solve(scene);
  for (const auto& [name, value] : result.model) {
    if (name == "arcs") return std::get<int>(value);
  }
  return 0;
}

// P4's rod loaded at the tip by (0, F_y) and M_z.
scene::Scene planar_scene(const scene::Scene& p4, double force_N, double moment_Nmm) {
  scene::Scene scene = p4;
  const double length = scene::length_mm(p4);
  scene.loads = {scene::Force{length, scene::Frame::follower, {0, force_N, 0}},
                 scene::Moment{length, scene::Frame::follower, {0, 0, moment_Nmm}}};
  return scene;
}

// Tip error of a planar load in units of |F| L^2/EI.
double budget_error_mm(const scene::Scene& p4, const std::string& load, const SweepLaw& law, int arcs, double size) {
  PlanarCantilever rod = cantilever_of(p4);
  const double force = size * rod.bending_stiffness_Nmm2 / (rod.length_mm * rod.length_mm);
  const double given_N = rod.tip_force_N[1];
  const double moment_Nmm = load == "P4 scaled" ? force * rod.tip_moment_Nmm / std::abs(given_N) : 0;
  const double force_N = load == "P4 scaled" ? std::copysign(force, given_N) : force;
  rod.tip_force_N = {0, force_N};
  rod.tip_moment_Nmm = moment_Nmm;
  const std::optional<Vector3d> tip = marched_tip_mm(planar_scene(p4, force_N, moment_Nmm), law, arcs);
  return tip ? (*tip - in_space(Elastica::with_follower_load(rod).tip())).norm() : INFINITY;
}

// Upwards in steps of 5 % until the error passes the limit, then bisection.
Budget budget(const scene::Scene& p4, const std::string& load, const SweepLaw& law, int arcs, double limit_mm) {
  const auto holds = [&](double size) { return budget_error_mm(p4, load, law, arcs, size) < limit_mm; };
  double low = 0, high = 0.01;
  while (high < budget_load_max && holds(high)) {
    low = high;
    high *= 1.05;
  }
  if (high >= budget_load_max) return {load, law.key, arcs, limit_mm, budget_load_max, true};
  for (int i = 0; i < 30; ++i) (holds((low + high) / 2) ? low : high) = (low + high) / 2;
  return {load, law.key, arcs, limit_mm, low, false};
}

}  // namespace

PlanarCantilever cantilever_of(const scene::Scene& scene) {
  PlanarCantilever rod{scene::length_mm(scene), scene::stiffness_of(scene.sections[0]).bending_Nmm2[1]};
  for (const scene::Load& load : scene.loads) {
    if (const auto* force = known_load<scene::Force>(load)) rod.tip_force_N += force->value_N.head<2>();
    if (const auto* moment = known_load<scene::Moment>(load)) rod.tip_moment_Nmm += moment->value_Nmm[2];
  }
  return rod;
}

void sweep_case(const std::string& load_case, const scene::Scene& scene, const scene::Scene& fixed,
                SegmentationData& data) {
  Request as_kirchhoff;
  as_kirchhoff.model = scene::RodModel::kirchhoff;
  const scene::Equilibrium kirchhoff = method_row("exact")(as_kirchhoff)->solve(scene);
  const scene::Equilibrium fe = method_row("fe")()->solve(scene);
  const bool closed_form = load_case == "P4";
  const Vector3d tip =
      closed_form ? in_space(Elastica::with_follower_load(cantilever_of(scene)).tip()) : kirchhoff.tip().position_B_mm;
  const Vector3d fe_tip = fe.tip().position_B_mm;
  const Vector3d reissner_tip = tip_mm("exact", scene, scene::RodModel::reissner);
  data.references.push_back({load_case, closed_form ? 1e-13 * scene::length_mm(scene) : kirchhoff.error_estimate_mm,
                             fe.error_estimate_mm, (reissner_tip - tip).norm(),
                             (tip_mm("fe", fixed, scene::RodModel::automatic) - fe_tip).norm()});
  for (const SweepLaw& law : sweep_laws()) {
    for (const int arcs : closed_form ? all_arcs : few_arcs) {
      const std::optional<Vector3d> marched = marched_tip_mm(scene, law, arcs);
      if (!marched) continue;
      const Vector3d& own = law.shears() ? reissner_tip : tip;
      data.points.push_back({load_case, law.key, arcs, (*marched - own).norm(), (*marched - fe_tip).norm()});
    }
  }
}

void find_fewest_arcs(const std::string& load_case, const scene::Scene& scene, SegmentationData& data) {
  const Vector3d exact = tip_mm("exact", scene, scene::RodModel::kirchhoff);
  for (const SweepLaw& law : kirchhoff_laws()) {
    const std::vector<int> fewest = fewest_for_limits(TipError(scene, law, exact));
    for (std::size_t i = 0; i < fewest.size(); ++i) {
      data.fewest.push_back({load_case, law.key, arc_limits_mm[i], fewest[i]});
    }
  }
  for (const double limit_mm : arc_limits_mm) {
    data.fewest.push_back({load_case, "fam", limit_mm, arcs_chosen(scene, limit_mm)});
  }
}

void find_budgets(const scene::Scene& p4, SegmentationData& data) {
  for (const std::string load : {"P4 scaled", "transverse force"}) {
    for (const SweepLaw& law : kirchhoff_laws()) {
      for (const int arcs : {1, 2, 4, 8, 12, 20, 50, 100, 200, 500}) {
        for (const double limit_mm : {0.01, 0.1, 1.0}) data.budgets.push_back(budget(p4, load, law, arcs, limit_mm));
      }
    }
  }
}

void draw_shapes(const scene::Scene& p4, SegmentationData& data) {
  for (const int arcs : {1, 2, 3, 12, 500}) {
    const std::vector<scene::Span> spans = scene::spans_of(p4);
    fam::March march;
    march.set(spans, scene::cells_per_span(spans, arcs), fam::Law::published, scene::RodModel::kirchhoff);
    if (march.run() != scene::Status::converged) continue;
    SweepShape shape{counted(arcs, "arc"), {}};
    for (int i = 0; i <= 48; ++i) {
      const int arc = std::min(arcs - 1, i * arcs / 48);
      const auto index = static_cast<std::size_t>(arc);
      const double fraction = static_cast<double>(i) * arcs / 48 - arc;
      shape.positions_mm.push_back(fam::pose_on(march.arcs()[index], march.poses()[index], fraction).position_B_mm);
    }
    data.shapes.push_back(std::move(shape));
  }
  const Elastica elastica = Elastica::with_follower_load(data.p4);
  SweepShape exact{"exact", {}};
  for (int i = 0; i <= 20; ++i) {
    exact.positions_mm.push_back(in_space(elastica.at(data.p4.length_mm * i / 20)));
  }
  data.shapes.push_back(std::move(exact));
}

}  // namespace studies
