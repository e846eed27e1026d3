#include "studies/report/table.h"

#include "studies/compare/data_file.h"
#include "studies/limits/data.h"
#include "studies/report/chart.h"
#include "studies/report/page.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace studies {
namespace {

using Is = std::function<bool(const Unanswered&)>;

int count(const std::vector<Unanswered>& scenes, const Is& is) {
  return static_cast<int>(std::count_if(scenes.begin(), scenes.end(), is));
}

bool judged(const Unanswered& u) {
  return u.is_limit() && !u.judge.empty();
}

bool confirmed(const Unanswered& u) {
  return judged(u) && u.judge == "limit_point" && std::abs(u.judge_factor / u.load_factor - 1) < same_factor;
}

Table counts(const std::vector<Unanswered>& scenes) {
  Table table({"why", "general", "buckling", "all", "of them without an energy"});
  const auto add = [&](const char* why, const Is& is) {
    const auto of = [&](const Is& also) {
      return std::to_string(count(scenes, [&](const Unanswered& u) { return is(u) && also(u); }));
    };
    table.add({why, of([](const Unanswered& u) { return u.seed < first_buckling_seed; }),
               of([](const Unanswered& u) { return u.seed >= first_buckling_seed; }),
               of([](const Unanswered&) { return true; }), of([](const Unanswered& u) { return !u.has_energy; })});
  };
  add("limit point: the load cannot grow, the rod snaps", [](const Unanswered& u) { return u.is_limit(); });
  add("a tendon's path has no length, v + u × r = 0", [](const Unanswered& u) { return u.collapsed(); });
  for (const char* status :
       {"load_step_too_small", "work_limit", "tolerance_not_met", "not_converged", "arc_not_converged"}) {
    const Is is = [&](const Unanswered& u) { return u.status == status; };
    if (count(scenes, is) > 0) add(status, is);
  }
  return table;
}

// At which share of the load rods snap.
std::string picture(const std::vector<Unanswered>& scenes) {
  constexpr int bins = 10;
  std::array<double, bins> height{};
  for (const Unanswered& u : scenes) {
    if (u.is_limit())
      ++height[static_cast<std::size_t>(std::clamp(static_cast<int>(bins * u.load_factor), 0, bins - 1))];
  }
  const double most = *std::max_element(height.begin(), height.end());
  Svg svg(640, 420, "At which share of its load does a rod snap?", "A histogram of limit points.",
          "limit points of random scenes");
  Panel panel(svg, {80, 66}, 500, 290, {"load factor", 0, 1, false}, {"scenes", 0, 1.1 * std::max(most, 1.0), false});
  panel.frame();
  for (int i = 0; i < bins; ++i) {
    const double low = i / static_cast<double>(bins), high = (i + 1) / static_cast<double>(bins),
                 y = height[static_cast<std::size_t>(i)];
    panel.curve({{low, 0}, {low, y}, {high, y}, {high, 0}}, {colour::blue, 1.8, ""});
  }
  return svg.str();
}

}  // namespace

std::string unanswered_csv(const std::vector<Unanswered>& scenes) {
  Table table({"seed", "kind", "has_energy", "status", "load_factor", "exact_status", "exact_load_factor"});
  for (const Unanswered& u : scenes) {
    table.add({std::to_string(u.seed), kind_of(u.seed), u.has_energy ? "1" : "0", u.status,
               u.load_factor > 0 ? significant(u.load_factor, 4) : "", u.judge,
               u.judge_factor > 0 ? significant(u.judge_factor, 4) : ""});
  }
  return table.csv({"Random scenes without an answer of fam::solve at 1e-4 L; the exact reference on a sample."});
}

std::vector<Unanswered> read_unanswered(const std::filesystem::path& file) {
  std::vector<Unanswered> scenes;
  for (const DataRow& row : data_rows(file)) {
    const auto number = [&](const char* column) { return row.at(column).empty() ? 0 : std::stod(row.at(column)); };
    scenes.push_back({std::stoull(row.at("seed")), row.at("has_energy") == "1", row.at("status"), number("load_factor"),
                      row.at("exact_status"), number("exact_load_factor")});
  }
  return scenes;
}

std::map<std::string, std::string> limit_files(const std::vector<Unanswered>& given,
                                               const std::filesystem::path& page_md) {
  // To the digits of the file, from which --quick tells the same.
  std::vector<Unanswered> scenes = given;
  for (Unanswered& u : scenes) {
    if (u.load_factor > 0) u.load_factor = std::stod(significant(u.load_factor, 4));
    if (u.judge_factor > 0) u.judge_factor = std::stod(significant(u.judge_factor, 4));
  }
  const int limits = count(scenes, [](const Unanswered& u) { return u.is_limit(); });
  const int numerical = count(scenes, [](const Unanswered& u) { return u.is_numerical(); });
  const int lost = count(scenes, [](const Unanswered& u) { return u.is_numerical() && u.judge == "converged"; });
  const std::string rate =
      numerical > 0 ? fmt::format("one in {}", limit_scenes / static_cast<std::uint64_t>(numerical)) : "none";
  Page page;
  page.set("scenes", std::to_string(limit_scenes));
  page.set("unanswered", std::to_string(scenes.size()));
  page.set("limits", std::to_string(limits));
  page.set("collapsed", std::to_string(count(scenes, [](const Unanswered& u) { return u.collapsed(); })));
  page.set("numerical", std::to_string(numerical));
  page.set("rate", rate);
  page.set("lost", std::to_string(lost));
  page.set("judged", std::to_string(count(scenes, judged)));
  page.set("confirmed", std::to_string(count(scenes, confirmed)));
  page.set("elsewhere",
           std::to_string(count(scenes, [](const Unanswered& u) { return judged(u) && u.judge == "converged"; })));
  page.set("same_factor", fmt::format("{:g}", same_factor));
  page.set("table", counts(scenes).markdown());
  const std::string answer = fmt::format(
      "of {} random scenes {} have no answer: on {} the rod snaps before its load is reached, on {} the method fails "
      "({})",
      limit_scenes, scenes.size(), limits, numerical, rate);
  return {{"unanswered.csv", unanswered_csv(scenes)},
          {"counts.csv", counts(scenes).csv()},
          {"limits.svg", picture(scenes)},
          {"README.md", page.fill(page_md)},
          {answers_file, answers_json({{"no_answer", answer}})}};
}

}  // namespace studies
