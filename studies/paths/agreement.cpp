#include "studies/paths/data.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

using scene::PathPoint;
using Kind = PathPoint::Kind;

bool is_critical(const PathPoint& point) {
  return point.kind == Kind::fold || point.kind == Kind::branch;
}

// Of one branch in their order.
std::vector<PathPoint> chosen(const scene::Path& path, int branch, const std::function<bool(const PathPoint&)>& is) {
  std::vector<PathPoint> found;
  for (const PathPoint& point : path.points) {
    if (point.branch == branch && is(point)) found.push_back(point);
  }
  return found;
}

void compare_stops(const std::vector<PathPoint>& here, const std::vector<PathPoint>& exact, double length_mm,
                   PathAgreement& result) {
  const std::size_t both = std::min(here.size(), exact.size());
  result.missing += static_cast<int>(std::max(here.size(), exact.size()) - both);
  for (std::size_t i = 0; i < both; ++i) {
    if (here[i].parameter != exact[i].parameter) {
      ++result.missing;
      continue;
    }
    ++result.places;
    result.farthest_tip =
        std::max(result.farthest_tip, (here[i].tip_position_B_mm - exact[i].tip_position_B_mm).norm() / length_mm);
    if (!here[i].index || !exact[i].index) continue;
    ++result.indexed;
    result.same_index += *here[i].index == *exact[i].index;
  }
}

void compare_critical(const std::vector<PathPoint>& here, const std::vector<PathPoint>& exact, PathAgreement& result) {
  const std::size_t both = std::min(here.size(), exact.size());
  result.missing += static_cast<int>(std::max(here.size(), exact.size()) - both);
  for (std::size_t i = 0; i < both; ++i) {
    if (here[i].kind != exact[i].kind) {
      ++result.missing;
      continue;
    }
    ++result.places;
    result.farthest_critical = std::max(result.farthest_critical, std::abs(here[i].parameter / exact[i].parameter - 1));
  }
}

}  // namespace

PathAgreement agreement(const scene::Path& path, const scene::Path& exact, const std::vector<double>& stops,
                        double length_mm) {
  PathAgreement result;
  int branches = 0;
  for (const scene::Path* p : {&path, &exact}) {
    for (const PathPoint& point : p->points) branches = std::max(branches, point.branch + 1);
  }
  const auto is_stop = [&](const PathPoint& point) {
    return point.kind == Kind::regular && std::find(stops.begin(), stops.end(), point.parameter) != stops.end();
  };
  for (int branch = 0; branch < branches; ++branch) {
    compare_stops(chosen(path, branch, is_stop), chosen(exact, branch, is_stop), length_mm, result);
    compare_critical(chosen(path, branch, is_critical), chosen(exact, branch, is_critical), result);
  }
  return result;
}

}  // namespace studies
