// What the torsion study solved, and its tables, pictures and page as pure functions of it.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/methods/registry.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace studies {

// S1 and what the torque is measured in.
struct TorsionRod {
  double length_mm = 0;
  double bending_Nmm2 = 0, torsion_Nmm2 = 0;  // EI, GJ
  double diameter_mm = 0;
  Eigen::Vector3d tip_force_N = Eigen::Vector3d::Zero(), tip_moment_Nmm = Eigen::Vector3d::Zero();
};

// A law as this study's files spell it: bend_twist and twist_bend are the published one in both orders of its
// rotations.
struct TorsionLaw {
  std::string key;
  const MethodRow& row;
  bool twist_first;

  Request with(int arcs) const;  // a rod that neither shears nor stretches
  std::string label(int arcs = 0) const;
};
const std::vector<TorsionLaw>& torsion_laws();

// method: <law>_<arcs>, exact_kirchhoff, exact_reissner, fe. NaN where a method or its reference did not converge.
struct TorsionTip {
  double torque_Nmm;
  std::string method, status;
  Eigen::Vector3d position_mm;
  double own_mm;  // tip error against the exact solution of the method's own rod model
  double fe_mm;   // against finite elements with shear and stretch
};

struct TorsionOrder {
  double torque_Nmm;
  std::string law;
  int arcs;
  double own_mm;
};

// Fewest arcs with a tip error under the limit; 0: more than 100 000.
struct TorsionArcs {
  double torque_Nmm;
  std::string law;
  double limit_mm;
  int arcs;
};

// Three tendons (studies/cases/torsion/three_tendons.json) under a torque: tip with tendons along their own tangents,
// by FAM, and by the same rod whose tendons stay along e_x, a constant moment and so a rest curvature.
struct TendonTilt {
  double torque_Nmm;
  Eigen::Vector3d tip_mm, straight_tip_mm;
  double exact_mm, fe_mm;  // distance of FAM's tip from the exact one and that of the finite elements
};

struct TorsionShape {
  double torque_Nmm;
  std::string method;  // published_12, exact_kirchhoff
  std::vector<Eigen::Vector3d> positions_mm;
};

// scene: plane (S1's force alone: nothing twists), space (S1), torque (S1 and largest_printed_Nmm).
// law: of torsion_laws(), the march alone; fam: all of fam::solve, its automatic choice included (arcs 0).
struct TorsionTime {
  std::string scene, law;
  int arcs;
  Timing timing;
};

constexpr double largest_printed_Nmm = 50;  // the paper's range

struct TorsionData {
  TorsionRod rod;
  std::vector<double> torques_Nmm;
  std::vector<TorsionTip> tips;
  std::vector<TorsionOrder> orders;
  std::vector<TorsionArcs> arcs;
  std::vector<TorsionShape> shapes;
  std::vector<TendonTilt> tilts;
  std::vector<TorsionTime> times;

  const TorsionTip& tip(double torque_Nmm, const std::string& method) const;
  double own_mm(double torque_Nmm, const std::string& method) const { return tip(torque_Nmm, method).own_mm; }
  // Over the last doubling of the arcs whose errors are above round-off; "–" where there is none.
  std::string order_of(double torque_Nmm, const std::string& law) const;
  int fewest_arcs(double torque_Nmm, const std::string& law, double limit_mm) const;  // 0: more than 100 000
  const Timing& time(const std::string& scene, const std::string& law, int count) const;
};

// File name to content.
std::map<std::string, std::string> torsion_tables(const TorsionData& data);
std::map<std::string, std::string> torsion_pictures(const TorsionData& data);
std::map<std::string, std::string> torsion_pages(const TorsionData& data, const std::filesystem::path& page_md);

// Tables of the page.
std::string laws_table(const TorsionData& data);
std::string times_table(const TorsionData& data);
std::string printed_table(const TorsionData& data);
std::string beyond_table(const TorsionData& data);
std::string tilts_table(const TorsionData& data);

}  // namespace studies
