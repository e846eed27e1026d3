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

// In their order; `compare` tells whether two are the same place.
template <class Compare>
void compare_each(const std::vector<PathPoint>& here, const std::vector<PathPoint>& exact, PathAgreement& result,
                  const Compare& compare) {
  const std::size_t both = std::min(here.size(), exact.size());
  result.missing += static_cast<int>(std::max(here.size(), exact.size()) - both);
  for (std::size_t i = 0; i < both; ++i) ++(compare(here[i], exact[i]) ? result.places : result.missing);
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
  const auto same_stop = [&](const PathPoint& here, const PathPoint& there) {
    if (here.parameter != there.parameter) return false;
    const double apart_mm = (here.tip_position_B_mm - there.tip_position_B_mm).norm();
    result.farthest_tip = std::max(result.farthest_tip, apart_mm / length_mm);
    result.indexed += here.index && there.index;
    result.same_index += here.index && here.index == there.index;
    return true;
  };
  const auto same_critical = [&](const PathPoint& here, const PathPoint& there) {
    if (here.kind != there.kind) return false;
    result.farthest_critical = std::max(result.farthest_critical, std::abs(here.parameter / there.parameter - 1));
    return true;
  };
  for (int branch = 0; branch < branches; ++branch) {
    compare_each(chosen(path, branch, is_stop), chosen(exact, branch, is_stop), result, same_stop);
    compare_each(chosen(path, branch, is_critical), chosen(exact, branch, is_critical), result, same_critical);
  }
  return result;
}

}  // namespace studies
