#include "studies/torsion/page.h"

#include "studies/report/table.h"
#include "studies/segmentation/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace studies {
namespace {

const std::string ours =
    "S1 with a follower torque about x at its tip; loads of our own, the paper's are lost. mm, N mm.";
const std::string floor_line = "Errors below 4e-11 mm (1e-12 L) are written as 4e-11.";
constexpr double assumed_density_kg_per_m3 = 1000;  // the paper gives none
constexpr double failed_share = 0.1;                // of L: what the page calls a failure

std::string cell(double error_mm, int digits) {
  return std::isfinite(error_mm) ? error_text(error_mm, digits) : "–";
}

std::string tips_csv(const TorsionData& data) {
  Table table(
      {"torque_Nmm", "twist_TL_GJ_rad", "method", "status", "x_mm", "y_mm", "z_mm", "error_own_mm", "error_fe_mm"});
  for (const TorsionTip& t : data.tips) {
    const auto position = [&](int axis) { return t.status == "converged" ? fixed(t.position_mm[axis], 5) : ""; };
    table.add({fixed(t.torque_Nmm, 0), fixed(t.torque_Nmm * data.rod.length_mm / data.rod.torsion_Nmm2, 2), t.method,
               t.status, position(0), position(1), position(2), cell(t.own_mm, 2), cell(t.fe_mm, 2)});
  }
  return table.csv({ours, floor_line,
                    "error_own: against the exact solution of the method's own rod model; error_fe: against 50 "
                    "quadratic finite elements with shear and stretch."});
}

std::string orders_csv(const TorsionData& data) {
  Table table({"torque_Nmm", "law", "arcs", "error_mm", "order"});
  const TorsionOrder* last = nullptr;
  for (const TorsionOrder& o : data.orders) {
    const bool follows = last != nullptr && last->law == o.law && last->torque_Nmm == o.torque_Nmm;
    table.add({fixed(o.torque_Nmm, 0), o.law, std::to_string(o.arcs), cell(o.own_mm, 2),
               follows ? observed_order(last->arcs, last->own_mm, o.arcs, o.own_mm) : "–"});
    last = &o;
  }
  return table.csv({ours, floor_line, "Against the exact Kirchhoff rod; order: from the row before."});
}

std::string arcs_csv(const TorsionData& data) {
  Table table({"torque_Nmm", "law", "limit_mm", "fewest_arcs"});
  for (const TorsionArcs& a : data.arcs) {
    table.add({fixed(a.torque_Nmm, 0), a.law, fixed(a.limit_mm, 3), a.arcs ? std::to_string(a.arcs) : ">100000"});
  }
  return table.csv({ours, "Fewest arcs with a tip error under the limit against the exact Kirchhoff rod."});
}

// T / (m g r_g) of the whole flexure.
double normalised_torque(const TorsionRod& rod, double torque_Nmm) {
  const double mass_kg = 1e-9 * assumed_density_kg_per_m3 * rod.section_area_mm2 * rod.length_mm;
  return torque_Nmm / (mass_kg * 9.81 * rod.gyration_radius_mm);
}

// The paper's Table 3 in form.
std::string comparison_table(const TorsionData& data) {
  Table table({"T, N mm", "T L/GJ, rad", "T/(m g r_g), ρ assumed", "FAM x", "y", "z", "FE x", "y", "z", "FAM − FE, mm",
               "% of L", "own error, mm", "% of L"});
  for (const double torque : data.torques_Nmm) {
    if (torque > 50) continue;
    const TorsionTip &fam = data.tip(torque, "bend_twist_12"), &fe = data.tip(torque, "fe");
    std::vector<std::string> cells{fixed(torque, 0), fixed(torque * data.rod.length_mm / data.rod.torsion_Nmm2, 1),
                                   fixed(normalised_torque(data.rod, torque), 0)};
    for (const TorsionTip* t : {&fam, &fe}) {
      for (int axis = 0; axis < 3; ++axis) cells.push_back(fixed(t->position_mm[axis], 3));
    }
    for (const double error : {fam.fe_mm, fam.own_mm}) {
      cells.push_back(fixed(error, 3));
      cells.push_back(fixed(100 * error / data.rod.length_mm, 2));
    }
    table.add(cells);
  }
  return table.markdown();
}

std::string methods_table(const TorsionData& data) {
  Table table({"T, N mm", "bend, twist 12", "50", "500", "twist, bend 12", "50", "500", "midpoint 12", "50",
               "fourth_order 12", "50", "sixth_order 12", "shear and stretch", "FE − exact"});
  for (const double torque : data.torques_Nmm) {
    std::vector<std::string> cells{fixed(torque, 0)};
    for (const char* method :
         {"bend_twist_12", "bend_twist_50", "bend_twist_500", "twist_bend_12", "twist_bend_50", "twist_bend_500",
          "midpoint_12", "midpoint_50", "fourth_order_12", "fourth_order_50", "sixth_order_12"}) {
      cells.push_back(cell(data.tip(torque, method).own_mm, 1));
    }
    const Eigen::Vector3d& kirchhoff = data.tip(torque, "exact_kirchhoff").position_mm;
    cells.push_back(cell((data.tip(torque, "exact_reissner").position_mm - kirchhoff).norm(), 1));
    cells.push_back(cell(data.tip(torque, "fe").own_mm, 1));
    table.add(cells);
  }
  return table.markdown();
}

double order_error(const TorsionData& data, double torque, const std::string& law, int arcs) {
  for (const TorsionOrder& o : data.orders) {
    if (o.torque_Nmm == torque && o.law == law && o.arcs == arcs) return o.own_mm;
  }
  return NAN;
}

// Over the last doubling whose errors are above round-off.
std::string order_of(const TorsionData& data, double torque, const std::string& law) {
  std::string order = "–";
  for (const int arcs : {24, 48, 96, 192}) {
    const std::string here =
        observed_order(arcs / 2, order_error(data, torque, law, arcs / 2), arcs, order_error(data, torque, law, arcs));
    if (here != "–") order = here;
  }
  return order;
}

std::string arcs_of(const TorsionData& data, double torque, const std::string& law, double limit_mm) {
  for (const TorsionArcs& a : data.arcs) {
    if (a.torque_Nmm == torque && a.law == law && a.limit_mm == limit_mm) {
      return a.arcs ? std::to_string(a.arcs) : "> 100 000";
    }
  }
  return "–";
}

std::string orders_table(const TorsionData& data) {
  Table table({"T, N mm", "law", "error at N = 12, mm", "N = 48", "N = 192", "order", "arcs for 0.1 mm", "0.01 mm",
               "0.001 mm"});
  for (const double torque : {0.0, 20.0, 50.0}) {
    for (const std::string& law : torsion_laws()) {
      std::vector<std::string> cells{fixed(torque, 0), law};
      for (const int arcs : {12, 48, 192}) cells.push_back(cell(order_error(data, torque, law, arcs), 1));
      cells.push_back(order_of(data, torque, law));
      for (const double limit : {0.1, 0.01, 0.001}) cells.push_back(arcs_of(data, torque, law, limit));
      table.add(cells);
    }
  }
  return table.markdown();
}

// Errors of FAM are round-off, of which one machine has another than the next.
Table tilts(const TorsionData& data) {
  Table table({"T, N mm", "tip x", "y", "z", "straight tendons x", "y", "z", "they are off by, mm", "FAM − exact, mm",
               "FAM − FE, mm"});
  for (const TendonTilt& t : data.tilts) {
    std::vector<std::string> cells{fixed(t.torque_Nmm, 0)};
    for (const Eigen::Vector3d* tip : {&t.tip_mm, &t.straight_tip_mm}) {
      for (const double x : *tip) cells.push_back(fixed(x, 3));
    }
    cells.push_back(fixed((t.tip_mm - t.straight_tip_mm).norm(), 3));
    cells.push_back(t.exact_mm < 1e-7 ? "< 1e-7" : scientific(t.exact_mm, 0));
    cells.push_back(t.fe_mm < 1e-7 ? "< 1e-7" : scientific(t.fe_mm, 0));
    table.add(cells);
  }
  return table;
}

// The first torque at which a method does not converge or is off by more than a tenth of L.
std::string fails_from(const TorsionData& data, const std::string& method) {
  for (const double torque : data.torques_Nmm) {
    const TorsionTip& t = data.tip(torque, method);
    if (t.status != "converged") return fixed(torque, 0) + " (" + t.status + ")";
    if (t.own_mm > failed_share * data.rod.length_mm) return fixed(torque, 0);
  }
  return "none up to " + fixed(data.torques_Nmm.back(), 0);
}

std::string failures_table(const TorsionData& data) {
  Table table({"method", "tip off by more than 10 % of L from T, N mm"});
  for (const char* method : {"bend_twist_12", "bend_twist_50", "bend_twist_500", "twist_bend_12", "twist_bend_50",
                             "twist_bend_500", "midpoint_12", "midpoint_50", "midpoint_500", "fourth_order_12",
                             "fourth_order_50", "fourth_order_500", "sixth_order_12", "sixth_order_50", "fe"}) {
    table.add({method, fails_from(data, method)});
  }
  return table.markdown();
}

std::string page(const TorsionData& data) {
  const auto own = [&](double torque, const std::string& method) { return cell(data.tip(torque, method).own_mm, 1); };
  return fmt::format(
      R"(# A torque at the tip: what decoupled bending and twist cost

The published method lets each arc bend in a plane and then twists it about its tangent (or the other way round; the
paper does not say), as if the two did not act on each other. The paper's check is its spatial load case 1 with a torque at
the tip from 0 to 50 mN·m (N mm); printed there: the error grows with the torque. The values of its Table 3 are lost.

**The loads are ours**: S1 is a rod of 40 × 6 mm, EI = 1500 and GJ = 1000 N mm², with a follower force (0, 1, 0) N and a moment
(0, −25, 0) N mm at the tip; the follower torque T about the tip's tangent is added to it. T L/GJ is the twist that T
alone would give: {twist50} rad at 50 N mm.

![Shapes at some torques](shapes.svg)

## The paper's Table 3, in form

Published law with 12 arcs, bend then twist, beside 50 quadratic finite elements with shear and stretch. *Own error*:
against the exact Kirchhoff rod, the same rod model. The paper divides the torque by m g r_g without giving a density; the
third column **assumes** {density:.0f} kg/m³ and takes m as the whole flexure's mass, r_g = d/4 = {gyration} mm, g = 9.81 m/s².

{comparison}
As printed for its loads, so here: the error grows with the torque, from {bt0} mm without torque to {bt50} mm at 50 N mm
(own error, bend then twist) and, after a dip, from {tb0} to {tb50} mm (twist then bend; all torques in the last table). With the same 12 arcs, coupled bending and
twist give {mid50} mm (midpoint), {four50} mm (fourth_order) and {six50} mm (sixth_order) at 50 N mm.

![Tip error over torque](errors.svg)

## Why: first order against second, fourth and sixth

Bending by β and twisting by α are rotations about different axes, and such rotations do not commute: applied one after
the other they miss the joint motion by about αβ/2 an arc. α and β are both proportional to h = L/N, so an arc errs by h² and N
arcs by N h² = L h: **first order**. The other laws turn each section by one rotation vector that holds
bend and twist together. Observed orders, over the finest doubling of N whose errors are above round-off:

{orders}
Without torque S1 still has a torsion moment inside the rod (the force acts beside the bent rod), so the published law is
first order there too. In the plane (P1–P8) nothing twists and it is second order
([segmentation](../segmentation/README.md)).

![Tip error over N](orders.svg)

What it costs: at 50 N mm the published law needs {bt_arcs} arcs (twist then bend: {tb_arcs}) for 0.01 mm, midpoint {mid_arcs},
fourth_order {four_arcs}, sixth_order {six_arcs}.

## On to where something fails

Tip error in mm against the exact Kirchhoff rod; *shear and stretch*: exact Reissner − exact Kirchhoff rod; *FE − exact*: the
finite elements against the exact rod with shear and stretch.

{methods}
{failures}
1000 N mm would twist the rod by {twist1000} rad: the last rows test the arithmetic, not a robot. Beyond some 150 N mm the
published law with 12 arcs turns each arc so far that its error no longer grows but wanders.

## Tendons under torsion

A frictionless tendon pulls along its own tangent v + u × r (Rucker and Webster 2011). Torsion tilts it round the rod,
which stiffens the rod by about T r² and takes from the bending. Three tendons of 6, 3 and 1.5 N at 3 mm
(`studies/cases/torsion/three_tendons.json`: 40 mm, EI = 750, GJ = 577 N mm²) and a follower torque at the tip; *straight tendons*:
the form that leaves the tilt out, a constant moment −r × T e_x. It is off by **{tilt50} mm at 50 N mm**.

{tilts}
## Files

`tips.csv`, `orders.csv`, `arcs.csv`, `tendons.csv`; `provenance.json`. Rerun: `build/release/bin/fam-studies torsion`. There are no times
here; an arc costs the same with and without torque ([times](../segmentation/timing.md)).
)",
      fmt::arg("twist50", fixed(50 * data.rod.length_mm / data.rod.torsion_Nmm2, 1)),
      fmt::arg("twist1000", fixed(1000 * data.rod.length_mm / data.rod.torsion_Nmm2, 0)),
      fmt::arg("density", assumed_density_kg_per_m3), fmt::arg("gyration", fixed(data.rod.gyration_radius_mm, 1)),
      fmt::arg("comparison", comparison_table(data)), fmt::arg("bt0", own(0, "bend_twist_12")),
      fmt::arg("bt50", own(50, "bend_twist_12")), fmt::arg("tb0", own(0, "twist_bend_12")),
      fmt::arg("tb50", own(50, "twist_bend_12")), fmt::arg("mid50", own(50, "midpoint_12")),
      fmt::arg("four50", own(50, "fourth_order_12")), fmt::arg("orders", orders_table(data)),
      fmt::arg("bt_arcs", arcs_of(data, 50, "bend_twist", 0.01)),
      fmt::arg("tb_arcs", arcs_of(data, 50, "twist_bend", 0.01)),
      fmt::arg("mid_arcs", arcs_of(data, 50, "midpoint", 0.01)),
      fmt::arg("tilt50", fixed((data.tilts.back().tip_mm - data.tilts.back().straight_tip_mm).norm(), 1)),
      fmt::arg("tilts", tilts(data).markdown()), fmt::arg("six50", own(50, "sixth_order_12")),
      fmt::arg("six_arcs", arcs_of(data, 50, "sixth_order", 0.01)),
      fmt::arg("four_arcs", arcs_of(data, 50, "fourth_order", 0.01)), fmt::arg("methods", methods_table(data)),
      fmt::arg("failures", failures_table(data)));
}

std::string headline(const TorsionData& data) {
  const auto own = [&](const std::string& method) { return cell(data.tip(50, method).own_mm, 1); };
  return fmt::format(
      "## [Torsion](torsion/README.md): what decoupled bending and twist cost\n\n"
      "Spatial case S1 (our loads) with a follower torque of 50 N mm at the tip, 12 arcs: the published law is {} mm "
      "off "
      "its own rod model (bend then twist) or {} mm (twist then bend), coupled arcs {} mm (midpoint) and {} mm "
      "(fourth_order). Decoupled arcs are first order in space: for 0.01 mm they need {} arcs, fourth-order ones "
      "{}.\n\n"
      "![Tip error over torque](torsion/errors.svg)\n",
      own("bend_twist_12"), own("twist_bend_12"), own("midpoint_12"), own("fourth_order_12"),
      arcs_of(data, 50, "bend_twist", 0.01), arcs_of(data, 50, "fourth_order", 0.01));
}

}  // namespace

const std::vector<std::string>& torsion_laws() {
  static const std::vector<std::string> laws = {"bend_twist", "twist_bend", "midpoint", "fourth_order", "sixth_order"};
  return laws;
}

const TorsionTip& TorsionData::tip(double torque_Nmm, const std::string& method) const {
  const auto found = std::find_if(
      tips.begin(), tips.end(), [&](const TorsionTip& t) { return t.torque_Nmm == torque_Nmm && t.method == method; });
  if (found == tips.end()) throw std::logic_error("no tip of " + method);
  return *found;
}

std::map<std::string, std::string> torsion_files(const TorsionData& data) {
  return {{"README.md", page(data)},        {"headline.md", headline(data)}, {"tips.csv", tips_csv(data)},
          {"orders.csv", orders_csv(data)}, {"arcs.csv", arcs_csv(data)},    {"tendons.csv", tilts(data).csv()}};
}

}  // namespace studies
