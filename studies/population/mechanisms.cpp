#include "studies/population/mechanisms.h"

#include "studies/compare/arc_trend.h"

#include <algorithm>
#include <stdexcept>

namespace studies {
namespace {

using Eigen::Vector3d;

const std::string follower_fe = "follower loads, shear and stretch";

ProgramSlips slips(Weakness weakness) {
  ProgramSlips s;
  s.weakness = weakness;
  return s;
}
ProgramSlips twisted_first() {
  return {.order = fam::TwistOrder::twist_bend};
}
ProgramSlips without_torsion() {
  return {.without_torsion = true};
}
ProgramSlips coarse_search(double tolerance, Search search = Search::bisection) {
  return slips({.search = search, .tolerance = tolerance});
}

void add_arcs(std::vector<Mechanism>& m) {
  for (const int arcs : {1, 2, 3, 4, 5, 6, 8, 12, 20, 50, 100})
    m.push_back({"arcs_" + std::to_string(arcs), "number of arcs",
                 std::to_string(arcs) + (arcs == 1 ? " arc" : " arcs") + ", bent first", follower_fe, arcs});
}

void add_single(std::vector<Mechanism>& m) {
  const std::string order = "order of the rotations";
  for (const int arcs : {5, 12, 50})
    m.push_back({"twisted_first_" + std::to_string(arcs), order, std::to_string(arcs) + " arcs, twisted first",
                 follower_fe, arcs, twisted_first()});

  const std::string model = "shear and stretch";
  m.push_back({"law_alone_12", model, "12 arcs", "follower loads, no shear", 12, {}, Side::follower_kirchhoff});
  m.push_back({"shear_alone", model, "the exact rod without shear", follower_fe, 0});

  const std::string search = "search stopped early";
  m.push_back({"bisection_1e-2", search, "12 arcs, bisection to 1e-2 rad", follower_fe, 12, coarse_search(1e-2)});
  m.push_back({"golden_1e-2", search, "12 arcs, golden section to 1e-2 rad", follower_fe, 12,
               coarse_search(1e-2, Search::golden)});
  m.push_back({"bisection_1e-3", search, "12 arcs, bisection to 1e-3 rad", follower_fe, 12, coarse_search(1e-3)});
  m.push_back({"bisection_1e-3_100", search, "100 arcs, bisection to 1e-3 rad", follower_fe, 100, coarse_search(1e-3)});

  const std::string precision = "single precision";
  for (const int arcs : {12, 100})
    m.push_back({"single_" + std::to_string(arcs), precision, std::to_string(arcs) + " arcs, single precision",
                 follower_fe, arcs, slips({.single_precision = true})});

  const std::string frame = "loads follow or stay";
  m.push_back({"fe_fixed", frame, "12 arcs, follower loads", "fixed loads", 12, {}, Side::fixed});
  m.push_back({"fam_fixed",
               frame,
               "the exact rod without shear, fixed loads",
               follower_fe,
               0,
               {},
               Side::follower,
               Side::fixed_kirchhoff});
  m.push_back({"fe_fixed_moment",
               frame,
               "12 arcs, follower loads",
               "moment keeps its axis, force follows",
               12,
               {},
               Side::fixed_moment});
  m.push_back({"fe_fixed_force",
               frame,
               "12 arcs, follower loads",
               "force keeps its direction, moment follows",
               12,
               {},
               Side::fixed_force});

  const std::string left_out = "torsion left out";
  m.push_back({"no_torsion_12", left_out, "12 arcs, no twist", follower_fe, 12, without_torsion()});
  m.push_back({"no_torsion_50", left_out, "50 arcs, no twist", follower_fe, 50, without_torsion()});

  const std::string slip = "slips of a program";
  m.push_back(
      {"distal_plane_12", slip, "12 arcs, plane from the distal moment", follower_fe, 12, {.distal_plane = true}});
  m.push_back(
      {"distal_plane_50", slip, "50 arcs, plane from the distal moment", follower_fe, 50, {.distal_plane = true}});
  m.push_back(
      {"middle_arm", slip, "12 arcs, force's arm to the chord's middle", follower_fe, 12, {.middle_arm = true}});
  m.push_back({"straight_in_arc", slip, "12 arcs, force not turned in the arc", follower_fe, 12,
               slips({.straight_in_arc = true})});
  m.push_back({"straight_to_next", slip, "12 arcs, force not turned from arc to arc", follower_fe, 12,
               slips({.straight_to_next = true})});
}

void add_pairs(std::vector<Mechanism>& m) {
  const std::string pairs = "pairs";
  m.push_back({"coarse_no_torsion", pairs, "5 arcs, no twist", follower_fe, 5, without_torsion()});
  m.push_back(
      {"coarse_distal_plane", pairs, "5 arcs, plane from the distal moment", follower_fe, 5, {.distal_plane = true}});
  m.push_back({"twisted_first_distal_plane",
               pairs,
               "12 arcs, twisted first, plane from the distal moment",
               follower_fe,
               12,
               {.order = fam::TwistOrder::twist_bend, .distal_plane = true}});
  ProgramSlips search_no_torsion = coarse_search(1e-2);
  search_no_torsion.without_torsion = true;
  m.push_back(
      {"search_no_torsion", pairs, "12 arcs, bisection to 1e-2 rad, no twist", follower_fe, 12, search_no_torsion});
  m.push_back({"fixed_straight_to_next", pairs, "12 arcs, force not turned from arc to arc", "fixed loads", 12,
               slips({.straight_to_next = true}), Side::fixed});
  m.push_back({"fixed_moment_no_torsion", pairs, "12 arcs, no twist", "moment keeps its axis, force follows", 12,
               without_torsion(), Side::fixed_moment});
}

TipLoadedRod rod_of(const PopulationRod& rod, const scene::Stiffness& stiffness, const TipLoad& load) {
  return {rod.length_mm, stiffness.bending_Nmm2[0], stiffness.torsion_Nmm2, load.force_N, load.moment_Nmm};
}

// The errors at the number of arcs that the paper's curve spans.
Trend over_arcs(const Mechanism& mechanism, const PopulationRod& rod, const LoadSet& set, const TipCase& c) {
  std::vector<ArcError> curve;
  for (const int arcs : {1, 2, 3, 4, 6, 8, 12, 16, 20, 30, 50, 100, 200, 500, 1000, 2000, 5000}) {
    const auto error = tip_error_mm(mechanism, rod, set, c, mechanism.arcs == 0 ? 0 : arcs);
    curve.push_back({arcs, error ? error->norm() : NAN});
  }
  return trend(curve);
}

// Empty where a side has no answer.
std::optional<bool> grows_with_torque(const Mechanism& mechanism, const PopulationRod& rod, const LoadSet& set,
                                      const TipCase& c) {
  std::vector<TipLoad> loads(6, c.load);
  for (std::size_t i = 0; i < loads.size(); ++i) loads[i].moment_Nmm[0] = 10. * static_cast<double>(i);
  const auto fe = tips_of(rod.length_mm, set.spatial_stiffness, loads, mechanism.fe_side);
  const auto instead = mechanism.arcs == 0 ? tips_of(rod.length_mm, set.spatial_stiffness, loads, mechanism.instead)
                                           : std::vector<Vector3d>();
  std::vector<double> errors;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    TipCase one;
    one.load = loads[i];
    one.tip_mm[static_cast<std::size_t>(mechanism.fe_side)] = fe[i];
    if (mechanism.arcs == 0) one.tip_mm[static_cast<std::size_t>(mechanism.instead)] = instead[i];
    const auto error = tip_error_mm(mechanism, rod, set, one, mechanism.arcs);
    if (!error || !error->allFinite()) return std::nullopt;
    errors.push_back(error->norm());
  }
  return std::is_sorted(errors.begin(), errors.end()) && errors.back() > errors.front();
}

}  // namespace

const std::vector<Mechanism>& all_mechanisms() {
  static const std::vector<Mechanism> rows = [] {
    std::vector<Mechanism> m;
    add_arcs(m);
    add_single(m);
    add_pairs(m);
    return m;
  }();
  return rows;
}

std::size_t mechanism_at(const std::string& key) {
  const std::vector<Mechanism>& all = all_mechanisms();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Mechanism& m) { return m.key == key; });
  if (found == all.end()) throw std::logic_error("no mechanism " + key);
  return static_cast<std::size_t>(found - all.begin());
}

std::optional<Vector3d> tip_error_mm(const Mechanism& mechanism, const PopulationRod& rod, const LoadSet& set,
                                     const TipCase& c, int arcs) {
  const Vector3d& fe = c.tip_of(mechanism.fe_side);
  if (arcs == 0) return c.tip_of(mechanism.instead) - fe;
  Vector3d tip;
  if (!published_tip(rod_of(rod, set.stiffness_of(c), c.load), arcs, mechanism.slips, tip)) return std::nullopt;
  return tip - fe;
}

std::optional<std::vector<Vector3d>> tip_errors_mm(const Mechanism& mechanism, const PopulationRod& rod,
                                                   const LoadSet& set) {
  std::vector<Vector3d> errors;
  for (const TipCase& c : set.cases) {
    const auto error = tip_error_mm(mechanism, rod, set, c, mechanism.arcs);
    if (!error) return std::nullopt;
    errors.push_back(*error);
  }
  return errors;
}

MechanismTrend trend_of(const Mechanism& mechanism, const PopulationRod& rod, const LoadSet& set) {
  MechanismTrend result;
  const auto errors = tip_errors_mm(mechanism, rod, set);
  if (!errors) return result;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < set.cases.size() && set.cases[i].load.planar; ++i) {
    if ((*errors)[i].norm() > (*errors)[worst].norm()) worst = i;
  }
  const auto grows = grows_with_torque(mechanism, rod, set, set.cases[static_cast<std::size_t>(rod.planar_cases)]);
  if (!grows) return result;
  const Trend t = over_arcs(mechanism, rod, set, set.cases[worst]);
  return {true, t.under_3_mm(), t.minimum_near_12(), t.rises(), *grows};
}

}  // namespace studies
