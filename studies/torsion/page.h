// The tables, pictures and page of the torsion sweep, as pure functions of what was solved.
#pragma once

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace studies {

// What the torque is measured in.
struct TorsionRod {
  double length_mm = 0;
  double torsion_Nmm2 = 0;      // GJ
  double section_area_mm2 = 0;  // for the paper's normalisation alone
  double gyration_radius_mm = 0;
};

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

struct TorsionData {
  TorsionRod rod;
  std::vector<double> torques_Nmm;
  std::vector<TorsionTip> tips;
  std::vector<TorsionOrder> orders;
  std::vector<TorsionArcs> arcs;
  std::vector<TorsionShape> shapes;
  std::vector<TendonTilt> tilts;

  const TorsionTip& tip(double torque_Nmm, const std::string& method) const;
};

// bend_twist, twist_bend (the published law in both orders of its rotations), midpoint, fourth_order, sixth_order.
const std::vector<std::string>& torsion_laws();

std::map<std::string, std::string> torsion_files(const TorsionData& data);
std::map<std::string, std::string> torsion_pictures(const TorsionData& data);

}  // namespace studies
