#include "studies/benchmarks/page.h"

#include "studies/report/provenance.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr std::size_t longest_table = 28;  // rows on the page; the CSV has all

std::string without_commas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

// Ten digits at most: beyond lies round-off.
int decimals_printed(const BenchmarkRow& row, std::size_t i) {
  const int leading = static_cast<int>(std::floor(std::log10(row.point.scale)));
  return std::clamp(row.point.published[i].decimals, 0, 9 - leading);
}

// Two more decimals than a print that is worth its digits, so that a difference shows.
int decimals_shown(const BenchmarkRow& row, std::size_t i) {
  const int leading = static_cast<int>(std::floor(std::log10(row.point.scale)));
  const int more = row.point.digits < 10 ? 0 : 2;
  return std::clamp(decimals_printed(row, i) + more, 0, 9 - leading);
}

std::string published_text(const BenchmarkRow& row) {
  std::string text;
  for (std::size_t i = 0; i < row.point.published.size(); ++i) {
    text += (i > 0 ? " " : "") + fixed(row.point.published[i].value, decimals_printed(row, i));
  }
  return text;
}

std::string value_text(const BenchmarkRow& row, std::size_t method) {
  const BenchmarkFound& found = row.found[method];
  std::string text;
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    text += (text.empty() ? "" : " ") + fixed(found.values[i], decimals_shown(row, i));
  }
  return text;
}

bool solved(const BenchmarkFound& found) {
  return found.status == "converged";
}

const BenchmarkSource& source_of(const BenchmarkResult& result, const std::string& key) {
  return *std::find_if(result.benchmark.sources.begin(), result.benchmark.sources.end(),
                       [&](const BenchmarkSource& s) { return s.key == key; });
}

std::string range(int low, int high) {
  return low == high ? std::to_string(low) : fmt::format("{}–{}", low, high);
}

// --- CSV ------------------------------------------------------------------------------------------------------------

std::string points_csv(const std::vector<BenchmarkResult>& results) {
  std::vector<std::string> columns{"benchmark", "source", "worth", "point", "published", "digits_carried"};
  for (const std::string& method : benchmark_methods()) {
    for (const char* what : {"_status", "", "_digits"}) columns.push_back(method + what);
  }
  Table table(columns);
  for (const BenchmarkResult& result : results) {
    for (const BenchmarkRow& row : result.rows) {
      std::vector<std::string> cells{result.benchmark.key,
                                     row.point.source,
                                     source_of(result, row.point.source).worth,
                                     without_commas(row.point.label),
                                     published_text(row),
                                     std::to_string(row.carried)};
      for (std::size_t m = 0; m < row.found.size(); ++m) {
        cells.push_back(row.found[m].status);
        cells.push_back(value_text(row, m));
        cells.push_back(solved(row.found[m]) ? fixed(row.found[m].digits, 1) : "");
      }
      table.add(cells);
    }
  }
  return table.csv({"Quantities and units: README.md. Digits: -log10 of the relative error, at most what is carried."});
}

std::string lines_csv(const std::vector<BenchmarkResult>& results) {
  Table table({"benchmark", "family", "parameter", "values"});
  for (const BenchmarkResult& result : results) {
    for (const BenchmarkLine& line : result.lines) {
      for (const std::vector<double>& sample : line.samples) {
        std::string values;
        for (std::size_t i = 1; i < sample.size(); ++i) values += (i > 1 ? " " : "") + fixed(sample[i], 5);
        table.add({result.benchmark.key, line.family, fmt::format("{:.6g}", sample[0]), values});
      }
    }
  }
  return table.csv(
      {"The exact lines of the pictures. critical: load factor - 1, and 1 stable, 0 not, -1 not decided."});
}

std::string timing_csv(const std::vector<BenchmarkResult>& results) {
  Table table({"benchmark", "method", "median_us", "lower_quartile_us", "upper_quartile_us", "repeats"});
  for (const BenchmarkResult& result : results) {
    for (std::size_t m = 0; m < result.times.size(); ++m) {
      const Timing& t = result.times[m];
      table.add({result.benchmark.key, benchmark_methods()[m], fixed(t.median_us, 3), fixed(t.lower_quartile_us, 3),
                 fixed(t.upper_quartile_us, 3), std::to_string(t.repeats)});
    }
  }
  return table.csv({machine_line(), "The bare solve of the point that timing.md names; repeats 0: no solution."});
}

// --- Markdown -------------------------------------------------------------------------------------------------------

std::string digits_cell(const DigitSummary& s) {
  if (s.solved == 0) return "–";
  if (s.points == 1) return fixed(s.median, 1);
  return fmt::format("{} ({})", fixed(s.median, 1), fixed(s.lowest, 1));
}

// "all", or which methods failed where.
std::string status_cell(const BenchmarkResult& result, const std::string& source) {
  std::string text;
  for (std::size_t m = 0; m < benchmark_methods().size(); ++m) {
    const DigitSummary s = digit_summary(result, source, m);
    if (s.solved == s.points) continue;
    text += fmt::format("{}{}: {} of {} {}", text.empty() ? "" : "; ", benchmark_methods()[m], s.points - s.solved,
                        s.points, s.failure);
  }
  return text.empty() ? "all converged" : text;
}

Table overview(const std::vector<BenchmarkResult>& results, bool linked) {
  Table table({"case", "source", "worth", "digits carried", "points", "exact", "FE", "FAM", "status"});
  for (const BenchmarkResult& result : results) {
    const std::string title =
        linked ? fmt::format("[{}](#{})", result.benchmark.title, result.benchmark.key) : result.benchmark.key;
    for (const BenchmarkSource& source : result.benchmark.sources) {
      std::vector<std::string> cells{title, linked ? source.title : source.key, source.worth};
      const DigitSummary exact = digit_summary(result, source.key, 0);
      cells.push_back(range(exact.fewest_carried, exact.most_carried));
      cells.push_back(std::to_string(exact.points));
      for (std::size_t m = 0; m < benchmark_methods().size(); ++m) {
        cells.push_back(digits_cell(digit_summary(result, source.key, m)));
      }
      cells.push_back(status_cell(result, source.key));
      table.add(cells);
    }
  }
  return table;
}

std::string source_table(const BenchmarkResult& result, const BenchmarkSource& source) {
  std::vector<const BenchmarkRow*> rows;
  for (const BenchmarkRow& row : result.rows) {
    if (row.point.source == source.key) rows.push_back(&row);
  }
  const std::size_t step = (rows.size() + longest_table - 1) / longest_table;
  Table table({"point", "published", "carries", "exact", "digits", "FE", "digits", "FAM", "digits"});
  for (std::size_t i = 0; i < rows.size(); i += step) {
    const BenchmarkRow& row = *rows[i];
    std::vector<std::string> cells{row.point.label, published_text(row), std::to_string(row.carried)};
    for (std::size_t m = 0; m < row.found.size(); ++m) {
      cells.push_back(solved(row.found[m]) ? value_text(row, m) : row.found[m].status);
      cells.push_back(solved(row.found[m]) ? fixed(row.found[m].digits, 1) : "–");
    }
    table.add(cells);
  }
  const std::string left_out =
      step > 1 ? fmt::format(" (here one in {} of {} points; all are in points.csv)", step, rows.size()) : "";
  return fmt::format("**{}**, {}{}:\n\n{}\n", source.title, source.worth, left_out, table.markdown());
}

std::string section(const BenchmarkResult& result) {
  const Benchmark& b = result.benchmark;
  std::string text = fmt::format(
      "<a id=\"{0}\"></a>\n## {1}\n\n{2}\nQuantities: {3}. FE: {4} quadratic elements; FAM: {4} fourth-order arcs. "
      "Scene: `studies/cases/benchmarks/{5}.json`.\n\n![{1}]({0}.svg)\n\n",
      b.key, b.title, benchmark_text(b.key), b.quantities, b.elements, b.scene);
  if (b.key == "follower") text += "![Shapes under follower forces](follower_shapes.svg)\n\n";
  for (const BenchmarkSource& source : b.sources) text += source_table(result, source);
  return text;
}

std::string page(const std::vector<BenchmarkResult>& results) {
  std::string text = fmt::format("{}\n{}\n", benchmark_text("page"), overview(results, true).markdown());
  for (const BenchmarkResult& result : results) text += section(result);
  return text + benchmark_text("files");
}

std::string headline(const std::vector<BenchmarkResult>& results) {
  int points = 0, fam_solved = 0;
  for (const BenchmarkResult& result : results) {
    for (const BenchmarkRow& row : result.rows) {
      ++points;
      fam_solved += solved(row.found[2]) ? 1 : 0;
    }
  }
  return fmt::format(
      R"(## [Benchmarks](benchmarks/README.md): {} published cases, {} points

Exact reference, finite elements and FAM beside what others printed, in matching digits. FAM solves {} of the
points; the others stay in the tables with their status. Some differences are the sources': the published tips of the
45° bend belong to two torsion constants, and two rows of PyElastica's follower table are off.

![45° bend: published tips and the torsion constant](benchmarks/bend45.svg)
)",
      results.size(), points, fam_solved);
}

std::string timing_page(const std::vector<BenchmarkResult>& results) {
  Table table({"case", "point", "exact", "FE", "FAM"});
  for (const BenchmarkResult& result : results) {
    std::vector<std::string> cells{result.benchmark.title,
                                   fmt::format("{} {:g}", result.benchmark.timed.first, result.benchmark.timed.second)};
    for (const Timing& t : result.times) {
      cells.push_back(t.repeats == 0 ? "–"
                                     : fmt::format("{} ({} … {})", fixed(t.median_us, 1), fixed(t.lower_quartile_us, 1),
                                                   fixed(t.upper_quartile_us, 1)));
    }
    table.add(cells);
  }
  return fmt::format(
      "# Benchmarks: times\n\n{}. Microseconds, warm: median (quartiles) of one solve of the point named (family and\n"
      "parameter), with the elements and arcs that README.md states. **Not** at equal accuracy. FAM: the march alone; "
      "–: no solution.\n\n{}",
      machine_line(), table.markdown());
}

}  // namespace

DigitSummary digit_summary(const BenchmarkResult& result, const std::string& source, std::size_t method) {
  DigitSummary s;
  std::vector<double> digits;
  for (const BenchmarkRow& row : result.rows) {
    if (row.point.source != source) continue;
    s.fewest_carried = s.points == 0 ? row.carried : std::min(s.fewest_carried, row.carried);
    s.most_carried = std::max(s.most_carried, row.carried);
    ++s.points;
    if (solved(row.found[method])) digits.push_back(row.found[method].digits);
    else if (s.failure.empty()) s.failure = row.found[method].status;
  }
  s.solved = static_cast<int>(digits.size());
  if (digits.empty()) return s;
  std::sort(digits.begin(), digits.end());
  s.lowest = digits.front();
  s.median = (digits[(digits.size() - 1) / 2] + digits[digits.size() / 2]) / 2;
  return s;
}

std::map<std::string, std::string> benchmark_files(const std::vector<BenchmarkResult>& results) {
  std::map<std::string, std::string> files = benchmark_pictures(results);
  files["README.md"] = page(results);
  files["headline.md"] = headline(results);
  files["points.csv"] = points_csv(results);
  files["lines.csv"] = lines_csv(results);
  files["overview.csv"] = overview(results, false).csv({"Digits: median (lowest) over the points of a source."});
  files["timing.csv"] = timing_csv(results);
  files["timing.md"] = timing_page(results);
  return files;
}

}  // namespace studies
