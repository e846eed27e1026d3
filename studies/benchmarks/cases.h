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

}  // namespace studies
