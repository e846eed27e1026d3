#include "studies/report/page.h"

#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/work_precision/competitors.h"
#include "studies/work_precision/data.h"
#include "studies/work_precision/instructions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

constexpr double printed_fam_ms = 3, printed_fe_ms = 1244;  // the paper's abstract, its machine and loads

// What a user calls, and what a program that knows its resolution beforehand can call.
const std::vector<std::string> called = {"fam", "rk4", "exact", "fe"},
                               kernels = {"fam_sixth_order", "fam_fourth_order", "rk4", "fe"};

std::vector<Contestant> among(const std::vector<std::string>& methods) {
  std::vector<Contestant> list;
  for (const std::string& method : methods) list.push_back(contestant(method));
  return list;
}

// "15.6 µs (11.0 … 21.2; 15 of 17)": median, quartiles, scenes that reach the target where these are not all.
std::string time_phrase(const WorkData& data, WorkGroup group, const std::string& method, double target) {
  const Spread time = times_to_us(data, group, contestant(method), target);
  if (!std::isfinite(time.median)) return fmt::format("– ({} of {})", time.reached, time.scenes);
  const std::string share = time.reached == time.scenes ? "" : fmt::format("; {} of {}", time.reached, time.scenes);
  return fmt::format("{} ({} … {}{})", time_text(time.median), time_text(time.lower), time_text(time.upper), share);
}

enum class Counts { told, left_out };

// "RK4 shooting at 1e-2 L (on 13 of 21); FAM automatic at 1e-5, 1e-8 L (on 14, 20 of 21)": who wins on most scenes.
std::string winners(const WorkData& data, WorkGroup group, const std::vector<std::string>& methods,
                    Counts wanted = Counts::told) {
  std::vector<std::string> parts;
  for (const std::string& method : methods) {
    std::vector<std::string> targets, counts;
    for (const double target : work_targets) {
      const std::vector<int> wins = wins_of(data, group, among(methods), target);
      const auto most = std::max_element(wins.begin(), wins.end());
      if (*most == 0 || methods[static_cast<std::size_t>(most - wins.begin())] != method) continue;
      targets.push_back(for_reader(scientific(target, 0)));
      counts.push_back(std::to_string(*most));
    }
    if (targets.empty()) continue;
    parts.push_back(fmt::format("{} at {} L", method_row(method).name, fmt::join(targets, ", ")));
    if (wanted == Counts::told)
      parts.back() += fmt::format(" (on {} of {})", fmt::join(counts, ", "), data.names(group).size());
  }
  return parts.empty() ? "not timed" : fmt::format("{}", fmt::join(parts, "; "));
}

// A group in a sentence or two.
std::string group_answer(const WorkData& data, WorkGroup group) {
  return for_reader(
      fmt::format("{} ({} scenes), fastest as called: {}. For a tip within 1e-3 L `fam solve` takes "
                  "{}, its bare "
                  "kernel (sixth order, fewest arcs) {}, RK4 shooting with the fewest steps {}, FE {}.",
                  title(group), data.names(group).size(), winners(data, group, called),
                  time_phrase(data, group, "fam", 1e-3), time_phrase(data, group, "fam_sixth_order", 1e-3),
                  time_phrase(data, group, "rk4", 1e-3), time_phrase(data, group, "fe", 1e-3)));
}

// All groups in a line.
std::string short_answer(const WorkData& data) {
  std::vector<std::string> fastest, fam_times, fe_times;
  for (const WorkGroup group : work_groups) {
    const auto time = [&](const std::string& method) {
      return time_text(times_to_us(data, group, contestant(method), 1e-3).median);
    };
    fastest.push_back(title(group) + ": " + winners(data, group, called, Counts::left_out));
    fam_times.push_back(time("fam"));
    fe_times.push_back(time("fe"));
  }
  return for_reader(fmt::format("Fastest on most scenes. {}. Within 1e-3 L `fam solve` takes {}, FE {}",
                                fmt::join(fastest, ". "), fmt::join(fam_times, ", "), fmt::join(fe_times, ", ")));
}

// What the load steps that keep finite elements to their branch cost: their time over that of the whole load at once.
Spread cost_of_stepping(const WorkData& data) {
  std::vector<double> ratios;
  for (const WorkScene& scene : data.scenes) {
    const auto time = [&](const std::string& series) { return time_to_us(data, scene.name, series, "Reissner", 1e-3); };
    const double ratio = time("fe quadratic adaptive") / time("fe quadratic whole load");
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  return spread_of(ratios);
}

// Scenes where plain shooting with the most steps ends elsewhere or nowhere, and how.
std::string without_shooting(const WorkData& data) {
  std::vector<std::string> list;
  for (const WorkScene& scene : data.scenes) {
    const WorkPoint& finest = *data.of(scene.name, "rk4 shooting", "Reissner").back();
    if (!finest.converged()) list.push_back(scene.name + " (no answer)");
    else if (finest.error > lost_error) list.push_back(scene.name + " (another equilibrium)");
  }
  return fmt::format("{}", fmt::join(list, ", "));
}

double largest_reference_error(const WorkData& data) {
  double largest = 0;
  for (const WorkPoint& p : data.points) largest = std::max(largest, p.reference_error);
  return largest;
}

void set_times(Page& page, const WorkData& data) {
  for (const WorkGroup group : work_groups) {
    page.set_time("answer_" + key(group), group_answer(data, group));
    page.set_time("kernels_" + key(group), winners(data, group, kernels));
    page.set_time("times_" + key(group), times_table(data, group));
    page.set_time("ratios_" + key(group), ratios_table(data, group));
  }
  page.set_time("instructions", instructions_table(data));
  page.set_time("races_answer", races_answer(data.races));
  page.set_time("races", races_table(data.races));
  page.set_time("aims", aims_table(data));
  page.set_time("machine", machine_line());
  const Spread stepping = cost_of_stepping(data);
  page.set_time("stepping",
                fmt::format("{} ({} … {}; {})", significant(stepping.median, 2), significant(stepping.lower, 2),
                            significant(stepping.upper, 2), stepping.scenes));
}

}  // namespace

std::string work_precision_page(const WorkData& data, const std::filesystem::path& page_md) {
  Page page;
  page.set("scenes", std::to_string(data.scenes.size()));
  for (const WorkGroup group : work_groups) {
    page.set(key(group), std::to_string(data.names(group).size()));
    page.set("resolutions_" + key(group), resolutions_table(data, group));
  }
  page.set("with_tendons", std::to_string(std::count_if(data.scenes.begin(), data.scenes.end(),
                                                        [](const WorkScene& scene) { return scene.has_tendons; })));
  page.set("reference", for_reader(scientific(largest_reference_error(data), 0)));
  page.set("failures", failures_table(data));
  page.set("races_right", races_right(data.races));
  page.set("lost", fmt::format("{}", lost_error));
  page.set("without_shooting", without_shooting(data));
  page.check("shooting_fails", !without_shooting(data).empty());
  page.set("printed_fam", fmt::format("{}", printed_fam_ms));
  page.set("printed_fe", fmt::format("{}", printed_fe_ms));
  page.set("printed_ratio", fixed(printed_fe_ms / printed_fam_ms, 0));
  set_times(page, data);
  return page.fill(page_md);
}

Answers work_precision_answers(const WorkData& data) {
  return {{"fastest", timed(short_answer(data))}};
}

}  // namespace studies
