#include "studies/benchmarks/data.h"

#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/compare/timing_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

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

std::string range(int low, int high) {
  return low == high ? std::to_string(low) : fmt::format("{}–{}", low, high);
}

std::string digits_cell(const DigitSummary& s) {
  if (s.solved == 0) return "–";
  if (s.points == 1) return fixed(s.median, 1);
  return fmt::format("{} ({})", fixed(s.median, 1), fixed(s.lowest, 1));
}

// Which methods failed where.
std::string status_cell(const BenchmarkRows& rows) {
  std::string text;
  for (std::size_t m = 0; m < benchmark_methods().size(); ++m) {
    const DigitSummary s = digit_summary(rows, m);
    if (s.solved == s.points) continue;
    text += fmt::format("{}{}: {} of {} {}", text.empty() ? "" : "; ", benchmark_methods()[m].column,
                        s.points - s.solved, s.points, s.failure);
  }
  return text.empty() ? "all converged" : text;
}

// Worth, digits carried and points of a source, and what the methods match.
std::vector<std::string> source_cells(const BenchmarkSource& source, const BenchmarkRows& rows) {
  const DigitSummary exact = digit_summary(rows, by_exact);
  std::vector<std::string> cells{source.worth, range(exact.fewest_carried, exact.most_carried),
                                 std::to_string(exact.points)};
  for (std::size_t m = 0; m < benchmark_methods().size(); ++m) cells.push_back(digits_cell(digit_summary(rows, m)));
  return cells;
}

}  // namespace

std::string benchmark_points_csv(const std::vector<BenchmarkResult>& results) {
  std::vector<std::string> columns{"benchmark", "source", "worth", "point", "published", "digits_carried"};
  for (const BenchmarkMethod& method : benchmark_methods()) {
    for (const char* what : {"_status", "", "_digits"}) columns.push_back(method.column + what);
  }
  Table table(columns);
  for (const BenchmarkResult& result : results) {
    const std::vector<BenchmarkSource>& sources = result.benchmark.sources;
    for (const BenchmarkRow& row : result.rows) {
      const auto source = std::find_if(sources.begin(), sources.end(),
                                       [&](const BenchmarkSource& s) { return s.key == row.point.source; });
      std::vector<std::string> cells{result.benchmark.key, row.point.source,
                                     source->worth,        without_commas(row.point.label),
                                     published_text(row),  std::to_string(row.carried)};
      for (std::size_t m = 0; m < row.found.size(); ++m) {
        cells.push_back(row.found[m].status);
        cells.push_back(value_text(row, m));
        cells.push_back(row.found[m].solved() ? fixed(row.found[m].digits, 1) : "");
      }
      table.add(cells);
    }
  }
  return table.csv({"Quantities and units: README.md. Digits: -log10 of the relative error, at most what is carried."});
}

std::string benchmark_lines_csv(const std::vector<BenchmarkResult>& results) {
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
  return table.csv({"The exact lines of the pictures follower_shapes and bend45."});
}

std::string benchmark_overview_csv(const std::vector<BenchmarkResult>& results) {
  Table table({"case", "source", "worth", "digits carried", "points", "exact", "FE", "FAM", "status"});
  for (const BenchmarkResult& result : results) {
    for (const BenchmarkSource& source : result.benchmark.sources) {
      const BenchmarkRows rows = rows_of(result, source.key);
      std::vector<std::string> cells = source_cells(source, rows);
      cells.insert(cells.begin(), {result.benchmark.key, source.key});
      cells.push_back(status_cell(rows));
      table.add(cells);
    }
  }
  return table.csv({"Digits: median (lowest) over the points of a source."});
}

std::string benchmark_timing_csv(const std::vector<BenchmarkResult>& results) {
  Table table(with_timing_columns({"benchmark", "point", "method"}));
  for (const BenchmarkResult& result : results) {
    const auto& [family, parameter] = result.benchmark.timed;
    for (std::size_t m = 0; m < result.times.size(); ++m) {
      table.add(
          with_timing({result.benchmark.key, fmt::format("{} {:g}", family, parameter), benchmark_methods()[m].column},
                      result.times[m], fixed, 3));
    }
  }
  return table.csv({machine_line(),
                    "One solve, warm; repeats 0: no solution. FAM: all of fam::solve, choice and error "
                    "estimate included."});
}

std::string benchmark_overview(const std::vector<BenchmarkResult>& results) {
  std::vector<std::string> columns{"case", "source", "worth", "carries", "points"};
  for (const BenchmarkMethod& method : benchmark_methods()) columns.push_back(method.row.name);
  Table table(columns);
  for (const BenchmarkResult& result : results) {
    for (const BenchmarkSource& source : result.benchmark.sources) {
      std::vector<std::string> cells = source_cells(source, rows_of(result, source.key));
      cells.insert(cells.begin(),
                   {fmt::format("[{}](#{})", result.benchmark.title, result.benchmark.key), source.title});
      table.add(cells);
    }
  }
  return table.markdown();
}

std::string critical_table(const BenchmarkResult& result) {
  std::vector<std::string> columns{"column", "classical"};
  for (const BenchmarkMethod& method : benchmark_methods()) columns.push_back(method.row.name);
  Table table(columns);
  for (const BenchmarkRow& row : result.rows) {
    std::vector<std::string> cells{row.point.label, published_text(row)};
    for (std::size_t m = 0; m < row.found.size(); ++m) {
      cells.push_back(row.found[m].solved() ? value_text(row, m) : row.found[m].status);
    }
    table.add(cells);
  }
  return table.markdown();
}

}  // namespace studies
