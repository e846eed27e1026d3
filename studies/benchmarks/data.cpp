#include "studies/benchmarks/data.h"

#include "studies/compare/error_measures.h"
#include "studies/compare/matching_digits.h"

#include <algorithm>
#include <cmath>

namespace studies {

const std::vector<BenchmarkMethod>& benchmark_methods() {
  static const std::vector<BenchmarkMethod> methods = {
      {"exact", method_row("exact")}, {"FE", method_row("fe")}, {"FAM", method_row("fam")}};
  return methods;
}

BenchmarkRows rows_of(const BenchmarkResult& result, const std::string& source) {
  BenchmarkRows rows;
  for (const BenchmarkRow& row : result.rows) {
    if (row.point.source == source) rows.push_back(&row);
  }
  return rows;
}

BenchmarkRows rows_where(const std::vector<BenchmarkResult>& results,
                         const std::function<bool(const BenchmarkSource&)>& wanted) {
  BenchmarkRows rows;
  for (const BenchmarkResult& result : results) {
    for (const BenchmarkSource& source : result.benchmark.sources) {
      if (!wanted(source)) continue;
      for (const BenchmarkRow* row : rows_of(result, source.key)) rows.push_back(row);
    }
  }
  return rows;
}

DigitSummary digit_summary(const BenchmarkRows& rows, std::size_t method) {
  DigitSummary s;
  std::vector<double> digits;
  for (const BenchmarkRow* row : rows) {
    s.fewest_carried = s.points == 0 ? row->carried : std::min(s.fewest_carried, row->carried);
    s.most_carried = std::max(s.most_carried, row->carried);
    ++s.points;
    const BenchmarkFound& found = row->found[method];
    if (found.solved()) digits.push_back(found.digits);
    else if (s.failure.empty()) s.failure = found.status;
    if (found.solved() && found.digits >= row->carried) ++s.full;
  }
  s.solved = static_cast<int>(digits.size());
  if (digits.empty()) return s;
  s.lowest = *std::min_element(digits.begin(), digits.end());
  s.median = quantile(digits, 0.5);
  return s;
}

double difference(const BenchmarkRow& row, std::size_t method) {
  double squares = 0;
  for (std::size_t i = 0; i < row.point.published.size(); ++i) {
    squares += std::pow(row.found[method].values.at(i) - row.point.published[i].value, 2);
  }
  return std::sqrt(squares) / row.point.scale;
}

double largest_difference(const BenchmarkRow& row, std::size_t method) {
  double largest = 0;
  for (std::size_t i = 0; i < row.point.published.size(); ++i) {
    largest = std::max(largest, std::abs(row.found[method].values.at(i) - row.point.published[i].value));
  }
  return largest / row.point.scale;
}

double printed_difference(const BenchmarkRow& row) {
  int decimals = 0;
  for (const Printed& p : row.point.published) decimals = std::max(decimals, p.decimals);
  return std::max(0.5 * std::pow(10, -decimals) / row.point.scale, std::pow(10, -row.carried));
}

}  // namespace studies
