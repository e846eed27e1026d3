// The numbers in the page's words on each benchmark.
#include "studies/benchmarks/page.h"

#include "studies/compare/error_measures.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::string rounded(double value) {
  return for_reader(significant(value, 2));
}

// Differences of the exact reference, in the rows' order; without those that it did not solve.
std::vector<double> exact_differences(const BenchmarkRows& rows) {
  std::vector<double> differences;
  for (const BenchmarkRow* row : rows) {
    if (row->found[by_exact].solved()) differences.push_back(difference(*row, by_exact));
  }
  return differences;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

bool all_full(const BenchmarkRows& rows, std::size_t method) {
  const DigitSummary s = digit_summary(rows, method);
  return s.full == s.points;
}

double norm_of(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares);
}

void set_planar(Page& page, const BenchmarkResults& results) {
  const BenchmarkResult &rollup = result_of(results, "rollup"), &elastica = result_of(results, "elastica");
  page.check("rollup_fam_full", all_full(rows_of(rollup, "closed"), by_fam));
  page.check("mattiasson_full", all_full(rows_of(elastica, "mattiasson"), by_exact));
  const BenchmarkRows sze = rows_of(elastica, "sze");
  std::vector<double> differences = exact_differences(sze);
  page.set("sze_largest", rounded(largest(differences)));
  page.set("sze_least", rounded(differences.empty() ? 0 : *std::min_element(differences.begin(), differences.end())));
  const BenchmarkResult& thick = result_of(results, "thick");
  std::string digits;
  for (const BenchmarkRow* row : rows_of(thick, "exudyn")) {
    digits += fmt::format("{}{} at {}", digits.empty() ? "" : ", ", digits_text(row->found[by_exact].digits),
                          row->point.label);
  }
  page.set("thick_digits", digits);
}

// Rows of a load whose printed points are, one by one, those of the load before: a slip of the digitised file.
BenchmarkRows repeated(const BenchmarkRows& rows, const std::string& family, const std::string& before) {
  std::vector<std::pair<double, double>> of_before;
  BenchmarkRows found;
  for (const BenchmarkRow* row : rows) {
    const std::pair<double, double> p{row->point.published[0].value, row->point.published[1].value};
    if (row->point.family == before) of_before.push_back(p);
    const bool again = std::find(of_before.begin(), of_before.end(), p) != of_before.end();
    if (row->point.family == family && again) found.push_back(row);
  }
  return found;
}

void set_follower(Page& page, const BenchmarkResults& results) {
  const BenchmarkRows argyris = rows_of(result_of(results, "follower"), "argyris");
  const BenchmarkRows again = repeated(argyris, "shape_94.5", "shape_80");
  BenchmarkRows others;
  for (const BenchmarkRow* row : argyris) {
    if (std::find(again.begin(), again.end(), row) == again.end()) others.push_back(row);
  }
  page.check("argyris_slip", !again.empty());
  page.set("argyris_repeated", std::to_string(again.size()));
  page.set("argyris_median", rounded(quantile(exact_differences(argyris), 0.5)));
  page.set("argyris_others", rounded(largest(exact_differences(others))));
}

void set_heavy(Page& page, const BenchmarkResults& results) {
  const BenchmarkResult& heavy = result_of(results, "heavy");
  page.set("pyelastica_fixed", rounded(largest(exact_differences(rows_of(heavy, "conservative")))));
  BenchmarkRows rows;
  for (const BenchmarkRow* row : rows_of(heavy, "follower")) {
    if (row->found[by_exact].solved()) rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end(), [](const BenchmarkRow* a, const BenchmarkRow* b) {
    return difference(*a, by_exact) * a->point.scale > difference(*b, by_exact) * b->point.scale;
  });
  const auto over_length = [&](std::size_t i) {
    return rows.size() > i ? difference(*rows[i], by_exact) * rows[i]->point.scale : 0;
  };
  for (const std::size_t i : {0u, 1u}) {
    const std::string number = i == 0 ? "first" : "second";
    page.set("pyelastica_" + number, rounded(over_length(i)));
    page.set("pyelastica_" + number + "_load", rows.size() > i ? fmt::format("{:g}", rows[i]->point.parameter) : "–");
  }
  page.set("pyelastica_others", rounded(over_length(2)));
}

// The published tips at F = 600 that match all their digits with one of the torsion constants.
std::string matching_tips(const BenchmarkResult& bend45, const std::string& source) {
  std::string list;
  for (const BenchmarkRow* row : rows_of(bend45, source)) {
    const BenchmarkFound& exact = row->found[by_exact];
    if (row->point.parameter != 600 || !exact.solved() || exact.digits < row->carried) continue;
    list += (list.empty() ? "" : ", ") + row->point.label.substr(0, row->point.label.find(", F"));
  }
  return list.empty() ? "none" : list;
}

void set_bend45(Page& page, const BenchmarkResults& results) {
  const BenchmarkResult& bend45 = result_of(results, "bend45");
  const auto& samples = bend45.lines.front().samples;
  std::vector<double> moved;
  for (std::size_t i = 1; i < samples.front().size(); ++i) {
    moved.push_back(samples.back()[i] - samples.front()[i]);
  }
  page.set("bend45_moved", rounded(norm_of(moved)));
  const BenchmarkRows polar = rows_of(bend45, "published_polar"), st_venant = rows_of(bend45, "published_st_venant");
  std::vector<double> nearest;
  for (std::size_t i = 0; i < polar.size(); ++i) {
    if (!polar[i]->found[by_exact].solved() || !st_venant[i]->found[by_exact].solved()) continue;
    nearest.push_back(polar[i]->point.scale *
                      std::min(difference(*polar[i], by_exact), difference(*st_venant[i], by_exact)));
  }
  page.set("bend45_nearest", rounded(quantile(nearest, 0.5)));
  page.set("bend45_st_venant", matching_tips(bend45, "published_st_venant"));
  page.set("bend45_polar", matching_tips(bend45, "published_polar"));
}

void set_princeton(Page& page, const BenchmarkResults& results) {
  const BenchmarkResult& princeton = result_of(results, "princeton");
  const BenchmarkRows solid = rows_of(princeton, "ansys_solid");
  const bool stiffer = std::all_of(solid.begin(), solid.end(), [](const BenchmarkRow* row) {
    const BenchmarkFound& exact = row->found[by_exact];
    return exact.solved() && norm_of(exact.values) * (1 + 1e-9) > row->point.scale;
  });
  page.set("ansys_beam", digits_of(rows_of(princeton, "ansys_beam"), by_exact));
  page.set("ansys_solid_percent", rounded(100 * largest(exact_differences(solid))));
  page.check("ansys_solid_stiffer", stiffer);
}

// How far the published values of another source lie from the measured ones, percent.
double percent_off_measured(const BenchmarkResult& pazy, const std::string& source) {
  double most = 0;
  for (const BenchmarkRow* row : rows_of(pazy, source)) {
    for (const BenchmarkRow* measured : rows_of(pazy, "measured")) {
      if (measured->point.label != row->point.label) continue;
      const double truth = measured->point.published[0].value;
      most = std::max(most, 100 * std::abs(row->point.published[0].value / truth - 1));
    }
  }
  return most;
}

void set_pazy(Page& page, const BenchmarkResults& results) {
  const BenchmarkResult& pazy = result_of(results, "pazy");
  const BenchmarkRows measured = rows_of(pazy, "measured");
  int stiffer = 0;
  for (const BenchmarkRow* row : measured) {
    const std::vector<double>& values = row->found[by_exact].values;
    stiffer += !values.empty() && std::abs(values[0]) < std::abs(row->point.published[0].value) ? 1 : 0;
  }
  page.set("pazy_percent", rounded(100 * largest(exact_differences(measured))));
  page.set("pazy_stiffer", std::to_string(stiffer));
  page.set("pazy_points", std::to_string(measured.size()));
  page.set("umnast_percent", rounded(percent_off_measured(pazy, "umnast")));
  page.set("nastran_percent", rounded(percent_off_measured(pazy, "nastran")));
}

void set_critical(Page& page, const BenchmarkResults& results) {
  const BenchmarkResult& critical = result_of(results, "critical");
  const BenchmarkRow& beck = critical.rows.back();
  const auto undecided = [](const BenchmarkFound& found) { return found.status == "stability not decided"; };
  page.check("beck_undecided", std::all_of(beck.found.begin(), beck.found.end(), undecided));
  page.set("beck_flutter", fixed(beck.point.published[0].value, 2));
  page.set("critical_table", critical_table(critical));
}

}  // namespace

void set_cases(Page& page, const BenchmarkResults& results) {
  set_planar(page, results);
  set_follower(page, results);
  set_heavy(page, results);
  set_bend45(page, results);
  set_princeton(page, results);
  set_pazy(page, results);
  set_critical(page, results);
}

}  // namespace studies
