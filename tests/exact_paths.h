// Paths in tests of exact_reference.
#pragma once

#include "exact_reference/path.h"

#include <gtest/gtest.h>

#include <vector>

namespace exact_test {

inline scene::PathRequest load_growth(const scene::Scene& rod, double to) {
  scene::PathRequest request;
  request.scene = rod;
  request.to = to;
  return request;
}

inline scene::Path complete_path(const scene::PathRequest& request) {
  scene::Path path = exact_reference::follow(request);
  EXPECT_TRUE(scene::is_complete(path.status)) << name(path.status) << ": " << path.message;
  return path;
}

// Of the first branch.
inline std::vector<scene::PathPoint> points_of_kind(const scene::Path& path, scene::PathPoint::Kind kind) {
  std::vector<scene::PathPoint> found;
  for (const scene::PathPoint& point : path.points) {
    if (point.branch == 0 && point.kind == kind) found.push_back(point);
  }
  return found;
}

// Of a branch's points in their order, repetitions left out; -1: not decided. Folds and branch points are left out.
inline std::vector<int> indices(const scene::Path& path, int branch) {
  std::vector<int> found;
  for (const scene::PathPoint& point : path.points) {
    if (point.branch != branch || point.multiplicity > 0) continue;
    const int index = point.index.value_or(-1);
    if (found.empty() || found.back() != index) found.push_back(index);
  }
  return found;
}

}  // namespace exact_test
