// Tables, pictures and page of the benchmarks, as pure functions of what was found.
#pragma once

#include "studies/benchmarks/benchmark.h"

#include <map>

namespace studies {

// File name to content.
std::map<std::string, std::string> benchmark_files(const std::vector<BenchmarkResult>& results);

// What a method reaches over the points of a source: the median and the lowest number of matching digits.
struct DigitSummary {
  int points = 0, solved = 0;
  int fewest_carried = 0, most_carried = 0;
  double median = 0, lowest = 0;
  std::string failure;  // the first status that is not "converged"
};
DigitSummary digit_summary(const BenchmarkResult& result, const std::string& source, std::size_t method);

// One picture a benchmark, file name to SVG (benchmark_pictures.cpp).
std::map<std::string, std::string> benchmark_pictures(const std::vector<BenchmarkResult>& results);

// A sentence or two of each benchmark for the reader (benchmark_texts.cpp).
std::string benchmark_text(const std::string& key);

}  // namespace studies
