// What the page calls of FAM, compiled to WebAssembly: JSON in, JSON out. Wrong input gives {"error": one line}.
#include "fam/path.h"
#include "fam/solve.h"
#include "scene/equilibrium_file.h"
#include "scene/path_file.h"
#include "scene/scene_file.h"

#include <emscripten.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace {

using Json = nlohmann::ordered_json;

constexpr double timed_for_ms = 30;  // browsers tell time to 0.1 ms; chosen, not measured
// Where the path of the growing load is looked at for a fold or a branch point, times the load; chosen.
constexpr double path_ends[] = {1, 2, 4};

scene::Scene scene_of(const char* text) {
  std::istringstream input(text);
  return scene::read_scene(input, "scene");
}

fam::Options options_of(const char* text) {
  const Json json = Json::parse(text);
  fam::Options options;
  const std::string law = json.value("law", "auto");
  for (const fam::Law known : fam::all_laws()) {
    if (law == fam::name(known)) options.law = known;
  }
  options.arcs = std::clamp(json.value("arcs", 0), 0, fam::max_arcs);
  options.tolerance_mm = std::max(0.0, json.value("tolerance_mm", 0.0));
  options.after_snap = json.value("after_snap", false);
  return options;
}

// The text stays until the next call.
template <class Work>
const char* answer(Work&& work) {
  static std::string text;
  try {
    text = work();
  } catch (const std::exception& error) {
    text = Json{{"error", error.what()}}.dump();
  }
  return text.c_str();
}

// The first point where the rod snaps or buckles while its load grows from zero; null and how far was looked.
Json limit_of(const scene::Scene& scene) {
  scene::PathRequest request;
  request.scene = scene;
  request.to = path_ends[0];
  fam::Path path = fam::Path::follow(request);
  for (std::size_t part = 0;; ++part) {
    for (const scene::PathPoint& point : path.points().points) {
      const bool critical = point.kind == scene::PathPoint::Kind::fold || point.kind == scene::PathPoint::Kind::branch;
      if (critical) return {{"kind", scene::name(point.kind)}, {"load_factor", point.parameter}};
    }
    const scene::PathStatus status = path.points().status;
    const bool goes_on = status == scene::PathStatus::reached && part + 1 < std::size(path_ends);
    if (!goes_on) {
      const double looked = path.points().points.empty() ? 0 : path.points().points.back().parameter;
      return {{"kind", nullptr}, {"looked_up_to", looked}, {"status", scene::name(status)}};
    }
    request.from = request.to;
    request.to = path_ends[part + 1];
    path = fam::Path::follow_on(request, path, path.points().points.size() - 1);
  }
}

}  // namespace

extern "C" {

// As `fam solve --format json`; time_us is 0. Options: {"law", "arcs", "tolerance_mm", "after_snap"}.
EMSCRIPTEN_KEEPALIVE const char* explore_solve(const char* scene, const char* options) {
  return answer([&] { return scene::to_json(fam::solve(scene_of(scene), options_of(options)), "fam", 0); });
}

// Mean time of a solve, µs; below zero: wrong input.
EMSCRIPTEN_KEEPALIVE double explore_time_us(const char* scene, const char* options) {
  try {
    const scene::Scene solved = scene_of(scene);
    const fam::Options how = options_of(options);
    fam::solve(solved, how);
    const double start_ms = emscripten_get_now();
    int solves = 0;
    double passed_ms = 0;
    for (; passed_ms < timed_for_ms; ++solves, passed_ms = emscripten_get_now() - start_ms) fam::solve(solved, how);
    return 1e3 * passed_ms / solves;
  } catch (const std::exception&) {
    return -1;
  }
}

// {"kind": "fold" or "branch", "load_factor"}, or {"kind": null, "looked_up_to", "status"}.
EMSCRIPTEN_KEEPALIVE const char* explore_limit(const char* scene) {
  return answer([&] { return limit_of(scene_of(scene)).dump(); });
}
}
