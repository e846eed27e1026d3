// Benchmarks: numbers that others published, the scenes they belong to, and what the methods find there.
#pragma once

#include "studies/compare/data_file.h"
#include "studies/compare/stopwatch.h"
#include "studies/methods/registry.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace studies {

struct BenchmarkSource {
  std::string key;
  std::string title;
  std::string worth;        // published, digitised, computed, measured, closed form
  int digits = 10;          // at most, where the print claims more than it is worth; beyond 10 lies round-off
  std::string reason = {};  // why its digits may be off
  bool again = false;       // the points of the source before, beside another scene: not counted twice

  bool independent() const { return worth == "computed" || worth == "closed form"; }  // worth its digits
};

// The quantities of a point, from an equilibrium; `published` for those that look for the nearest point.
using Observe = std::function<std::vector<double>(const scene::Equilibrium&, const std::vector<Printed>& published)>;

// Scenes that differ in one parameter, and what is observed of them.
struct BenchmarkFamily {
  std::string name, parameter;  // as on an axis, with its unit
  std::function<scene::Scene(double parameter)> scene_at;
  Observe observe;
  double first = 0, last = 0;  // of an exact line in a picture
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
  std::pair<std::string, double> timed;  // family and parameter of the solve that is timed
  int elements = 50;                     // of FE
  std::vector<BenchmarkSource> sources;
  std::vector<BenchmarkFamily> families = {};
  std::vector<BenchmarkPoint> points = {};
};

// --- What was found -------------------------------------------------------------------------------------------------

struct BenchmarkMethod {
  std::string column;  // in CSV files
  const MethodRow& row;
};
enum { by_exact, by_fe, by_fam };
const std::vector<BenchmarkMethod>& benchmark_methods();
constexpr double fam_tolerance = 1e-8;  // over L: beyond what any print is worth

struct BenchmarkFound {
  std::string status;          // "converged", else why there is no value
  std::vector<double> values;  // only where converged
  double digits = 0;

  bool solved() const { return status == "converged"; }
};

struct BenchmarkRow {
  BenchmarkPoint point;
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

using BenchmarkRows = std::vector<const BenchmarkRow*>;
BenchmarkRows rows_of(const BenchmarkResult& result, const std::string& source);
BenchmarkRows rows_where(const std::vector<BenchmarkResult>& results,
                         const std::function<bool(const BenchmarkSource&)>& wanted);

// What a method reaches on some points.
struct DigitSummary {
  int points = 0, solved = 0, full = 0;  // full: matches all digits that are carried
  int fewest_carried = 0, most_carried = 0;
  double median = 0, lowest = 0;  // matching digits where solved
  std::string failure;            // the first status that is not "converged"
};
DigitSummary digit_summary(const BenchmarkRows& rows, std::size_t method);

// Differences to the print over the point's scale: of vectors by norm, and of the component that differs most.
double difference(const BenchmarkRow& row, std::size_t method);
double largest_difference(const BenchmarkRow& row, std::size_t method);
double printed_difference(const BenchmarkRow& row);  // up to which largest_difference rounds to the print

// --- What is written ------------------------------------------------------------------------------------------------

std::string benchmark_points_csv(const std::vector<BenchmarkResult>& results);
std::string benchmark_lines_csv(const std::vector<BenchmarkResult>& results);
std::string benchmark_overview_csv(const std::vector<BenchmarkResult>& results);
std::string benchmark_timing_csv(const std::vector<BenchmarkResult>& results);
std::string benchmark_overview(const std::vector<BenchmarkResult>& results);  // Markdown
std::string critical_table(const BenchmarkResult& result);

std::string digits_picture(const std::vector<BenchmarkResult>& results);
std::string differences_picture(const BenchmarkResult& result);
std::string shapes_picture(const BenchmarkResult& result);
std::string bend45_picture(const BenchmarkResult& result);

// File name to content.
std::map<std::string, std::string> benchmark_files(const std::vector<BenchmarkResult>& results,
                                                   const std::filesystem::path& page_md);

}  // namespace studies
