#include "studies/report/table.h"

#include "studies/paths/data.h"
#include "studies/paths/tables.h"
#include "studies/report/chart.h"
#include "studies/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

// Below it round-off and the machine decide.
constexpr double difference_floor = 1e-10;

std::string difference_text(double difference) {
  return difference < difference_floor ? "< 1e-10" : scientific(difference, 0);
}

std::string difference_of(const KnownNumber& known, const scene::Path& path) {
  const std::optional<double> value = known.of_path(path);
  return value ? difference_text(std::abs(*value / known.value - 1)) : "–";
}

std::string shown(const std::optional<double>& value) {
  return value ? fixed(*value, 6) : "–";
}

}  // namespace

double time_per_point_us(const PathOutcome& outcome, PathMethods method) {
  const FollowedPath& followed = outcome.followed[method];
  const std::size_t points = method == path_as_called ? outcome.timed_points : followed.path.points.size();
  return followed.timing.median_us / static_cast<double>(points);
}

std::string known_table(const PathsData& data) {
  Table table({"scene", "number", "known", "source", "FAM as called", "FAM, fine", "FE", "exact"});
  for (const PathOutcome& o : data.outcomes) {
    for (const KnownNumber& known : o.of.known) {
      std::vector<std::string> cells{o.of.name, known.what, significant(known.value, 10), known.source};
      for (const PathMethods method : {path_as_called, path_fine, path_fem, path_exact})
        cells.push_back(difference_of(known, o.followed[method].path));
      table.add(cells);
    }
  }
  return table.markdown();
}

std::string agreement_table(const PathsData& data) {
  Table table({"scene", "FAM as called: tip, L", "critical", "FAM, fine: tip, L", "critical", "FE: tip, L", "critical",
               "places", "not on both", "same index"});
  for (const PathOutcome& o : data.outcomes) {
    std::vector<std::string> cells{o.of.name};
    int places = 0, missing = 0, indexed = 0, same = 0;
    for (const PathMethods method : {path_as_called, path_fine, path_fem}) {
      const PathAgreement& a = o.agreements[method];
      cells.push_back(difference_text(a.farthest_tip));
      cells.push_back(difference_text(a.farthest_critical));
      places += a.places, missing += a.missing, indexed += a.indexed, same += a.same_index;
    }
    cells.push_back(std::to_string(places));
    cells.push_back(std::to_string(missing));
    cells.push_back(fmt::format("{} of {}", same, indexed));
    table.add(cells);
  }
  return table.markdown();
}

std::string direct_table(const PathsData& data) {
  std::vector<std::string> head{"scene", "asked at"};
  for (const DirectAnswer& answer : data.outcomes.front().direct) head.push_back(answer.method);
  Table table(head);
  for (const PathOutcome& o : data.outcomes) {
    std::vector<std::string> cells{o.of.name, fmt::format("{} {:g}", o.parameter, o.of.asked_at)};
    for (const DirectAnswer& answer : o.direct) {
      const bool converged = answer.status == "converged";
      cells.push_back(converged ? answer.where : answer.status + (answer.where.empty() ? "" : ", " + answer.where));
    }
    table.add(cells);
  }
  return table.markdown();
}

std::string times_table(const PathsData& data) {
  Table table({"scene", "points", "FAM as called, µs a point", "FAM, ms for 200 points", "exact, µs a point",
               "FE, µs a point"});
  for (const PathOutcome& o : data.outcomes) {
    const double fam_us = time_per_point_us(o, path_as_called);
    table.add({o.of.name, std::to_string(o.timed_points), significant(fam_us, 3), significant(0.2 * fam_us, 3),
               significant(time_per_point_us(o, path_exact), 3), significant(time_per_point_us(o, path_fem), 3)});
  }
  return table.markdown();
}

std::string critical_csv(const PathsData& data) {
  Table table({"scene", "method", "branch", "kind", "multiplicity", "parameter", "x_mm", "y_mm", "z_mm", "index"});
  for (const PathOutcome& o : data.outcomes) {
    for (const PathMethods method : {path_fine, path_exact, path_fem}) {
      for (const scene::PathPoint& p : o.followed[method].path.points) {
        if (p.kind == scene::PathPoint::Kind::regular) continue;
        std::vector<std::string> cells{o.of.key,
                                       path_methods[method].key,
                                       std::to_string(p.branch),
                                       name(p.kind),
                                       p.multiplicity > 0 ? std::to_string(p.multiplicity) : "",
                                       fixed(p.parameter, 7)};
        for (const double x : p.tip_position_B_mm) cells.push_back(fixed(x, 3));
        cells.push_back(p.index ? std::to_string(*p.index) : "");
        table.add(cells);
      }
    }
  }
  return table.csv({"Starts, folds, branch points and ends of each branch."});
}

std::string stops_csv(const PathsData& data) {
  Table table({"scene", "branch", "parameter", "x_mm", "y_mm", "z_mm", "index"});
  for (const PathOutcome& o : data.outcomes) {
    for (const scene::PathPoint& p : o.followed[path_exact].path.points) {
      if (std::find(o.stops.begin(), o.stops.end(), p.parameter) == o.stops.end()) continue;
      std::vector<std::string> cells{o.of.key, std::to_string(p.branch), significant(p.parameter, 8)};
      for (const double x : p.tip_position_B_mm) cells.push_back(fixed(x, 4));
      cells.push_back(p.index ? std::to_string(*p.index) : "");
      table.add(cells);
    }
  }
  return table.csv({"The exact reference's points at which all are compared, in the order of the path."});
}

std::string paths_times_csv(const PathsData& data) {
  Table table({"scene", "method", "points", "median_us", "lower_quartile_us", "upper_quartile_us", "repeats"});
  for (const PathOutcome& o : data.outcomes) {
    for (const PathMethods method : {path_as_called, path_exact, path_fem}) {
      const FollowedPath& f = o.followed[method];
      const std::size_t points = method == path_as_called ? o.timed_points : f.path.points.size();
      table.add({o.of.key, path_methods[method].key, std::to_string(points), significant(f.timing.median_us, 4),
                 significant(f.timing.lower_quartile_us, 4), significant(f.timing.upper_quartile_us, 4),
                 std::to_string(f.timing.repeats)});
    }
  }
  return table.csv({"Times of all of a path; those of the exact reference and of finite elements with 24 stops more."});
}

std::string curl_csv(const PathsData& data) {
  Table table({"weight", "leaves_plane", "leaves_plane_exact", "returns"});
  for (const CurlPoint& p : data.curl)
    table.add({significant(p.weight, 3), shown(p.leaves), shown(p.leaves_exact), shown(p.returns)});
  return table.csv({"w L^3/EI, and rest curvature times L where the hanging curl leaves its plane and is back in it."});
}

std::string curl_picture(const PathsData& data) {
  Svg svg(640, 500, "Heavy curl: planar hook or helix", "Rest curvature against weight: where the plane is left.",
          "a rod that hangs from its clamp, GJ/EI = 1/1.3; dots: exact");
  std::vector<Point> leaves, returns, exact;
  for (const CurlPoint& p : data.curl) {
    if (p.leaves) leaves.push_back({*p.leaves, p.weight});
    if (p.returns) returns.push_back({*p.returns, p.weight});
    if (p.leaves_exact) exact.push_back({*p.leaves_exact, p.weight});
  }
  Panel panel(svg, {80, 66}, 500, 370, {"rest curvature times L", 0, 15, false},
              {"w L³/EI", data.curl.front().weight / 1.2, data.curl.back().weight * 1.2, true});
  panel.frame();
  panel.curve(leaves, {colour::blue, 1.8, ""});
  panel.curve(returns, {colour::orange, 1.8, ""});
  panel.dots(exact, colour::black, 3);
  if (!leaves.empty()) panel.name(leaves[leaves.size() / 2], "leaves the plane", colour::blue);
  if (!returns.empty()) panel.name(returns[returns.size() / 2], "back in a plane", colour::orange);
  panel.place_names();
  return svg.str();
}

}  // namespace studies
