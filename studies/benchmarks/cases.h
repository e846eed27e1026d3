// The published benchmarks, from the data files and the scene files of the project.
#pragma once

#include "studies/benchmarks/data.h"
#include "studies/study.h"

namespace studies {

std::vector<Benchmark> planar_benchmarks(const StudyOptions& options);
std::vector<Benchmark> spatial_benchmarks(const StudyOptions& options);

// Shared by the two.
scene::Scene scaled(scene::Scene scene, double factor);  // all loads times a factor
scene::Scene benchmark_scene(const StudyOptions& options, const std::string& name);
// scale 0: the norm of what is published.
BenchmarkPoint benchmark_point(const BenchmarkSource& source, const std::string& family, const std::string& label,
                               double parameter, const std::vector<Printed>& published, double scale = 0);
// The rows of a file whose parameter is one of these, a point each; "name" of "name = value" stands in its label.
struct ChosenRows {
  std::string file, parameter, name;
  std::vector<double> values;
  std::vector<std::string> published;  // columns
};
void add_points(Benchmark& benchmark, const BenchmarkSource& source, const std::string& family,
                const StudyOptions& options, const ChosenRows& chosen);

}  // namespace studies
