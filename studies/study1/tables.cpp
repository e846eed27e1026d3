#include "studies/compare/error_measures.h"
#include "studies/compare/printed_statistics.h"
#include "studies/compare/timing_cells.h"
#include "studies/report/page.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/study1/page.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

// Statistics along one axis over the cases that both methods solved.
Statistics statistics_of(const Study1Data& data, bool planar, const std::string& frame, const std::string& a,
                         const std::string& b, int axis) {
  std::vector<double> values;
  for (const std::string& load_case : study1_cases(planar)) {
    if (const auto* d = difference(data, load_case, frame, a, b)) values.push_back(d->tip_mm[axis]);
  }
  return values.empty() ? Statistics{} : statistics(values);
}

const std::string ours = "Loads of our own (README.md); the paper's load values are lost. Lengths in mm, base frame.";

std::string tips_csv(const Study1Data& data) {
  Table table({"case", "frame", "method", "status", "x_mm", "y_mm", "z_mm"});
  for (const Study1Tip& t : data.tips) {
    const bool solved = t.status == "converged";
    const auto cell = [&](int axis) { return solved ? fixed(t.position_mm[axis], 6) : std::string(); };
    table.add({t.load_case, t.frame, t.method, t.status, cell(0), cell(1), cell(2)});
  }
  return table.csv({ours});
}

std::string differences_csv(const Study1Data& data) {
  Table table({"case", "frame", "method", "minus", "dx_mm", "dy_mm", "dz_mm", "distance_mm", "shape_largest_mm",
               "shape_rms_mm"});
  for (const Study1Difference& d : data.differences) {
    table.add({d.load_case, d.frame, d.a, d.b, fixed(d.tip_mm[0], 6), fixed(d.tip_mm[1], 6), fixed(d.tip_mm[2], 6),
               fixed(d.tip_mm.norm(), 6), fixed(d.shape_largest_mm, 6), fixed(d.shape_rms_mm, 6)});
  }
  return table.csv({ours, "method - minus at the tip; shape: distance of the centrelines at 40 equal arc lengths."});
}

std::string shapes_csv(const Study1Data& data) {
  Table table({"case", "frame", "method", "s_mm", "x_mm", "y_mm", "z_mm"});
  for (const Study1Shape& shape : data.shapes) {
    for (std::size_t s = 0; s < shape.positions_mm.size(); ++s) {
      const auto& p = shape.positions_mm[s];
      table.add({shape.load_case, shape.frame, shape.method, std::to_string(s), fixed(p[0], 4), fixed(p[1], 4),
                 fixed(p[2], 4)});
    }
  }
  return table.csv({ours});
}

void add_summary(Table& table, const Study1Data& data, const std::string& frame, const std::string& a,
                 const std::string& b) {
  for (const PrintedStatistics& p : printed_statistics()) {
    const Statistics s = statistics_of(data, p.planar, frame, a, b, p.axis);
    if (s.root_mean_square == 0) continue;
    table.add({p.planar ? "planar" : "spatial", frame, a, b, std::string(1, "xyz"[p.axis]), fixed(s.mean, 6),
               fixed(s.standard_deviation, 6), fixed(s.mean_absolute, 6), fixed(s.absolute_deviation, 6),
               fixed(s.root_mean_square, 6)});
  }
}

std::string summary_csv(const Study1Data& data) {
  Table table({"set", "frame", "method", "minus", "axis", "mean_mm", "sd_mm", "mae_mm", "mae_sd_mm", "rms_mm"});
  for (const Study1Group& group : study1_groups()) {
    for (const std::string frame : {"follower", "fixed"}) {
      for (const auto& [a, b] : group.pairs) add_summary(table, data, frame, a, b);
    }
  }
  return table.csv({ours, "Over the eight cases of a set: mean e, SD (n - 1), mean |e|, SD of |e|, sqrt(mean e^2)."});
}

// The same at the tip with exponents: what is too small for the six decimals of differences.csv.
std::string tip_differences_csv(const Study1Data& data) {
  Table table({"case", "frame", "method", "minus", "dx_mm", "dy_mm", "dz_mm", "distance_mm"});
  for (const Study1Difference& d : data.differences) {
    table.add({d.load_case, d.frame, d.a, d.b, scientific(d.tip_mm[0], 3), scientific(d.tip_mm[1], 3),
               scientific(d.tip_mm[2], 3), scientific(d.tip_mm.norm(), 3)});
  }
  return table.csv({ours});
}

std::string printed_csv() {
  Table table({"set", "axis", "mean_mm", "sd_mm", "mae_mm", "mae_sd_mm", "rms_mm", "rms_of_mean_and_sd_mm",
               "rms_of_mean_and_sd_by_n_mm", "rms_of_mae_and_sd_mm", "rms_of_mae_and_sd_by_n_mm"});
  for (const PrintedStatistics& p : printed_statistics()) {
    table.add({p.planar ? "planar" : "spatial", std::string(1, "xyz"[p.axis]), fixed(p.mean, 2), fixed(p.deviation, 2),
               fixed(p.mean_absolute, 2), fixed(p.absolute_deviation, 2), fixed(p.root_mean_square, 4),
               fixed(from_errors(p, share_n_minus_1).value, 4), fixed(from_errors(p, share_n).value, 4),
               fixed(from_absolute_errors(p, share_n_minus_1).value, 4),
               fixed(from_absolute_errors(p, share_n).value, 4)});
  }
  return table.csv({"Printed in the paper: mean to rms_mm. Computed from them: sqrt(mean^2 + 7/8 SD^2), by n: 8/8."});
}

std::string timing_csv(const Study1Data& data) {
  Table table(with_timing_columns({"case", "frame", "method"}));
  for (const Study1Time& t : data.times) {
    table.add(with_timing({t.load_case, t.frame, t.method}, t.timing, fixed, 3));
  }
  return table.csv(
      {machine_line(), "Warm. fam: all of the solve; fam_*: the bare kernel; fe*, exact*: all but reading."});
}

std::string plus_minus(double mean, double deviation) {
  return fmt::format("{} ± {}", fixed(mean, 2), fixed(deviation, 2));
}

std::string marked(const ImpliedRms& rms) {
  return rms.agrees ? "**" + fixed(rms.value, 3) + "**" : fixed(rms.value, 3);
}

}  // namespace

std::map<std::string, std::string> study1_csv(const Study1Data& data) {
  return {{"tips.csv", tips_csv(data)},       {"differences.csv", differences_csv(data)},
          {"summary.csv", summary_csv(data)}, {"tip_differences.csv", tip_differences_csv(data)},
          {"printed.csv", printed_csv()},     {"shapes.csv", shapes_csv(data)},
          {"timing.csv", timing_csv(data)}};
}

std::string comparison_table(const Study1Data& data) {
  Table table(
      {"case", "FAM x", "FAM y", "FAM z", "FE x", "FE y", "FE z", "distance", "% of L", "largest along the rod"});
  for (const std::string& load_case : study1_cases()) {
    std::vector<std::string> cells{load_case};
    for (const std::string& method : {fam12, std::string("fe")}) {
      const Study1Tip* t = tip(data, load_case, "follower", method);
      for (int axis = 0; axis < 3; ++axis) cells.push_back(t ? fixed(t->position_mm[axis], 2) : "–");
    }
    const Study1Difference* d = difference(data, load_case, "follower", fam12, "fe");
    cells.push_back(d ? fixed(d->tip_mm.norm(), 2) : "–");
    cells.push_back(d ? fixed(100 * d->tip_mm.norm() / data.length_mm, 2) : "–");
    cells.push_back(d ? fixed(d->shape_largest_mm, 2) : "–");
    table.add(cells);
  }
  return table.markdown();
}

std::string summary_table(const Study1Data& data) {
  Table table({"axis", "mean ± SD", "MAE ± SD", "RMS", "*printed* mean ± SD", "*printed* MAE ± SD", "*printed* RMS"});
  for (const PrintedStatistics& p : printed_statistics()) {
    const Statistics s = statistics_of(data, p.planar, "follower", fam12, "fe", p.axis);
    table.add({set_and_axis(p), plus_minus(s.mean, s.standard_deviation),
               plus_minus(s.mean_absolute, s.absolute_deviation), fixed(s.root_mean_square, 2),
               plus_minus(p.mean, p.deviation), plus_minus(p.mean_absolute, p.absolute_deviation),
               fixed(p.root_mean_square, 4)});
  }
  return table.markdown();
}

std::string printed_table() {
  Table table({"axis", "*printed* MAE", "*printed* RMS", "RMS of mean ± SD", "SD by n", "RMS of MAE ± SD", "SD by n"});
  for (const PrintedStatistics& p : printed_statistics()) {
    table.add({set_and_axis(p), fixed(p.mean_absolute, 2), fixed(p.root_mean_square, 4),
               marked(from_errors(p, share_n_minus_1)), marked(from_errors(p, share_n)),
               marked(from_absolute_errors(p, share_n_minus_1)), marked(from_absolute_errors(p, share_n))});
  }
  return table.markdown();
}

std::string methods_table(const Study1Data& data) {
  Table table({"method − FE", "planar MAE", "planar RMS", "spatial MAE", "spatial RMS", "largest distance"});
  for (const std::string& method : {fam12, fam12_twist_first, std::string("fam_published_50"), std::string("fam"),
                                    sixth12, std::string("fe_kirchhoff"), std::string("exact")}) {
    std::vector<std::string> cells{study1_label(method)};
    for (const bool planar : {true, false}) {
      const std::vector<double> values = differences_mm(data, planar, method, "fe");
      const Statistics s = values.empty() ? Statistics{} : statistics(values);
      cells.push_back(values.empty() ? "–" : scientific(s.mean_absolute, 1));
      cells.push_back(values.empty() ? "–" : scientific(s.root_mean_square, 1));
    }
    const std::vector<double> distances = distances_mm(data, study1_cases(), "follower", method, "fe");
    cells.push_back(distances.empty() ? "–" : scientific(*std::max_element(distances.begin(), distances.end()), 1));
    table.add(cells);
  }
  return table.markdown();
}

std::string split_table(const Study1Data& data) {
  Table table({"MAE per axis", "FAM − FE", "the law, 12 arcs", "the law, 50 arcs", "no shear, no stretch", "FE"});
  for (const bool planar : {true, false}) {
    std::vector<std::string> cells{planar ? "planar" : "spatial"};
    for (const auto& [a, b] : {std::pair{fam12, std::string("fe")}, std::pair{fam12, std::string("exact_kirchhoff")},
                               std::pair{std::string("fam_published_50"), std::string("exact_kirchhoff")},
                               std::pair{std::string("exact_kirchhoff"), std::string("exact")},
                               std::pair{std::string("exact"), std::string("fe")}}) {
      const std::vector<double> values = differences_mm(data, planar, a, b);
      cells.push_back(values.empty() ? "–" : scientific(statistics(values).mean_absolute, 1));
    }
    table.add(cells);
  }
  return table.markdown();
}

std::string fixed_table(const Study1Data& data) {
  Table table({"method − exact", "solved, planar", "solved, spatial", "median distance", "largest distance"});
  for (const auto& [method, sign] : {std::pair{std::string("fam"), 1}, {sixth12, 1}, {std::string("fe"), -1}}) {
    const std::string a = sign > 0 ? method : "exact", b = sign > 0 ? "exact" : method;
    const std::vector<double> distances = distances_mm(data, study1_cases(), "fixed", a, b);
    const auto solved = [&](bool planar) {
      return fmt::format("{} of {}", distances_mm(data, study1_cases(planar), "fixed", a, b).size(),
                         study1_cases(planar).size());
    };
    table.add({study1_label(method), solved(true), solved(false),
               distances.empty() ? "–" : scientific(quantile(distances, 0.5), 1),
               distances.empty() ? "–" : scientific(quantile(distances, 1), 1)});
  }
  return table.markdown();
}

std::string times_table(const Study1Data& data) {
  Table table({"method", "timed", "follower: median", "least … most", "fixed: median", "least … most"});
  for (const auto& [method, what] : {std::pair{std::string("fam"), "`fam solve`, all of it"},
                                     {sixth12, "the bare kernel"},
                                     {fam12, "the bare kernel"},
                                     {std::string("fe"), "all but reading the scene"},
                                     {std::string("exact"), "all but reading the scene"}}) {
    std::vector<std::string> cells{study1_label(method), what};
    for (const char* frame : {"follower", "fixed"}) {
      const std::vector<double> times = times_us(data, frame, method);
      cells.push_back(times.empty() ? "–" : significant(quantile(times, 0.5), 3));
      cells.push_back(times.empty() ? "–"
                                    : significant(quantile(times, 0), 3) + " … " + significant(quantile(times, 1), 3));
    }
    table.add(cells);
  }
  return timed(table.markdown());
}

}  // namespace studies
