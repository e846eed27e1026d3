#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/segmentation/data.h"
#include "studies/compare/timing_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

const std::string ours = "Loads of our own; the paper's load values are lost. Follower loads, lengths in mm.";
const std::string floor_line =
    "Errors below 4e-11 mm (1e-12 L) are written as 4e-11: there the reference and the round-off end.";

std::string sweep_csv(const SegmentationData& data, bool p4) {
  Table table({"case", "law", "arcs", "error_exact_mm", "order", "error_fe_mm"});
  const SweepPoint* last = nullptr;
  for (const SweepPoint& p : data.points) {
    if ((p.load_case == "P4") == p4) {
      const bool follows = last != nullptr && last->law == p.law && last->load_case == p.load_case;
      table.add({p.load_case, p.law, std::to_string(p.arcs), error_text(p.exact_mm),
                 follows ? observed_order(last->arcs, last->exact_mm, p.arcs, p.exact_mm) : "–", error_text(p.fe_mm)});
    }
    last = &p;
  }
  return table.csv({ours, floor_line,
                    "error_exact: against the exact solution of the law's own rod model; error_fe: against 50 "
                    "quadratic finite elements with shear and stretch; order: from the row before."});
}

std::string references_csv(const SegmentationData& data) {
  Table table({"case", "exact_own_error_mm", "fe_own_error_mm", "shear_and_stretch_mm", "fixed_frame_mm"});
  for (const SweepReference& r : data.references) {
    table.add({r.load_case, error_text(r.exact_estimate_mm, 0), error_text(r.fe_estimate_mm, 0), fixed(r.shear_mm, 4),
               fixed(r.frame_mm, 4)});
  }
  return table.csv({ours, floor_line,
                    "own error: as estimated by the reference; shear_and_stretch: tip of the exact rod with and "
                    "without; fixed_frame: tip of the finite elements under the same components, fixed and follower."});
}

std::string fewest_csv(const SegmentationData& data) {
  Table table({"case", "law", "limit_mm", "fewest_arcs"});
  for (const FewestArcs& f : data.fewest) {
    const std::string none = f.law == "fam" ? "" : fmt::format(">{}", most_arcs_tried);
    table.add({f.load_case, f.law, fixed(f.limit_mm, 3), f.arcs ? std::to_string(f.arcs) : none});
  }
  return table.csv({ours,
                    "Fewest arcs such that they and all finer divisions tried keep the tip within the limit of the "
                    "exact Kirchhoff rod. fam: as many as the automatic choice takes at that tolerance."});
}

std::string budget_csv(const SegmentationData& data) {
  Table table({"load", "law", "arcs", "limit_mm", "largest_FL2_EI"});
  for (const Budget& b : data.budgets) {
    table.add({b.load, b.law, std::to_string(b.arcs), fixed(b.limit_mm, 2),
               b.beyond ? ">" + fixed(budget_load_max, 0) : fixed(b.largest_load, 3)});
  }
  return table.csv(
      {"Largest |F| L^2/EI such that it and every smaller one keep the tip within the limit of the exact "
       "Kirchhoff rod (searched up to 100). P4 scaled: force and moment of P4 by one factor."});
}

std::string shapes_csv(const SegmentationData& data) {
  Table table({"shape", "x_mm", "y_mm"});
  for (const SweepShape& shape : data.shapes) {
    for (const Eigen::Vector3d& p : shape.positions_mm) table.add({shape.name, fixed(p[0], 4), fixed(p[1], 4)});
  }
  return table.csv({ours, "P4, published law; equal steps of arc length from clamp to tip."});
}

std::string timing_csv(const SegmentationData& data) {
  Table table(with_timing_columns({"case", "law", "arcs"}));
  for (const SweepTime& t : data.times) {
    table.add(with_timing({t.load_case, t.law, t.arcs ? std::to_string(t.arcs) : ""}, t.timing, significant, 4));
  }
  return table.csv({machine_line(),
                    "The march from tip to clamp and the poses of all arc ends, warm. fam: all of fam::solve, the "
                    "number of arcs chosen."});
}

std::string error_of(const SegmentationData& data, const SweepLaw& law, int arcs, double SweepPoint::*error) {
  const SweepPoint* point = data.find("P4", law.key, arcs);
  return point ? error_for_reader(std::max(point->*error, error_floor_mm)) : "–";
}

}  // namespace

// 0 among the numbers, more than were tried, is the largest.
std::string arcs_cell(const SegmentationData& data, const std::string& law, bool planar, double limit_mm) {
  const std::vector<int> arcs = data.fewest_arcs(law, planar, limit_mm);
  const auto more = [](int a, int b) { return a != 0 && (b == 0 || a < b); };
  const auto [least, largest] = std::minmax_element(arcs.begin(), arcs.end(), more);
  const auto text = [](int n) { return n ? std::to_string(n) : fmt::format("> {}", most_arcs_tried); };
  return *least == *largest ? text(*least) : text(*least) + " to " + text(*largest);
}

std::string arcs_table(const SegmentationData& data) {
  std::vector<std::string> columns = {"arcs for a tip error below"};
  for (const double limit_mm : arc_limits_mm) columns.push_back(fmt::format("{:g} mm", limit_mm));
  Table table(columns);
  const auto add = [&](const std::string& name, const std::string& law) {
    for (const bool planar : {true, false}) {
      std::vector<std::string> cells{name + (planar ? ", in a plane" : ", in space")};
      for (const double limit_mm : arc_limits_mm) cells.push_back(arcs_cell(data, law, planar, limit_mm));
      table.add(cells);
    }
  };
  for (const SweepLaw& law : kirchhoff_laws()) add(law.label(), law.key);
  add(method_row("fam").name + " takes", "fam");
  return table.markdown();
}

std::string sweep_table(const SegmentationData& data) {
  std::vector<std::string> columns = {"N"};
  for (const SweepLaw& law : kirchhoff_laws()) columns.push_back(law.label());
  for (const char* key : {"published", "fourth_order_reissner"}) columns.push_back(sweep_law(key).label() + " − FE");
  Table table(columns);
  for (const int arcs : {1, 2, 4, 12, 50, 100, 500, 1000, 5000, 100'000, 1'000'000}) {
    std::vector<std::string> cells{std::to_string(arcs)};
    for (const SweepLaw& law : kirchhoff_laws()) cells.push_back(error_of(data, law, arcs, &SweepPoint::exact_mm));
    for (const char* key : {"published", "fourth_order_reissner"}) {
      cells.push_back(error_of(data, sweep_law(key), arcs, &SweepPoint::fe_mm));
    }
    table.add(cells);
  }
  return table.markdown();
}

std::string times_table(const SegmentationData& data) {
  Table table({"time of the march on P4, µs", "4 arcs", "12", "100", "1000"});
  for (const SweepLaw& law : sweep_laws()) {
    std::vector<std::string> cells{law.label()};
    for (const SweepTime& t : data.times) {
      const bool wanted = t.arcs == 4 || t.arcs == 12 || t.arcs == 100 || t.arcs == 1000;
      if (t.law == law.key && wanted) cells.push_back(significant(t.timing.median_us, 3));
    }
    table.add(cells);
  }
  return table.markdown();
}

std::map<std::string, std::string> segmentation_tables(const SegmentationData& data) {
  return {{"sweep_p4.csv", sweep_csv(data, true)},  {"sweep_cases.csv", sweep_csv(data, false)},
          {"references.csv", references_csv(data)}, {"fewest_arcs.csv", fewest_csv(data)},
          {"budget.csv", budget_csv(data)},         {"shapes.csv", shapes_csv(data)},
          {"timing.csv", timing_csv(data)}};
}

}  // namespace studies
