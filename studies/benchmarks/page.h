// What the two halves of the page share.
#pragma once

#include "studies/benchmarks/data.h"
#include "studies/report/page.h"

namespace studies {

using BenchmarkResults = std::vector<BenchmarkResult>;

const BenchmarkResult& result_of(const BenchmarkResults& results, const std::string& key);
std::string digits_text(double digits);
std::string digits_of(const BenchmarkRows& rows, std::size_t method);  // "10.0 (6.0)": median and lowest

void set_cases(Page& page, const BenchmarkResults& results);

}  // namespace studies
