// fam-studies benchmarks: reads the scenes of studies/cases/benchmarks and the published numbers of tests/data, solves
// each point with the methods below, writes points.csv, lines.csv, overview.csv, a picture a benchmark and README.md
// (benchmark_page.cpp, benchmark_pictures.cpp), timing.csv and timing.md to results/benchmarks. Half a minute.
#include "studies/scenes/cases.h"
#include "studies/study.h"

#include "scene/load_visitor.h"
#include "studies/benchmarks/cases.h"
#include "studies/benchmarks/page.h"
#include "studies/compare/error_measures.h"
#include "studies/compare/matching_digits.h"
#include "studies/methods/exact_method.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/fem_method.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace studies {
namespace {

using Methods = std::vector<std::unique_ptr<Method>>;

// As benchmark_methods().
Methods methods_for(const Benchmark& benchmark) {
  fem_reference::Options fem;
  fem.elements = benchmark.elements;
  fem.estimate_error = false;
  fam::Options fam;
  fam.law = fam::Law::fourth_order;
  fam.model = fam::RodModel::reissner;
  fam.arcs = benchmark.elements;
  fam.estimate_error = false;
  Methods methods;
  methods.push_back(exact_method({}));
  methods.push_back(fem_method(fem));
  methods.push_back(fam_method(fam));
  return methods;
}

const BenchmarkFamily& family_of(const Benchmark& benchmark, const std::string& name) {
  for (const BenchmarkFamily& family : benchmark.families) {
    if (family.name == name) return family;
  }
  throw std::logic_error(benchmark.key + ": no family " + name);
}

double size_of(const scene::Load& load) {
  return scene::visit_load(
      load, [](const scene::Force& force) { return force.value_N.norm(); },
      [](const scene::Moment& moment) { return moment.value_Nmm.norm(); },
      [](const scene::DistributedForce& force) { return force.value_N_per_mm.norm(); },
      [](const scene::Gravity& gravity) { return gravity.acceleration_m_per_s2.norm(); },
      [](const scene::Tendon& tendon) { return tendon.tension_N; });
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

// `stable` at load factors 1 -+ 10^-k: 1 true, 0 false, -1 not decided.
BenchmarkLine stability_line(const BenchmarkFamily& family, const Method& exact) {
  BenchmarkLine line{family.name, {}};
  for (const double side : {-1.0, 1.0}) {
    for (int k = 1; k <= family.intervals; ++k) {
      const double offset = side * std::pow(10, -k);
      const std::optional<bool> stable = exact.solve(family.scene_at(1 + offset)).stable;
      line.samples.push_back({offset, stable ? static_cast<double>(*stable) : -1});
    }
  }
  return line;
}

BenchmarkLine line_of(const BenchmarkFamily& family, const Method& exact) {
  if (family.critical) return stability_line(family, exact);
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
    const double budget_s = options.quick ? 0 : 0.3;
    result.times.push_back(solved ? measure(methods[m]->bare_solve(scene), budget_s, options.quick ? 1 : 3) : Timing{});
  }
  return result;
}

}  // namespace

scene::Scene scaled(scene::Scene scene, double factor) {
  for (scene::Load& load : scene.loads) load = scene::scaled(load, factor);
  return scene;
}

scene::Scene benchmark_scene(const StudyOptions& options, const std::string& name) {
  return read_case(options.cases, "benchmarks/" + name);
}

BenchmarkPoint benchmark_point(const BenchmarkSource& source, const std::string& family, const std::string& label,
                               double parameter, const std::vector<Printed>& published, double scale) {
  return {source.key, family, label, parameter, published, scale == 0 ? norm(published) : scale, source.digits};
}

const std::vector<std::string>& benchmark_methods() {
  static const std::vector<std::string> names = {"exact", "FE", "FAM"};
  return names;
}

void benchmarks(const StudyOptions& options) {
  std::vector<Benchmark> all = planar_benchmarks(options);
  for (Benchmark& benchmark : spatial_benchmarks(options)) all.push_back(std::move(benchmark));
  Progress progress("benchmarks", all.size(), options.progress);
  std::vector<BenchmarkResult> results;
  for (const Benchmark& benchmark : all) {
    progress.step(benchmark.key);
    results.push_back(run(benchmark, options));
  }
  write_results(options.output / "benchmarks", "fam-studies benchmarks", benchmark_files(results));
}

}  // namespace studies
