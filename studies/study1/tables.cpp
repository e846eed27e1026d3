#include "studies/study1/tables.h"

#include "studies/compare/error_measures.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"

#include <fmt/format.h>

namespace studies {
namespace {

// Distance of the tips as text; "–" where one of the two did not solve the case.
std::string distance(const Study1Data& data, const std::string& load_case, const std::string& frame,
                     const std::string& a, const std::string& b) {
  const Study1Difference* d = difference(data, load_case, frame, a, b);
  return d ? scientific(d->tip_mm.norm(), 1) : "–";
}

// Statistics along one axis over the cases that both methods solved.
Statistics statistics_of(const Study1Data& data, bool planar, const std::string& frame, const std::string& a,
                         const std::string& b, int axis) {
  std::vector<double> values;
  for (const std::string& load_case : study1_cases(planar)) {
    if (const auto* d = difference(data, load_case, frame, a, b)) values.push_back(d->tip_mm[axis]);
  }
  return values.empty() ? Statistics{} : statistics(values);
}

// The paper's printed statistics (paper_values: text of Study I; Tables 1 and 2 are lost).
struct Printed {
  bool planar;
  int axis;
  const char *mean, *mean_absolute, *root_mean_square;
};
const std::vector<Printed> printed = {{true, 0, "−0.27 ± 0.90", "0.29 ± 0.48", "0.4865"},
                                      {true, 1, "−0.25 ± 0.94", "0.39 ± 0.58", "0.5732"},
                                      {false, 0, "+0.36 ± 0.98", "0.44 ± 0.28", "0.5222"},
                                      {false, 1, "−0.18 ± 0.56", "0.52 ± 0.20", "0.5590"},
                                      {false, 2, "−0.13 ± 0.37", "0.51 ± 0.14", "0.5284"}};

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

std::string summary_csv(const Study1Data& data) {
  Table table({"set", "frame", "method", "minus", "axis", "mean_mm", "sd_mm", "mae_mm", "mae_sd_mm", "rms_mm"});
  for (const std::string frame : {"follower", "fixed"}) {
    for (const auto& [a, b] : study1_pairs()) {
      for (const Printed& p : printed) {
        const Statistics s = statistics_of(data, p.planar, frame, a, b, p.axis);
        if (s.root_mean_square == 0) continue;
        table.add({p.planar ? "planar" : "spatial", frame, a, b, std::string(1, "xyz"[p.axis]), fixed(s.mean, 6),
                   fixed(s.standard_deviation, 6), fixed(s.mean_absolute, 6), fixed(s.absolute_deviation, 6),
                   fixed(s.root_mean_square, 6)});
      }
    }
  }
  return table.csv({ours, "Over the eight cases of a set: mean e, SD (n - 1), mean |e|, SD of |e|, sqrt(mean e^2)."});
}

std::string timing_csv(const Study1Data& data) {
  Table table({"case", "frame", "method", "median_us", "lower_quartile_us", "upper_quartile_us", "repeats"});
  for (const Study1Time& t : data.times) {
    table.add({t.load_case, t.frame, t.method, fixed(t.timing.median_us, 3), fixed(t.timing.lower_quartile_us, 3),
               fixed(t.timing.upper_quartile_us, 3), std::to_string(t.timing.repeats)});
  }
  return table.csv({machine_line(), "The bare solve, warm; see timing.md."});
}

std::string plus_minus(double mean, double deviation) {
  return fmt::format("{} ± {}", fixed(mean, 2), fixed(deviation, 2));
}

}  // namespace

std::map<std::string, std::string> study1_csv(const Study1Data& data) {
  return {{"tips.csv", tips_csv(data)},
          {"differences.csv", differences_csv(data)},
          {"summary.csv", summary_csv(data)},
          {"shapes.csv", shapes_csv(data)},
          {"timing.csv", timing_csv(data)}};
}

std::string comparison_table(const Study1Data& data, bool planar) {
  const int axes = planar ? 2 : 3;
  std::vector<std::string> columns{"case"};
  for (const char* what : {"FAM ", "FE ", "FAM − FE "}) {
    for (int axis = 0; axis < axes; ++axis) columns.push_back(what + std::string(1, "xyz"[axis]));
  }
  for (const char* name : {"distance", "% of L", "largest along the rod"}) columns.push_back(name);
  Table table(columns);
  for (const std::string& load_case : study1_cases(planar)) {
    const Study1Tip* of_fam = tip(data, load_case, "follower", fam12);
    const Study1Tip* of_fe = tip(data, load_case, "follower", "fe");
    const Study1Difference* d = difference(data, load_case, "follower", fam12, "fe");
    std::vector<std::string> cells{load_case};
    const auto add = [&](const Eigen::Vector3d* v, int digits) {
      for (int axis = 0; axis < axes; ++axis) cells.push_back(v ? fixed((*v)[axis], digits) : "–");
    };
    add(of_fam ? &of_fam->position_mm : nullptr, 3);
    add(of_fe ? &of_fe->position_mm : nullptr, 3);
    add(d ? &d->tip_mm : nullptr, 3);
    cells.push_back(d ? fixed(d->tip_mm.norm(), 3) : "–");
    cells.push_back(d ? fixed(d->tip_mm.norm() / 40 * 100, 2) : "–");
    cells.push_back(d ? fixed(d->shape_largest_mm, 3) : "–");
    table.add(cells);
  }
  return table.markdown();
}

std::string summary_table(const Study1Data& data, bool planar) {
  Table table({"axis", "mean ± SD", "MAE ± SD", "RMS", "mean ± SD (own error)", "MAE ± SD (own error)",
               "RMS (own error)", "printed mean ± SD", "printed MAE", "printed RMS"});
  for (const Printed& p : printed) {
    if (p.planar != planar) continue;
    const Statistics s = statistics_of(data, planar, "follower", fam12, "fe", p.axis);
    const Statistics own = statistics_of(data, planar, "follower", fam12, "fe_kirchhoff", p.axis);
    table.add({std::string(1, "xyz"[p.axis]), plus_minus(s.mean, s.standard_deviation),
               plus_minus(s.mean_absolute, s.absolute_deviation), fixed(s.root_mean_square, 3),
               plus_minus(own.mean, own.standard_deviation), plus_minus(own.mean_absolute, own.absolute_deviation),
               fixed(own.root_mean_square, 3), p.mean, p.mean_absolute, p.root_mean_square});
  }
  return table.markdown();
}

std::string separation_table(const Study1Data& data) {
  Table table({"case", "published 12 − FE", "published 12 − FE Kirchhoff", "published 50 − FE Kirchhoff",
               "fourth_order 50 − FE Kirchhoff", "sixth_order 12 − FE Kirchhoff", "fourth_order 50 Reissner − FE",
               "FE Kirchhoff − FE"});
  for (const std::string& load_case : study1_cases()) {
    std::vector<std::string> cells{load_case};
    for (const auto& [a, b] :
         {std::pair{"fam_published_12", "fe"}, std::pair{"fam_published_12", "fe_kirchhoff"},
          std::pair{"fam_published_50", "fe_kirchhoff"}, std::pair{"fam_fourth_order_50", "fe_kirchhoff"},
          std::pair{"fam_sixth_order_12", "fe_kirchhoff"}, std::pair{"fam_fourth_order_50_reissner", "fe"},
          std::pair{"fe_kirchhoff", "fe"}}) {
      cells.push_back(distance(data, load_case, "follower", a, b));
    }
    table.add(cells);
  }
  return table.markdown();
}

std::string split_table(const Study1Data& data) {
  Table table(
      {"case", "FAM − FE", "= FAM − exact Kirchhoff", "+ exact Kirchhoff − exact Reissner", "+ exact Reissner − FE"});
  for (const std::string& load_case : study1_cases()) {
    const auto vector = [&](const std::string& a, const std::string& b, int digits) -> std::string {
      const Study1Difference* d = difference(data, load_case, "follower", a, b);
      if (!d) return "–";
      std::string text = "(";
      for (int axis = 0; axis < 3; ++axis) text += (axis ? ", " : "") + fixed(d->tip_mm[axis], digits);
      return text + ")";
    };
    table.add({load_case, vector(fam12, "fe", 3), vector(fam12, "exact_kirchhoff", 3),
               vector("exact_kirchhoff", "exact", 3), vector("exact", "fe", 7)});
  }
  return table.markdown();
}

std::string rotation_order_table(const Study1Data& data) {
  Table table({"case", "bend, then twist", "twist, then bend"});
  for (const std::string& load_case : study1_cases(false)) {
    table.add({load_case, distance(data, load_case, "follower", fam12, "fe_kirchhoff"),
               distance(data, load_case, "follower", fam12 + "_twist_bend", "fe_kirchhoff")});
  }
  return table.markdown();
}

std::string fixed_table(const Study1Data& data) {
  const std::string fam = "fam_fourth_order_50_reissner";
  Table table({"case", "FAM x", "FAM y", "FAM z", "FE x", "FE y", "FE z", "FAM − FE", "FAM − exact", "FE − exact",
               "fixed − follower"});
  for (const std::string& load_case : study1_cases()) {
    std::vector<std::string> cells{load_case};
    for (const std::string& method : {fam, std::string("fe")}) {
      const Study1Tip* t = tip(data, load_case, "fixed", method);
      for (int axis = 0; axis < 3; ++axis) cells.push_back(t ? fixed(t->position_mm[axis], 3) : "–");
    }
    cells.push_back(distance(data, load_case, "fixed", fam, "fe"));
    cells.push_back(distance(data, load_case, "fixed", fam, "exact"));
    cells.push_back(distance(data, load_case, "fixed", "exact", "fe"));
    const Study1Tip* dead = tip(data, load_case, "fixed", "exact");
    const Study1Tip* follower = tip(data, load_case, "follower", "exact");
    cells.push_back(dead && follower ? fixed((dead->position_mm - follower->position_mm).norm(), 2) : "–");
    table.add(cells);
  }
  return table.markdown();
}

double mean_absolute(const Study1Data& data, bool planar, const std::string& a, const std::string& b) {
  double sum = 0;
  int axes = 0;
  for (const Printed& p : printed) {
    if (p.planar != planar) continue;
    sum += statistics_of(data, planar, "follower", a, b, p.axis).mean_absolute;
    ++axes;
  }
  return sum / axes;
}

}  // namespace studies
