// Marks and colours that the pictures of the benchmarks share, and the pictures that are of one benchmark alone.
#pragma once

#include "studies/benchmarks/benchmark.h"
#include "studies/report/chart.h"

namespace studies {

// As benchmark_methods(): exact a line, FE squares, FAM triangles.
constexpr std::size_t fe = 1, fam = 2;
inline const std::vector<std::string> method_colours = {colour::black, colour::orange, colour::blue};

void square(Svg& svg, Point p, const std::string& colour);
void triangle(Svg& svg, Point p, const std::string& colour);
std::string source_colour(const BenchmarkResult& result, const std::string& key);

std::string shapes_picture(const BenchmarkResult& result);
std::string bend45_picture(const BenchmarkResult& result);
std::string critical_picture(const BenchmarkResult& result);

}  // namespace studies
