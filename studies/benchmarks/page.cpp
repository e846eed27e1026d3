#include "studies/benchmarks/page.h"

#include "studies/compare/error_measures.h"
#include "studies/report/page.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

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
std::string deviating(const BenchmarkResults& results, bool known, bool with_digits) {
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

Totals totals_of(const BenchmarkResults& results) {
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

void set_totals(Page& page, const BenchmarkResults& results, const Totals& t) {
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

std::string answer(const Totals& t) {
  return fmt::format(
      "exact, FE and FAM automatic match the same digits on {} of {} points that {} sources printed, digitised or "
      "measured "
      "({} of them deviate, with a reason on the page); on {} points of {} independent solutions FAM automatic matches "
      "{} "
      "digits (median, lowest)",
      t.same, t.printed.size(), t.printed_sources, t.deviating_sources, t.independent.size(), t.independent_sources,
      digits_of(t.independent, by_fam));
}

// Median over the cases, with the least and the most.
std::string times_of(const BenchmarkResults& results, std::size_t method) {
  std::vector<double> times_us;
  for (const BenchmarkResult& result : results) {
    if (result.times[method].repeats > 0) times_us.push_back(result.times[method].median_us);
  }
  if (times_us.empty()) return "–";
  return fmt::format("{} {} ({} … {})", benchmark_methods()[method].row.name, time_text(quantile(times_us, 0.5)),
                     time_text(quantile(times_us, 0)), time_text(quantile(times_us, 1)));
}

std::string page_of(const BenchmarkResults& results, const Totals& totals, const std::filesystem::path& page_md) {
  Page page;
  page.set("cases", std::to_string(results.size()));
  page.set("elements", std::to_string(result_of(results, "rollup").benchmark.elements));
  page.set("helix_elements", std::to_string(result_of(results, "helix").benchmark.elements));
  page.set("fam_tolerance", for_reader(scientific(fam_tolerance, 0)));
  set_totals(page, results, totals);
  page.set("overview", benchmark_overview(results));
  set_cases(page, results);
  page.set_time("times", fmt::format("{}, {}, {}", times_of(results, by_exact), times_of(results, by_fe),
                                     times_of(results, by_fam)));
  return page.fill(page_md);
}

}  // namespace

const BenchmarkResult& result_of(const BenchmarkResults& results, const std::string& key) {
  return *std::find_if(results.begin(), results.end(),
                       [&](const BenchmarkResult& result) { return result.benchmark.key == key; });
}

std::string digits_text(double digits) {
  return fixed(digits, 1);
}

std::string digits_of(const BenchmarkRows& rows, std::size_t method) {
  const DigitSummary s = digit_summary(rows, method);
  return fmt::format("{} ({})", digits_text(s.median), digits_text(s.lowest));
}

std::map<std::string, std::string> benchmark_files(const BenchmarkResults& results,
                                                   const std::filesystem::path& page_md) {
  const Totals totals = totals_of(results);
  std::map<std::string, std::string> files{{"README.md", page_of(results, totals, page_md)},
                                           {"answers.json", answers_json({{"published_numbers", answer(totals)}})},
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
