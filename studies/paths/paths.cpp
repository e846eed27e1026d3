// fam-studies paths: the equilibrium paths of studies/cases/paths by FAM, the exact reference and finite elements,
// beside numbers known otherwise; and what solvers without a path say between the snaps.
#include "exact_reference/path.h"
#include "fam/path.h"
#include "fem_reference/path.h"
#include "scene/path_file.h"
#include "studies/methods/registry.h"
#include "studies/paths/data.h"
#include "studies/report/provenance.h"
#include "studies/study.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

using scene::PathPoint;

constexpr int stop_count = 24;             // shared out over the range
constexpr double fine_tolerance = 1e-9;    // of FAM, over L
constexpr int fem_elements = 100;          // quadratic
constexpr double same_equilibrium = 1e-2;  // of L: an answer and a point of the diagram
constexpr int shooting_steps = 400;        // Runge-Kutta of the fourth order

class CaseRun {
 public:
  CaseRun(const StudyOptions& options, const PathCase& of)
      : options_(options), request_(scene::read_path_file((options.cases / "paths" / (of.key + ".json")).string())) {
    outcome_.of = of;
    outcome_.parameter = scene::name_of_parameter(request_);
    outcome_.length_mm = scene::length_mm(request_.scene);
    plain_request_ = request_;
    // Off the ends, and off round numbers, at which symmetry may put a fold.
    for (int i = 1; i < stop_count; ++i)
      request_.stop_at.push_back(std::lerp(request_.from, request_.to, (i + 0.137) / stop_count));
    request_.stop_at.push_back(of.asked_at);
    outcome_.stops = request_.stop_at;
  }

  PathOutcome run() {
    follow_by_fam(path_as_called, 1e-3);
    follow_by_fam(path_fine, fine_tolerance);
    follow(path_exact, [&] { return exact_reference::follow(request_); });
    follow(path_fem, [&] {
      fem_reference::Options fem;
      fem.elements = fem_elements;
      return fem_reference::follow(request_, fem);
    });
    for (std::size_t m = 0; m < path_method_count; ++m) {
      outcome_.agreements[m] = agreement(outcome_.followed[m].path, exact().path, outcome_.stops, outcome_.length_mm);
    }
    ask_directly();
    draw();
    return outcome_;
  }

 private:
  const FollowedPath& exact() const { return outcome_.followed[path_exact]; }
  fam::Options fam_options(double tolerance) const {
    fam::Options options;
    options.tolerance_mm = tolerance * outcome_.length_mm;
    return options;
  }

  template <class Work>
  void follow(PathMethods method, const Work& work) {
    FollowedPath& followed = outcome_.followed[method];
    followed.timing = measure([&] { followed.path = work(); }, 0, 1);
  }

  // Timed without the stops, which are the comparison's.
  void follow_by_fam(PathMethods method, double tolerance) {
    FollowedPath& followed = outcome_.followed[method];
    followed.path = fam::Path::follow(request_, fam_options(tolerance)).points();
    if (method != path_as_called) return;
    std::size_t points = 0;
    followed.timing = time_of(
        options_, [&] { points = fam::Path::follow(plain_request_, fam_options(tolerance)).points().points.size(); });
    outcome_.timed_points = points;
  }

  // "1st of 3, stable".
  std::string place_on_diagram(const scene::Equilibrium& answer) const {
    int met = 0, found = 0;
    std::string stable;
    for (const PathPoint& point : exact().path.points) {
      if (point.parameter != outcome_.of.asked_at) continue;
      ++met;
      const double apart_mm = (point.tip_position_B_mm - answer.tip().position_B_mm).norm();
      if (found > 0 || apart_mm > same_equilibrium * outcome_.length_mm) continue;
      found = met;
      stable = !point.stable ? "" : *point.stable ? ", stable" : ", unstable";
    }
    if (found == 0) return "none of the diagram's " + std::to_string(met);
    return fmt::format("number {} of {}{}", found, met, stable);
  }

  void ask_directly() {
    const scene::Scene scene = scene::scene_at(plain_request_, outcome_.of.asked_at);
    for (const char* key : {"rk4", "fe", "fam"}) {
      Request request;
      if (std::string(key) == "rk4") request.count = shooting_steps;
      const MethodRow& row = method_row(key);
      const scene::Equilibrium answer = row(request)->solve(scene);
      DirectAnswer direct{row.name, scene::name(answer.status), ""};
      if (answer.converged()) {
        direct.where = place_on_diagram(answer);
        if (answer.stable && !*answer.stable) direct.where += " (it says so)";
      } else if (answer.limit) {
        direct.where = fmt::format("at {:.1f} % of the load", 100 * answer.limit->load_factor);
      }
      outcome_.direct.push_back(direct);
    }
  }

  void draw() {
    const fam::Path path = fam::Path::follow(plain_request_, fam_options(1e-4));
    const auto marks = [&](PathMethods method) {
      std::vector<PathPoint> points;
      for (const PathPoint& point : outcome_.followed[method].path.points) {
        if (std::find(outcome_.stops.begin(), outcome_.stops.end(), point.parameter) != outcome_.stops.end())
          points.push_back(point);
      }
      return points;
    };
    outcome_.picture = path_chart(path.points(), [&](std::size_t point) { return path.centreline_mm(point); },
                                  outcome_.of.name, outcome_.parameter,
                                  {{"large dots: FE", colour::yellow, 4.5, marks(path_fem)},
                                   {"small dots: exact", colour::black, 2.2, marks(path_exact)}});
  }

  const StudyOptions& options_;
  scene::PathRequest request_, plain_request_;
  PathOutcome outcome_;
};

}  // namespace

void paths(const StudyOptions& options) {
  Progress progress("paths", path_cases().size() + 1, options.progress);
  PathsData data;
  for (const PathCase& of : path_cases()) {
    progress.step(of.key);
    data.outcomes.push_back(CaseRun(options, of).run());
  }
  progress.step("heavy curl");
  data.curl = curl_boundary(options.cases);
  write_results(options.output / "paths", "fam-studies paths", path_files(data, options.pages / "paths" / "page.md"));
}

}  // namespace studies
