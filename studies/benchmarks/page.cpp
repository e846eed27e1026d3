#include "studies/benchmarks/data.h"

#include "studies/compare/error_measures.h"
#include "studies/report/answers.h"
#include "studies/report/page.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

using Results = std::vector<BenchmarkResult>;

const BenchmarkResult& result_of(const Results& results, const std::string& key) {
  return *std::find_if(results.begin(), results.end(),
                       [&](const BenchmarkResult& result) { return result.benchmark.key == key; });
}

std::string rounded(double value) {
  return for_reader(significant(value, 2));
}

std::string digits_text(double digits) {
  return fixed(digits, 1);
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

// --- All sources together -------------------------------------------------------------------------------------------

struct Totals {
  int printed_sources = 0, independent_sources = 0;
  BenchmarkRows printed, independent;
  int same = 0;      // printed points on which all methods match the same tenth of a digit
  bool exact_right;  // misses less than a digit of each independent point that it solves
  int deviating_sources = 0;

  bool sources_tell() const { return exact_right && same >= 0.95 * static_cast<double>(printed.size()); }
};

bool same_digits(const BenchmarkRow& row) {
  return std::all_of(row.found.begin(), row.found.end(), [&](const BenchmarkFound& found) {
    return found.solved() && digits_text(found.digits) == digits_text(row.found[by_exact].digits);
  });
}

bool deviates(const BenchmarkResult& result, const BenchmarkSource& source) {
  const DigitSummary s = digit_summary(rows_of(result, source.key), by_exact);
  return !source.independent() && !source.again && 2 * s.full < s.points;
}

// Sources on most of whose points the exact reference misses digits that they carry; why, where that is known.
std::string deviating(const Results& results, bool known, bool with_digits) {
  std::string list;
  for (const BenchmarkResult& result : results) {
    for (const BenchmarkSource& source : result.benchmark.sources) {
      if (!deviates(result, source)) continue;
      const DigitSummary s = digit_summary(rows_of(result, source.key), by_exact);
      std::string notes = with_digits ? fmt::format("{} of {}", digits_text(s.median), s.most_carried) : "";
      if (known) notes += (notes.empty() ? "" : ": ") + source.reason;
      list += (list.empty() ? "" : "; ") + source.title + (notes.empty() ? "" : " (" + notes + ")");
    }
  }
  return list;
}

Totals totals_of(const Results& results) {
  Totals totals;
  totals.printed = rows_where(results, [](const BenchmarkSource& s) { return !s.independent() && !s.again; });
  totals.independent = rows_where(results, [](const BenchmarkSource& s) { return s.independent(); });
  totals.exact_right = std::all_of(totals.independent.begin(), totals.independent.end(), [](const BenchmarkRow* row) {
    return !row->found[by_exact].solved() || row->found[by_exact].digits > row->carried - 1;
  });
  for (const BenchmarkRow* row : totals.printed) totals.same += same_digits(*row) ? 1 : 0;
  for (const BenchmarkResult& result : results) {
    for (const BenchmarkSource& source : result.benchmark.sources) {
      if (source.again) continue;
      ++(source.independent() ? totals.independent_sources : totals.printed_sources);
      totals.deviating_sources += deviates(result, source) ? 1 : 0;
    }
  }
  return totals;
}

// "10.0 (6.0)": median and lowest.
std::string digits_of(const BenchmarkRows& rows, std::size_t method) {
  const DigitSummary s = digit_summary(rows, method);
  return fmt::format("{} ({})", digits_text(s.median), digits_text(s.lowest));
}

std::string carried_text(const BenchmarkRows& rows) {
  const DigitSummary s = digit_summary(rows, by_exact);
  return fmt::format("{} to {}", s.fewest_carried, s.most_carried);
}

std::string unsolved(const Totals& totals) {
  std::string text;
  BenchmarkRows rows = totals.printed;
  rows.insert(rows.end(), totals.independent.begin(), totals.independent.end());
  for (std::size_t m = 0; m < benchmark_methods().size(); ++m) {
    const DigitSummary s = digit_summary(rows, m);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", benchmark_methods()[m].row.name, s.points - s.solved);
  }
  return text;
}

void set_totals(Page& page, const Results& results, const Totals& t) {
  page.check("exact_right", t.exact_right);
  page.check("sources_tell", t.sources_tell());
  page.check("deviating", t.deviating_sources > 0);
  page.set("printed_sources", std::to_string(t.printed_sources));
  page.set("printed_points", std::to_string(t.printed.size()));
  page.set("printed_exact", digits_of(t.printed, by_exact));
  page.set("printed_fe", digits_of(t.printed, by_fe));
  page.set("printed_fam", digits_of(t.printed, by_fam));
  page.set("printed_full", std::to_string(digit_summary(t.printed, by_exact).full));
  page.set("same", std::to_string(t.same));
  page.set("independent_sources", std::to_string(t.independent_sources));
  page.set("independent_points", std::to_string(t.independent.size()));
  page.set("independent_full", std::to_string(digit_summary(t.independent, by_exact).full));
  page.set("independent_carried", carried_text(t.independent));
  page.set("printed_carried", carried_text(t.printed));
  page.set("independent_fe", digits_of(t.independent, by_fe));
  page.set("independent_fam", digits_of(t.independent, by_fam));
  page.set("deviating_sources", std::to_string(t.deviating_sources));
  page.set("deviating_list", deviating(results, t.sources_tell(), true));
  page.set("unsolved", unsolved(t));
}

std::string answer(const Results& results, const Totals& t) {
  const DigitSummary printed = digit_summary(t.printed, by_exact), independent = digit_summary(t.independent, by_exact);
  const std::string deviations = t.deviating_sources == 0
                                     ? ""
                                     : fmt::format(" {} of the sources deviate: {}.", t.deviating_sources,
                                                   deviating(results, t.sources_tell(), false));
  return fmt::format(
      "{} points of {} printed, digitised or measured sources: {} digits in the median ({} at least) of the {} that "
      "they "
      "carry, the same by exact, FE and FAM automatic on {}. {} points of {} closed forms and independent solvers: "
      "exact "
      "all that they carry on {}, FE {}, FAM automatic {} digits (median, lowest).{}",
      printed.points, t.printed_sources, digits_text(printed.median), digits_text(printed.lowest),
      carried_text(t.printed), t.same, independent.points, t.independent_sources, independent.full,
      digits_of(t.independent, by_fe), digits_of(t.independent, by_fam), deviations);
}

// --- One benchmark after the other ----------------------------------------------------------------------------------

void set_planar(Page& page, const Results& results) {
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

void set_follower(Page& page, const Results& results) {
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

void set_heavy(Page& page, const Results& results) {
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

void set_bend45(Page& page, const Results& results) {
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

void set_princeton(Page& page, const Results& results) {
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

void set_pazy(Page& page, const Results& results) {
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

void set_critical(Page& page, const Results& results) {
  const BenchmarkResult& critical = result_of(results, "critical");
  const BenchmarkRow& beck = critical.rows.back();
  const auto undecided = [](const BenchmarkFound& found) { return found.status == "stability not decided"; };
  page.check("beck_undecided", std::all_of(beck.found.begin(), beck.found.end(), undecided));
  page.set("beck_flutter", fixed(beck.point.published[0].value, 2));
  page.set("critical_table", critical_table(critical));
}

// Median over the cases, with the least and the most.
std::string times_of(const Results& results, std::size_t method) {
  std::vector<double> times_us;
  for (const BenchmarkResult& result : results) {
    if (result.times[method].repeats > 0) times_us.push_back(result.times[method].median_us);
  }
  if (times_us.empty()) return "–";
  return fmt::format("{} {} ({} … {})", benchmark_methods()[method].row.name, time_text(quantile(times_us, 0.5)),
                     time_text(quantile(times_us, 0)), time_text(quantile(times_us, 1)));
}

std::string page_of(const Results& results, const Totals& totals, const std::filesystem::path& page_md) {
  Page page;
  page.set("cases", std::to_string(results.size()));
  page.set("elements", std::to_string(result_of(results, "rollup").benchmark.elements));
  page.set("helix_elements", std::to_string(result_of(results, "helix").benchmark.elements));
  page.set("fam_tolerance", for_reader(scientific(fam_tolerance, 0)));
  set_totals(page, results, totals);
  page.set("overview", benchmark_overview(results));
  set_planar(page, results);
  set_follower(page, results);
  set_heavy(page, results);
  set_bend45(page, results);
  set_princeton(page, results);
  set_pazy(page, results);
  set_critical(page, results);
  page.set_time("times", fmt::format("{}, {}, {}", times_of(results, by_exact), times_of(results, by_fe),
                                     times_of(results, by_fam)));
  return page.fill(page_md);
}

}  // namespace

std::map<std::string, std::string> benchmark_files(const std::vector<BenchmarkResult>& results,
                                                   const std::filesystem::path& page_md) {
  const Totals totals = totals_of(results);
  std::map<std::string, std::string> files{
      {"README.md", page_of(results, totals, page_md)},
      {"answers.json", answers_json({{"published_numbers", answer(results, totals)}})},
      {"points.csv", benchmark_points_csv(results)},
      {"lines.csv", benchmark_lines_csv(results)},
      {"overview.csv", benchmark_overview_csv(results)},
      {"timing.csv", benchmark_timing_csv(results)},
      {"digits.svg", digits_picture(results)},
      {"follower_shapes.svg", shapes_picture(result_of(results, "follower"))},
      {"bend45.svg", bend45_picture(result_of(results, "bend45"))}};
  for (const char* key : {"rollup", "elastica", "follower", "heavy", "helix", "princeton", "pazy"}) {
    files[std::string(key) + ".svg"] = differences_picture(result_of(results, key));
  }
  return files;
}

}  // namespace studies
