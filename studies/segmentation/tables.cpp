#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/scenes/cases.h"
#include "studies/segmentation/data.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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
  Table table({"law", "arcs", "median_us", "lower_quartile_us", "upper_quartile_us", "repeats"});
  for (const SweepTime& t : data.times) {
    table.add({t.law, std::to_string(t.arcs), fixed(t.timing.median_us, 2), fixed(t.timing.lower_quartile_us, 2),
               fixed(t.timing.upper_quartile_us, 2), std::to_string(t.timing.repeats)});
  }
  return table.csv({machine_line(), "P4: the march from tip to clamp and the poses of all arc ends, warm."});
}

}  // namespace

const SweepPoint* SegmentationData::find(const std::string& load_case, const std::string& law, int arcs) const {
  const auto found = std::find_if(points.begin(), points.end(), [&](const SweepPoint& p) {
    return p.load_case == load_case && p.law == law && p.arcs == arcs;
  });
  return found == points.end() ? nullptr : &*found;
}

const SweepReference& SegmentationData::reference(const std::string& load_case) const {
  const auto found = std::find_if(references.begin(), references.end(),
                                  [&](const SweepReference& r) { return r.load_case == load_case; });
  if (found == references.end()) throw std::logic_error("no reference for " + load_case);
  return *found;
}

std::vector<SweepPoint> SegmentationData::curve(const std::string& load_case, const std::string& law) const {
  std::vector<SweepPoint> list;
  std::copy_if(points.begin(), points.end(), std::back_inserter(list),
               [&](const SweepPoint& p) { return p.load_case == load_case && p.law == law; });
  return list;
}

std::map<std::string, std::string> segmentation_tables(const SegmentationData& data) {
  return {{"sweep_p4.csv", sweep_csv(data, true)},  {"sweep_cases.csv", sweep_csv(data, false)},
          {"references.csv", references_csv(data)}, {"budget.csv", budget_csv(data)},
          {"shapes.csv", shapes_csv(data)},         {"timing.csv", timing_csv(data)}};
}

}  // namespace studies
