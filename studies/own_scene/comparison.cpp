#include "studies/own_scene/comparison.h"

#include "studies/compare/stopwatch.h"
#include "studies/methods/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

struct Contender {
  std::string key, row;
  Request request;
};

// The published law with the arcs of Study I, all else as `solve` has it.
const std::vector<Contender>& contenders() {
  static const std::vector<Contender> all = {{"fam", "fam", {}},
                                             {"published", "fam_published", {.count = 12}},
                                             {"fem", "fe", {}},
                                             {"exact", "exact", {}},
                                             {"rk4", "rk4", {}}};
  return all;
}

const Contender& contender(const std::string& key) {
  return *std::find_if(contenders().begin(), contenders().end(), [&](const Contender& c) { return c.key == key; });
}

std::unique_ptr<Method> method_of(const std::string& key) {
  return method_row(contender(key).row)(contender(key).request);
}

template <class Value>
const Value* fact(const scene::Equilibrium& result, const std::string& name) {
  for (const auto& [key, value] : result.model) {
    if (key == name) return std::get_if<Value>(&value);
  }
  return nullptr;
}

// "sixth_order, 2 arcs, in space, with shear, march"; of the others what their resolution says, and the solver.
std::string model_in_words(const Method& method, const scene::Equilibrium& result) {
  if (!result.converged()) return method.resolution();
  const auto* law = fact<std::string>(result, "law");
  std::string words = law ? *law : method.resolution();
  if (law) {
    const auto is = [&](const char* name) { return fact<bool>(result, name) && *fact<bool>(result, name); };
    if (const int* arcs = fact<int>(result, "arcs")) words += ", " + counted(*arcs, "arc");
    words += is("planar") ? ", in the plane" : is("torsion") ? ", in space" : ", in space without torsion";
    words += is("shear") ? ", with shear" : ", without shear";
  }
  if (const auto* solver = fact<std::string>(result, "solver")) words += ", " + *solver;
  if (result.stable && !*result.stable) words += ", unstable";
  return words;
}

std::optional<std::size_t> most_accurate(const std::vector<ComparedMethod>& methods) {
  std::optional<std::size_t> best;
  double least = 0;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const ComparedMethod& method = methods[i];
    if (!method.result.converged()) continue;
    if (method.key == "exact") return i;
    const double estimate_mm = method.key == "published" ? INFINITY : method.result.error_estimate_mm;
    if (!best || estimate_mm < least) best = i, least = estimate_mm;
  }
  return best;
}

ComparedMethod solved(const std::string& key, const scene::Scene& scene) {
  const std::unique_ptr<Method> method = method_of(key);
  const MethodRow& row = method_row(contender(key).row);
  ComparedMethod answer{key, label(row, contender(key).request), row.style, "", {}, 0, {}};
  const double first_s = seconds_of([&] { answer.result = method->solve(scene); });
  answer.model = model_in_words(*method, answer.result);
  if (answer.result.converged()) answer.time_us = time_us(method->bare_solve(scene), first_s);
  return answer;
}

std::string gate_failure(const std::string& what, const std::vector<Distance>& distances, const std::string& truth,
                         double gate_mm) {
  const auto fails = [&](const Distance& distance) { return !(distance.mm <= gate_mm); };
  const auto first = std::find_if(distances.begin(), distances.end(), fails);
  if (first == distances.end()) return "";
  const Distance most = farthest(distances);
  return fmt::format(
      "{}: {:.4g} mm from {} at s_mm = {:.10g}: must be <= {:g} mm ({} of {} stations fail, the first at "
      "s_mm = {:.10g})",
      what, most.mm, truth, most.s_mm, gate_mm, std::count_if(first, distances.end(), fails), distances.size(),
      first->s_mm);
}

}  // namespace

const std::vector<std::string>& compared_methods() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const Contender& c : contenders()) all.push_back(c.key);
    return all;
  }();
  return keys;
}

Comparison compare(const std::string& source, const scene::Scene& scene, const std::vector<std::string>& methods) {
  Comparison comparison{source, scene, {}, {}, {}};
  for (const std::string& key : methods) comparison.methods.push_back(solved(key, scene));
  comparison.reference = most_accurate(comparison.methods);
  const ComparedMethod* truth = comparison.truth();
  for (ComparedMethod& method : comparison.methods) {
    if (truth && &method != truth && method.result.converged())
      method.distances = station_distances(method.result, truth->result);
  }
  return comparison;
}

void compare_file(Comparison& comparison, const std::string& source, const std::vector<CentrelinePoint>& points) {
  ComparedFile& file = comparison.file.emplace(ComparedFile{source, points, {}, ""});
  const ComparedMethod* truth = comparison.truth();
  if (!truth) {
    const ComparedMethod& last = comparison.methods.back();
    file.failure = fmt::format("{}: {}: {}", last.key, scene::name(last.result.status), last.result.message);
    return;
  }
  const scene::Equilibrium result = method_of(truth->key)->solve(cut_at(comparison.scene, points));
  if (!result.converged()) {
    file.failure = fmt::format("{}: {}: {}", truth->key, scene::name(result.status), result.message);
    return;
  }
  for (const CentrelinePoint& point : points) {
    const auto after = std::lower_bound(result.stations.begin() + 1, result.stations.end() - 1, point.s_mm,
                                        [](const scene::Station& s, double s_mm) { return s.s_mm < s_mm; });
    const bool before_is_nearer = point.s_mm - (after - 1)->s_mm < after->s_mm - point.s_mm;
    const scene::Station& station = before_is_nearer ? *(after - 1) : *after;
    file.distances.push_back({point.s_mm, (point.position_B_mm - station.X_BS.position_B_mm).norm()});
  }
}

std::vector<std::string> gate_failures(const Comparison& comparison, double gate_mm) {
  const std::string truth = comparison.truth() ? comparison.truth()->key : "";
  std::vector<std::string> failures;
  if (comparison.file) {
    const ComparedFile& file = *comparison.file;
    if (!file.failure.empty()) failures.push_back(file.source + ": nothing to compare with: " + file.failure);
    const std::string failure = gate_failure(file.source, file.distances, truth, gate_mm);
    if (!failure.empty()) failures.push_back(failure);
    return failures;
  }
  for (const ComparedMethod& method : comparison.methods) {
    const std::string what = comparison.source + ": " + method.key;
    const scene::Status status = method.result.status;
    if (status == scene::Status::unsupported) continue;
    if (!method.result.converged()) {
      failures.push_back(fmt::format("{}: {}: {}", what, scene::name(status), method.result.message));
      continue;
    }
    const std::string failure = gate_failure(what, method.distances, truth, gate_mm);
    if (!failure.empty()) failures.push_back(failure);
  }
  return failures;
}

}  // namespace studies
