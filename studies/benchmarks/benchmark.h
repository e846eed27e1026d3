// A benchmark: numbers that others published, the scenes they belong to, and what the methods find there.
#pragma once

#include "studies/compare/data_file.h"
#include "studies/compare/stopwatch.h"
#include "studies/methods/method.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace studies {

struct BenchmarkSource {
  std::string key;
  std::string title;
  std::string worth;  // published, digitised, computed, measured, closed form
  int digits = 10;    // at most, where the print claims more than it is worth; beyond 10 lies round-off
};

// The quantities of a point, from an equilibrium; `published` for those that look for the nearest point.
using Observe = std::function<std::vector<double>(const scene::Equilibrium&, const std::vector<Printed>& published)>;

// Scenes that differ in one parameter, and what is observed of them.
struct BenchmarkFamily {
  std::string name;
  std::function<scene::Scene(double parameter)> scene_at;
  Observe observe;
  double first = 0, last = 0;  // of the exact line in the picture
  int intervals = 0;           // 0: no line
  bool shape = false;          // the line is the centreline at `first`, x and y
  bool critical = false;       // the parameter is a load factor; observed is the one at which `stable` flips
};

struct BenchmarkPoint {
  std::string source, family, label;
  double parameter = 0;
  std::vector<Printed> published;
  double scale = 0;  // of errors, in the units of what is published
  int digits = 10;   // at most, as the source says
};

struct Benchmark {
  std::string key, title;
  std::string quantities;                // with units, in the order of the values
  std::string scene;                     // a scene file to rerun, in studies/cases/benchmarks
  std::pair<std::string, double> timed;  // family and parameter of the solve that is timed
  int elements = 50;                     // quadratic, of FE, and arcs of FAM
  std::vector<BenchmarkSource> sources;
  std::vector<BenchmarkFamily> families;
  std::vector<BenchmarkPoint> points;
  std::vector<std::vector<double>> dotted = {};  // more of the first source, for the picture: parameter, values
};

// --- What was found -------------------------------------------------------------------------------------------------

struct BenchmarkFound {
  std::string status;          // "converged", else why there is no value
  std::vector<double> values;  // only where converged
  double digits = 0;
};

struct BenchmarkRow {
  BenchmarkPoint point;               //
  int carried = 0;                    // digits
  std::vector<BenchmarkFound> found;  // as benchmark_methods()
};

// An exact line of a picture: a parameter and what is observed there.
struct BenchmarkLine {
  std::string family;
  std::vector<std::vector<double>> samples;  // parameter, values
};

struct BenchmarkResult {
  Benchmark benchmark;
  std::vector<BenchmarkRow> rows;
  std::vector<BenchmarkLine> lines;
  std::vector<Timing> times;  // as benchmark_methods(); repeats 0: not solved
};

// "exact", "FE", "FAM".
const std::vector<std::string>& benchmark_methods();

}  // namespace studies
