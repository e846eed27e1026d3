#include "studies/report/page.h"

#include "studies/paths/tables.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

struct Totals {
  int places = 0, missing = 0, indexed = 0, same_index = 0;
  double farthest_critical = 0, farthest_tip = 0;
};

Totals totals_of(const PathsData& data, PathMethods method) {
  Totals totals;
  for (const PathOutcome& o : data.outcomes) {
    const PathAgreement& a = o.agreements[method];
    totals.places += a.places, totals.missing += a.missing;
    totals.indexed += a.indexed, totals.same_index += a.same_index;
    totals.farthest_critical = std::max(totals.farthest_critical, a.farthest_critical);
    totals.farthest_tip = std::max(totals.farthest_tip, a.farthest_tip);
  }
  return totals;
}

double farthest_from_known(const PathsData& data, PathMethods method) {
  double farthest = 0;
  for (const PathOutcome& o : data.outcomes) {
    for (const KnownNumber& known : o.of.known) {
      if (known.worth > 0) continue;
      const std::optional<double> value = known.of_path(o.followed[method].path);
      farthest = std::max(farthest, value ? std::abs(*value / known.value - 1) : 1.0);
    }
  }
  return farthest;
}

int known_numbers(const PathsData& data) {
  int count = 0;
  for (const PathOutcome& o : data.outcomes)
    count += static_cast<int>(
        std::count_if(o.of.known.begin(), o.of.known.end(), [](const KnownNumber& k) { return k.worth == 0; }));
  return count;
}

bool all_complete(const PathsData& data) {
  return std::all_of(data.outcomes.begin(), data.outcomes.end(), [](const PathOutcome& o) {
    return std::all_of(o.followed.begin(), o.followed.end(),
                       [](const FollowedPath& f) { return scene::is_complete(f.path.status); });
  });
}

double slowest_ms_for_200(const PathsData& data) {
  double slowest = 0;
  for (const PathOutcome& o : data.outcomes) slowest = std::max(slowest, 0.2 * time_per_point_us(o, path_as_called));
  return slowest;
}

std::string diagrams(const PathsData& data) {
  std::string text;
  for (const PathOutcome& o : data.outcomes)
    text += fmt::format("### {}\n\n{}\n\n![{}]({}.svg)\n\n", o.of.name, o.of.lesson, o.of.name, o.of.key);
  return text;
}

void set_totals(Page& page, const PathsData& data) {
  const Totals fine = totals_of(data, path_fine), fem = totals_of(data, path_fem),
               called = totals_of(data, path_as_called);
  page.set("scenes", std::to_string(data.outcomes.size()));
  page.set("places", std::to_string(fine.places));
  page.set("missing", std::to_string(called.missing + fine.missing + fem.missing));
  page.set("critical_fine", scientific(fine.farthest_critical, 0));
  page.set("critical_called", scientific(called.farthest_critical, 0));
  page.set("critical_fem", scientific(fem.farthest_critical, 0));
  page.set("tip_called", scientific(called.farthest_tip, 0));
  page.set("indexed", std::to_string(fem.indexed + fine.indexed + called.indexed));
  page.set("same_index", std::to_string(fem.same_index + fine.same_index + called.same_index));
  page.set("known", std::to_string(known_numbers(data)));
  page.set("known_fine", scientific(farthest_from_known(data, path_fine), 0));
}

}  // namespace

std::map<std::string, std::string> path_files(const PathsData& data, const std::filesystem::path& page_md) {
  Page page;
  set_totals(page, data);
  page.check("complete", all_complete(data));
  page.set_time("slowest", significant(slowest_ms_for_200(data), 2));
  page.set("diagrams", diagrams(data));
  page.set("known_table", known_table(data));
  page.set("agreement_table", agreement_table(data));
  page.set("direct_table", direct_table(data));
  page.set_time("times", times_table(data));
  page.set_time("machine", machine_line());
  std::map<std::string, std::string> files{{"critical.csv", critical_csv(data)},   {"stops.csv", stops_csv(data)},
                                           {"timing.csv", paths_times_csv(data)},  {"heavy_curl.csv", curl_csv(data)},
                                           {"heavy_curl.svg", curl_picture(data)}, {"README.md", page.fill(page_md)}};
  for (const PathOutcome& o : data.outcomes) files[o.of.key + ".svg"] = o.picture;
  const std::string answer = fmt::format(
      "on {} diagrams its folds and branch points are the exact reference's to {} (relative), {} numbers "
      "known otherwise to {}; 200 points of the slowest diagram in {} ms",
      data.outcomes.size(), scientific(totals_of(data, path_fine).farthest_critical, 0), known_numbers(data),
      scientific(farthest_from_known(data, path_fine), 0), timed(significant(slowest_ms_for_200(data), 2)));
  files[answers_file] = answers_json({{"paths", answer}});
  return files;
}

}  // namespace studies
