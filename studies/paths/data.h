// What the study of equilibrium paths asked for and measured, and its files as pure functions of it.
#pragma once

#include "scene/path.h"
#include "studies/compare/stopwatch.h"
#include "studies/report/path_chart.h"

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace studies {

// A number that is known otherwise: in closed form, by symmetry, published.
struct KnownNumber {
  std::string what, source;
  double value;
  std::function<std::optional<double>(const scene::Path&)> of_path;
  double worth = 0;  // relative: what the number neglects
};

// A file of studies/cases/paths, followed by all.
struct PathCase {
  std::string key, name;  // in files; on the page
  std::string lesson;     // what the diagram shows, a line of the page
  double asked_at;        // a value of the parameter between snaps: what do solvers without a path find there?
  std::vector<KnownNumber> known;
};
const std::vector<PathCase>& path_cases();

// Who follows. As called: fam path FILE, 1e-3 L. Fine: a millionth of that.
struct PathMethod {
  std::string key, name;
};
enum PathMethods { path_as_called, path_fine, path_exact, path_fem };
constexpr std::size_t path_method_count = 4;
extern const std::array<PathMethod, path_method_count> path_methods;

struct FollowedPath {
  scene::Path path;
  Timing timing;  // of all of it
};

// A path beside the exact one, place by place: at each stop on each branch, and at each fold and branch point.
struct PathAgreement {
  int places = 0, missing = 0;  // compared; that one of the two has alone
  int indexed = 0, same_index = 0;
  double farthest_tip = 0;       // over L
  double farthest_critical = 0;  // relative
};
PathAgreement agreement(const scene::Path& path, const scene::Path& exact, const std::vector<double>& stops,
                        double length_mm);

// What a solver without path following says at one value of the parameter.
struct DirectAnswer {
  std::string method, status;
  std::string where;  // which equilibrium of the diagram: "1st of 3, stable"; empty where not converged
};

struct PathOutcome {
  PathCase of;
  std::string parameter;  // its name with its unit
  double length_mm = 0;
  std::vector<double> stops;
  std::array<FollowedPath, path_method_count> followed;
  std::array<PathAgreement, path_method_count> agreements;  // with the exact one
  std::size_t timed_points = 0;                             // of FAM as called, without the stops
  std::vector<DirectAnswer> direct;
  std::string picture;
};

// The heavy curl: where it leaves its plane, and where it comes back into it, rest curvature times length, for one
// weight, w L^3/EI.
struct CurlPoint {
  double weight = 0;
  std::optional<double> leaves, leaves_exact, returns;
};

struct PathsData {
  std::vector<PathOutcome> outcomes;
  std::vector<CurlPoint> curl;
};

std::vector<CurlPoint> curl_boundary(const std::filesystem::path& cases);
std::map<std::string, std::string> path_files(const PathsData& data, const std::filesystem::path& page_md);

}  // namespace studies
