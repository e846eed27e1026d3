#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/compare/timing_cells.h"
#include "studies/torsion/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

double twist_rad(const TorsionRod& rod, double torque_Nmm) {
  return torque_Nmm * rod.length_mm / rod.torsion_Nmm2;
}

std::string tips_csv(const TorsionData& data) {
  Table table(
      {"torque_Nmm", "twist_TL_GJ_rad", "method", "status", "x_mm", "y_mm", "z_mm", "error_own_mm", "error_fe_mm"});
  for (const TorsionTip& t : data.tips) {
    const auto position = [&](int axis) { return t.status == "converged" ? fixed(t.position_mm[axis], 5) : ""; };
    table.add({fixed(t.torque_Nmm, 0), fixed(twist_rad(data.rod, t.torque_Nmm), 2), t.method, t.status, position(0),
               position(1), position(2), cell(t.own_mm, 2), cell(t.fe_mm, 2)});
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

std::string timing_csv(const TorsionData& data) {
  Table table(with_timing_columns({"scene", "law", "arcs"}));
  for (const TorsionTime& t : data.times) {
    table.add(with_timing({t.scene, t.law, t.arcs ? std::to_string(t.arcs) : ""}, t.timing, significant, 4));
  }
  return table.csv(
      {machine_line(),
       "plane: S1's force alone; space: S1; torque: S1 and 50 N mm. fam: all of fam::solve, the number of "
       "arcs chosen; else the march with the arcs given, warm. Repeats: rounds with all rows in turn, each the "
       "median of its runs."});
}

// T / (m g r_g) of the whole flexure.
double normalised_torque(const TorsionRod& rod, double torque_Nmm) {
  const double area_mm2 = std::numbers::pi * rod.diameter_mm * rod.diameter_mm / 4;
  const double mass_kg = 1e-9 * assumed_density_kg_per_m3 * area_mm2 * rod.length_mm;
  return torque_Nmm / (mass_kg * 9.81 * rod.diameter_mm / 4);
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
  return "none";
}

}  // namespace

std::string laws_table(const TorsionData& data) {
  Table table({"method", "12 arcs: off without torque, mm", "at 50 N mm", "order at 50 N mm", "arcs for 0.1 mm",
               "0.01 mm", "0.001 mm"});
  for (const TorsionLaw& law : torsion_laws()) {
    std::vector<std::string> cells{law.label()};
    for (const double torque : {0., largest_printed_Nmm}) {
      cells.push_back(error_for_reader(data.own_mm(torque, law.key + "_12")));
    }
    cells.push_back(data.order_of(largest_printed_Nmm, law.key));
    for (const double limit_mm : {0.1, 0.01, 0.001}) {
      const int arcs = data.fewest_arcs(largest_printed_Nmm, law.key, limit_mm);
      cells.push_back(arcs ? std::to_string(arcs) : "> 100 000");
    }
    table.add(cells);
  }
  return table.markdown();
}

std::string times_table(const TorsionData& data) {
  Table table({"µs", "in a plane", "in space", "and 50 N mm", "with arcs for 0.1 mm at 50 N mm"});
  const auto microseconds = [](const Timing& t) { return significant(t.median_us, 3); };
  for (const TorsionLaw& law : torsion_laws()) {
    std::vector<std::string> cells{law.label(12)};
    for (const char* scene : {"plane", "space", "torque"}) cells.push_back(microseconds(data.time(scene, law.key, 12)));
    const int arcs = data.fewest_arcs(largest_printed_Nmm, law.key, 0.1);
    cells.push_back(arcs ? microseconds(data.time("torque", law.key, arcs)) + " (" + counted(arcs, "arc") + ")" : "–");
    table.add(cells);
  }
  std::vector<std::string> cells{fmt::format("`fam solve`, which chooses ({:g} mm)", 1e-3 * data.rod.length_mm)};
  for (const char* scene : {"plane", "space", "torque"}) cells.push_back(microseconds(data.time(scene, "fam", 0)));
  cells.emplace_back("–");
  table.add(cells);
  return table.markdown();
}

std::string printed_table(const TorsionData& data) {
  Table table({"T, N mm", "T L/GJ, rad", "T/(m g r_g)", "FAM published x", "y", "z", "FE x", "y", "z", "FAM − FE, mm",
               "% of L", "own error, mm", "% of L"});
  for (const double torque : data.torques_Nmm) {
    if (torque > largest_printed_Nmm) continue;
    const TorsionTip &fam = data.tip(torque, "bend_twist_12"), &fe = data.tip(torque, "fe");
    std::vector<std::string> cells{fixed(torque, 0), fixed(twist_rad(data.rod, torque), 1),
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

std::string beyond_table(const TorsionData& data) {
  Table table({"method", "off by at 100 N mm, mm", "200", "500", "1000", "more than 10 % of L from T, N mm"});
  const auto add = [&](const std::string& name, const std::string& method) {
    std::vector<std::string> cells{name};
    for (const double torque : {100., 200., 500., 1000.}) {
      cells.push_back(error_for_reader(data.own_mm(torque, method)));
    }
    cells.push_back(fails_from(data, method));
    table.add(cells);
  };
  for (const TorsionLaw& law : torsion_laws()) {
    for (const int arcs : {12, 50}) add(law.label(arcs), law.key + "_" + std::to_string(arcs));
  }
  add(method_row("fe").name, "fe");
  return table.markdown();
}

std::string tilts_table(const TorsionData& data) {
  return tilts(data).markdown();
}

std::map<std::string, std::string> torsion_tables(const TorsionData& data) {
  return {{"tips.csv", tips_csv(data)},
          {"orders.csv", orders_csv(data)},
          {"arcs.csv", arcs_csv(data)},
          {"tendons.csv", tilts(data).csv()},
          {"timing.csv", timing_csv(data)}};
}

}  // namespace studies
