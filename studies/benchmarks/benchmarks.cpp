// fam-studies benchmarks: reads the scenes of studies/cases/benchmarks and the published numbers of tests/data, solves
// each point with three methods, writes points.csv, overview.csv, timing.csv, pictures and a page.
#include "studies/benchmarks/cases.h"
#include "studies/compare/error_measures.h"
#include "studies/compare/matching_digits.h"
#include "studies/report/provenance.h"
#include "studies/scenes/cases.h"
#include "studies/study.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace studies {
namespace {

using Methods = std::vector<std::unique_ptr<Method>>;

// As benchmark_methods(), each with the shear and stretch that the scene has.
Methods methods_for(const Benchmark& benchmark) {
  const std::vector<BenchmarkMethod>& methods = benchmark_methods();
  Methods made;
  made.push_back(methods[by_exact].row());
  made.push_back(methods[by_fe].row({.count = benchmark.elements, .estimate_error = false}));
  made.push_back(methods[by_fam].row({.tolerance = fam_tolerance}));
  return made;
}

const BenchmarkFamily& family_of(const Benchmark& benchmark, const std::string& name) {
  for (const BenchmarkFamily& family : benchmark.families) {
    if (family.name == name) return family;
  }
  throw std::logic_error(benchmark.key + ": no family " + name);
}

double size_of(const scene::Load& load) {
  if (const auto* force = known_load<scene::Force>(load)) return force->value_N.norm();
  return std::get<scene::DistributedForce>(load).value_N_per_mm.norm();
}

// The load at which `stable` turns from true to false, halved in until it is not decided or the bracket is 1e-11 wide.
BenchmarkFound find_critical(const BenchmarkFamily& family, const Method& method) {
  const auto stable = [&](double factor) { return method.solve(family.scene_at(factor)).stable; };
  const scene::Equilibrium first = method.solve(family.scene_at(0.5));
  if (!first.converged()) return {scene::name(first.status), {}, 0};
  if (!first.stable) return {"stability not decided", {}, 0};
  double low = 0.5, high = 1.5;
  if (first.stable != true || stable(high) != false) return {"no change of stability", {}, 0};
  while (high - low > 1e-11) {
    const double middle = (low + high) / 2;
    const std::optional<bool> here = stable(middle);
    if (!here) low = high = middle;
    else (*here ? low : high) = middle;
  }
  return {"converged", {(low + high) / 2 * size_of(family.scene_at(1).loads.front())}, 0};
}

// Points of one family and parameter share their solves.
class Solves {
 public:
  Solves(const Benchmark& benchmark, const Methods& methods) : benchmark_(benchmark), methods_(methods) {}

  const std::vector<scene::Equilibrium>& at(const std::string& family, double parameter) {
    std::vector<scene::Equilibrium>& results = results_[{family, parameter}];
    if (results.empty()) {
      const scene::Scene scene = family_of(benchmark_, family).scene_at(parameter);
      for (const auto& method : methods_) results.push_back(method->solve(scene));
    }
    return results;
  }

 private:
  const Benchmark& benchmark_;
  const Methods& methods_;
  std::map<std::pair<std::string, double>, std::vector<scene::Equilibrium>> results_;
};

BenchmarkRow row_at(const Benchmark& benchmark, const BenchmarkPoint& point, const Methods& methods, Solves& solves) {
  const BenchmarkFamily& family = family_of(benchmark, point.family);
  BenchmarkRow row{point, std::min(point.digits, carried_digits(point.published, point.scale)), {}};
  for (std::size_t m = 0; m < methods.size(); ++m) {
    BenchmarkFound found;
    if (family.critical) {
      found = find_critical(family, *methods[m]);
    } else {
      const scene::Equilibrium& result = solves.at(point.family, point.parameter)[m];
      found.status = scene::name(result.status);
      if (result.converged()) found.values = family.observe(result, point.published);
    }
    if (!found.values.empty()) found.digits = matching_digits(found.values, point.published, point.scale, point.digits);
    row.found.push_back(found);
  }
  return row;
}

BenchmarkLine line_of(const BenchmarkFamily& family, const Method& exact) {
  BenchmarkLine line{family.name, {}};
  if (family.shape) {
    const scene::Equilibrium result = exact.solve(family.scene_at(family.first));
    for (int i = 0; i <= 50 && result.converged(); ++i) {
      const double s_mm = result.stations.back().s_mm * i / 50;
      const Eigen::Vector3d p = position_at_mm(result, s_mm);
      line.samples.push_back({s_mm, p.x(), p.y()});
    }
    return line;
  }
  for (int i = 0; i <= family.intervals; ++i) {
    const double parameter = family.first + (family.last - family.first) * i / family.intervals;
    const scene::Equilibrium result = exact.solve(family.scene_at(parameter));
    if (!result.converged()) continue;
    line.samples.push_back({parameter});
    for (const double value : family.observe(result, {})) line.samples.back().push_back(value);
  }
  return line;
}

BenchmarkResult run(const Benchmark& benchmark, const StudyOptions& options) {
  BenchmarkResult result{benchmark, {}, {}, {}};
  const Methods methods = methods_for(benchmark);
  Solves solves(benchmark, methods);
  for (const BenchmarkPoint& point : benchmark.points) {
    result.rows.push_back(row_at(benchmark, point, methods, solves));
  }
  for (const BenchmarkFamily& family : benchmark.families) {
    if (family.intervals > 0) result.lines.push_back(line_of(family, *methods[0]));
  }
  const auto& [family, parameter] = benchmark.timed;
  const scene::Scene scene = family_of(benchmark, family).scene_at(parameter);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const bool solved = solves.at(family, parameter)[m].converged();
    result.times.push_back(solved ? time_of(options, methods[m]->bare_solve(scene), 0.3) : Timing{});
  }
  return result;
}

}  // namespace

void benchmarks(const StudyOptions& options) {
  std::vector<Benchmark> all = planar_benchmarks(options);
  for (Benchmark& benchmark : spatial_benchmarks(options)) all.push_back(std::move(benchmark));
  Progress progress("benchmarks", all.size(), options.progress);
  std::vector<BenchmarkResult> results;
  for (const Benchmark& benchmark : all) {
    progress.step(benchmark.key);
    results.push_back(run(benchmark, options));
  }
  write_results(options.output / "benchmarks", "fam-studies benchmarks",
                benchmark_files(results, options.pages / "benchmarks/page.md"));
}

}  // namespace studies
