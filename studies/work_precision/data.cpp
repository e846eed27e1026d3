#include "studies/work_precision/data.h"

#include "studies/compare/error_measures.h"
#include "studies/report/table.h"
#include "studies/work_precision/competitors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace studies {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void add_once(std::vector<std::string>& list, const std::string& text) {
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

// Infinite values stay so: between a number and them there is nothing to interpolate.
double quantile_or_infinite(std::vector<double> values, double share) {
  constexpr double huge = 1e200;
  for (double& value : values) value = std::min(value, huge);
  const double found = quantile(std::move(values), share);
  return found < 1e-6 * huge ? found : infinite;
}

}  // namespace

std::string key(WorkGroup group) {
  return group == WorkGroup::follower ? "follower" : group == WorkGroup::fixed ? "fixed" : "robots";
}

std::string title(WorkGroup group) {
  return group == WorkGroup::follower ? "Follower loads" : group == WorkGroup::fixed ? "Fixed loads" : "Robots";
}

std::vector<const WorkPoint*> WorkData::of(const std::string& scene, const std::string& series,
                                           const std::string& model) const {
  std::vector<const WorkPoint*> list;
  for (const WorkPoint& p : points) {
    if (p.scene == scene && p.series == series && p.model == model) list.push_back(&p);
  }
  return list;
}

std::vector<std::string> WorkData::names(WorkGroup group) const {
  std::vector<std::string> list;
  for (const WorkScene& scene : scenes) {
    if (scene.group == group) list.push_back(scene.name);
  }
  return list;
}

std::vector<std::string> WorkData::labels(const std::string& series, const std::string& model,
                                          const std::vector<std::string>& of_scenes) const {
  std::vector<std::string> list;
  std::size_t longest = 0;
  // The scene with the most resolutions first: it has them all in order.
  for (const std::string& scene : of_scenes) longest = std::max(longest, of(scene, series, model).size());
  for (const bool all : {true, false}) {
    for (const std::string& scene : of_scenes) {
      const auto tried = of(scene, series, model);
      if ((tried.size() == longest) != all) continue;
      for (const WorkPoint* p : tried) add_once(list, p->label);
    }
  }
  return list;
}

std::string target_text(double target) {
  return scientific(target, 0) + " L";
}

std::string Contestant::name() const {
  return method_row(method).name;
}

const std::vector<Contestant>& contestants() {
  static const std::vector<Contestant> list = {
      {"fam", "Reissner", {"fam automatic"}},
      {"fam_sixth_order", "Reissner", {"fam sixth_order"}},
      {"fam_fourth_order", "Reissner", {"fam fourth_order"}},
      {"fam_published", "Kirchhoff", {"fam published"}},
      {"rk4", "Reissner", {"rk4 shooting"}},
      {"exact", "Reissner", {"exact reference"}},
      {"fe", "Reissner", {"fe quadratic whole load", "fe quadratic adaptive"}}};
  return list;
}

const Contestant& contestant(const std::string& method) {
  return *std::find_if(contestants().begin(), contestants().end(),
                       [&](const Contestant& c) { return c.method == method; });
}

double time_to_us(const WorkData& data, const std::string& scene, const std::string& series, const std::string& model,
                  double target, bool warm) {
  const bool as_asked = series_named(series).method == "fam";
  double best = infinite;
  for (const WorkPoint* p : data.of(scene, series, model)) {
    if (as_asked && p->label != target_text(target)) continue;
    const std::optional<Timing>& time = warm ? p->warm : p->time;
    if (p->converged() && p->error <= target && time) best = std::min(best, time->median_us);
  }
  return best;
}

double time_to_us(const WorkData& data, const std::string& scene, const Contestant& contestant, double target) {
  double best = infinite;
  for (const std::string& series : contestant.series) {
    best = std::min(best, time_to_us(data, scene, series, contestant.model, target));
  }
  return best;
}

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {infinite, infinite, infinite, 0, 0};
  const auto finite = std::count_if(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  return {quantile_or_infinite(values, 0.5), quantile_or_infinite(values, 0.25), quantile_or_infinite(values, 0.75),
          static_cast<int>(finite), static_cast<int>(values.size())};
}

Spread times_to_us(const WorkData& data, WorkGroup group, const Contestant& contestant, double target) {
  std::vector<double> times;
  for (const std::string& scene : data.names(group)) times.push_back(time_to_us(data, scene, contestant, target));
  return spread_of(times);
}

Spread ratios_to_automatic(const WorkData& data, WorkGroup group, const Contestant& rival, double target) {
  std::vector<double> ratios;
  for (const std::string& scene : data.names(group)) {
    const double automatic = time_to_us(data, scene, contestant("fam"), target);
    if (std::isfinite(automatic)) ratios.push_back(time_to_us(data, scene, rival, target) / automatic);
  }
  return spread_of(ratios);
}

std::vector<int> wins_of(const WorkData& data, WorkGroup group, const std::vector<Contestant>& among, double target) {
  std::vector<int> wins(among.size(), 0);
  for (const std::string& scene : data.names(group)) {
    double best = infinite;
    std::size_t winner = among.size();
    for (std::size_t i = 0; i < among.size(); ++i) {
      const double time = time_to_us(data, scene, among[i], target);
      if (time < best) best = time, winner = i;
    }
    if (winner < among.size()) ++wins[winner];
  }
  return wins;
}

}  // namespace studies
