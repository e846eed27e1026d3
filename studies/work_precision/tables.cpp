#include "studies/compare/timing_cells.h"
#include "studies/report/table.h"

#include "studies/report/provenance.h"
#include "studies/work_precision/competitors.h"
#include "studies/work_precision/data.h"
#include "studies/work_precision/instructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace studies {

std::string work_error_text(double error) {
  return std::isfinite(error) ? scientific(std::max(error, work_error_floor), 1) : "–";
}

namespace {

std::string accuracy_csv(const WorkData& data) {
  Table table({"scene", "method", "model", "resolution", "status", "tip_error_over_L", "reference_error_over_L"});
  for (const WorkPoint& p : data.points) {
    table.add({p.scene, p.series, p.model, p.resolution, p.status, work_error_text(p.error),
               scientific(std::max(p.reference_error, work_error_floor), 0)});
  }
  return table.csv(
      {"Tip error over L against the exact rod of the method's own model (shear and stretch: Reissner; "
       "without: Kirchhoff); fam automatic chooses its model and is held to Reissner's.",
       "Errors below 1e-12 are written as 1e-12."});
}

std::string timing_csv(const WorkData& data) {
  Table table(with_timing_columns({"scene", "method", "model", "resolution", "status", "start"}));
  const auto add = [&](const WorkPoint& p, const char* start, const Timing& t) {
    table.add(with_timing({p.scene, p.series, p.model, p.resolution, p.status, start}, t, fixed, 2));
  };
  for (const WorkPoint& p : data.points) {
    if (p.time) add(p, "cold", *p.time);
    if (p.warm) add(p, "warm", *p.warm);
  }
  return table.csv({machine_line(),
                    "The bare solve; where the status is not converged, until it gave up. Quartiles from seven "
                    "repeats on."});
}

std::string time_to_csv(const WorkData& data) {
  Table table({"scene", "group", "method", "model", "start", "target_over_L", "time_us"});
  const auto add = [&](const WorkScene& scene, const std::string& series, const std::string& model, bool warm) {
    for (const double target : work_targets) {
      const double time = time_to_us(data, scene.name, series, model, target, warm);
      table.add({scene.name, key(scene.group), series, model, warm ? "warm" : "cold", scientific(target, 0),
                 std::isfinite(time) ? fixed(time, 2) : "nan"});
    }
  };
  for (const WorkScene& scene : data.scenes) {
    for (const std::string& model : work_models) {
      for (const Series& series : all_series()) {
        if (model == "Kirchhoff" ? !series.kirchhoff : !series.reissner) continue;
        add(scene, series.key, model, false);
        if (series.method == "rk4") add(scene, series.key, model, true);
      }
    }
  }
  return table.csv({machine_line(),
                    "Cheapest resolution whose tip error over L is within the target; nan: none is. fam automatic: "
                    "asked for the target."});
}

std::string aims_csv(const WorkData& data) {
  Table table({"scene", "target_mm", "method", "resolution", "tip_error_mm"});
  for (const AimRow& row : data.aims) {
    table.add({row.scene, scientific(row.target_mm, 0), row.method, std::to_string(row.resolution),
               row.resolution > 0 ? scientific(row.error_mm, 1) : ""});
  }
  return table.csv(
      {"Fewest arcs or steps n such that n, n + 1 and 2 n are within the tip error, Kirchhoff rod; 0: none "
       "up to 1000."});
}

std::string timing_aims_csv(const WorkData& data) {
  Table table(with_timing_columns({"scene", "target_mm", "method", "resolution", "aim_us"}));
  for (const AimRow& row : data.aims) {
    if (row.resolution == 0) continue;
    table.add(with_timing({row.scene, scientific(row.target_mm, 0), row.method, std::to_string(row.resolution),
                           fmt::format("{}", row.aim_us)},
                          row.time, fixed, 3));
  }
  return table.csv({machine_line()});
}

std::string share_text(int holds, std::size_t all) {
  return static_cast<std::size_t>(holds) == all ? "" : fmt::format(" [{}/{}]", holds, all);
}

// "14.1 (10.2 … 17.9) [15/17]": median, quartiles, scenes that reach the target.
std::string spread_cell(const Spread& spread, int digits) {
  const std::string share = share_text(spread.reached, static_cast<std::size_t>(spread.scenes));
  if (spread.reached == 0) return "–";
  if (!std::isfinite(spread.median)) return "–" + share;
  return fmt::format("{} ({} … {}){}", significant(spread.median, digits), significant(spread.lower, digits),
                     significant(spread.upper, digits), share);
}

std::vector<std::string> head_of_targets(const std::string& first) {
  std::vector<std::string> head{first};
  for (const double target : work_targets) head.push_back(target_text(target));
  return head;
}

// The coarsest resolution within the target on as many scenes as any; "32 [15/16]" where these are not all.
std::string coarsest(const WorkData& data, WorkGroup group, const std::string& series, const std::string& model,
                     double target) {
  const std::vector<std::string> scenes = data.names(group);
  std::string best_label;
  int best = 0;
  for (const std::string& label : data.labels(series, model, scenes)) {
    const auto holds = [&](const std::string& scene) {
      const auto points = data.of(scene, series, model);
      return std::any_of(points.begin(), points.end(),
                         [&](const WorkPoint* p) { return p->label == label && p->converged() && p->error <= target; });
    };
    const int count = static_cast<int>(std::count_if(scenes.begin(), scenes.end(), holds));
    if (count > best) best = count, best_label = label;
  }
  return best == 0 ? "–" : best_label + share_text(best, scenes.size());
}

bool solves_any(const WorkData& data, WorkGroup group, const Contestant& contestant) {
  const std::string& series = contestant.series.back();
  return coarsest(data, group, series, contestant.model, work_targets.front()) != "–";
}

// A finer resolution at least twice as far away as a coarser one, above round-off.
bool worsens(const std::vector<const WorkPoint*>& points) {
  constexpr double resolved = 1e-9;
  double least = std::numeric_limits<double>::infinity();
  for (const WorkPoint* p : points) {
    if (p->converged() && p->error > resolved && p->error > 2 * least) return true;
    if (p->converged()) least = std::min(least, p->error);
  }
  return false;
}

// Scenes where the finest resolution of a series fails, by kind.
struct Failures {
  int scenes = 0, unsupported = 0;
  std::string not_converged, lost, worse;

  bool any() const { return unsupported > 0 || !(not_converged + lost + worse).empty(); }
};

Failures failures_of(const WorkData& data, const std::string& series, const std::string& model) {
  Failures failures;
  const auto add = [](std::string& list, const std::string& name) { list += (list.empty() ? "" : ", ") + name; };
  for (const WorkScene& scene : data.scenes) {
    const std::vector<const WorkPoint*> points = data.of(scene.name, series, model);
    if (points.empty()) continue;
    const WorkPoint& finest = *points.back();
    ++failures.scenes;
    if (worsens(points)) add(failures.worse, scene.name);
    if (finest.unsupported()) ++failures.unsupported;
    else if (!finest.converged()) add(failures.not_converged, scene.name);
    else if (finest.error > lost_error) add(failures.lost, scene.name);
  }
  return failures;
}

}  // namespace

std::string times_table(const WorkData& data, WorkGroup group) {
  Table table(head_of_targets("µs"));
  for (const Contestant& c : contestants()) {
    std::vector<std::string> cells{c.name()};
    for (const double target : work_targets) cells.push_back(spread_cell(times_to_us(data, group, c, target), 3));
    if (solves_any(data, group, c)) table.add(std::move(cells));
  }
  return table.markdown();
}

std::string ratios_table(const WorkData& data, WorkGroup group) {
  Table table(head_of_targets(title(group)));
  for (const char* method : {"fam_sixth_order", "rk4", "fe"}) {
    const Contestant& rival = contestant(method);
    std::vector<std::string> cells{rival.name()};
    for (const double target : work_targets) {
      cells.push_back(spread_cell(ratios_to_automatic(data, group, rival, target), 2));
    }
    table.add(std::move(cells));
  }
  return table.markdown();
}

std::string resolutions_table(const WorkData& data, WorkGroup group) {
  Table table(head_of_targets(title(group)));
  for (const Contestant& c : contestants()) {
    std::vector<std::string> cells{c.name()};
    for (const double target : work_targets) cells.push_back(coarsest(data, group, c.series.back(), c.model, target));
    if (solves_any(data, group, c)) table.add(std::move(cells));
  }
  return table.markdown();
}

std::string failures_table(const WorkData& data) {
  Table table({"method", "rod", "scenes", "refused", "no convergence", "another equilibrium", "finer yet worse"});
  for (const std::string& model : work_models) {
    for (const Series& series : all_series()) {
      const Failures f = failures_of(data, series.key, model);
      if (f.any())
        table.add({series.name(), model, std::to_string(f.scenes), std::to_string(f.unsupported), f.not_converged,
                   f.lost, f.worse});
    }
  }
  return table.markdown();
}

std::string aims_table(const WorkData& data) {
  Table table(
      {"scene", "tip within, mm", "aim, µs", "method", "arcs or steps", "tip error, mm", "time, µs", "over the first"});
  const AimRow* first = nullptr;
  for (const AimRow& row : data.aims) {
    if (first == nullptr || row.scene != first->scene || row.target_mm != first->target_mm) first = &row;
    const bool none = row.resolution == 0;
    const std::string spread = row.time.has_spread()
                                   ? fmt::format(" ({} … {})", significant(row.time.lower_quartile_us, 3),
                                                 significant(row.time.upper_quartile_us, 3))
                                   : "";
    table.add({row.scene, scientific(row.target_mm, 0), fmt::format("{}", row.aim_us), method_row(row.method).name,
               none ? "–" : std::to_string(row.resolution), none ? "–" : scientific(row.error_mm, 1),
               none ? "–" : significant(row.time.median_us, 3) + spread,
               none || first->resolution == 0 ? "–" : significant(row.time.median_us / first->time.median_us, 2)});
  }
  return table.markdown();
}

std::map<std::string, std::string> work_precision_tables(const WorkData& data) {
  return {{"accuracy.csv", accuracy_csv(data)},
          {races_file, races_csv(data.races)},
          {"timing_random.csv", races_timing_csv(data.races)},
          {"aims.csv", aims_csv(data)},
          {"timing.csv", timing_csv(data)},
          {"timing_aims.csv", timing_aims_csv(data)},
          {"timing_instructions.csv", instructions_csv(data)},
          {"timing_to_accuracy.csv", time_to_csv(data)}};
}

}  // namespace studies
