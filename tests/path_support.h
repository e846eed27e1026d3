// Paths that several tests follow.
#pragma once

#include "support.h"

#include "fam/path.h"

#include <vector>

namespace path_support {

using scene::Force;
using scene::Frame;
using scene::PathPoint;
using scene::PathRequest;
using support::slender;
using support::uniform_rod;
using Kind = PathPoint::Kind;

inline PathRequest load_path(const scene::Scene& scene, double from, double to) {
  PathRequest request;
  request.scene = scene;
  request.from = from;
  request.to = to;
  return request;
}

inline fam::Path followed(const PathRequest& request, int arcs = 0) {
  fam::Options options;
  options.arcs = arcs;
  return fam::Path::follow(request, options);
}

inline std::vector<PathPoint> of_kind(const scene::Path& path, Kind kind) {
  std::vector<PathPoint> found;
  for (const PathPoint& point : path.points) {
    if (point.kind == kind) found.push_back(point);
  }
  return found;
}

inline scene::Scene column() {
  return uniform_rod(1, slender(1, 0.7), {Force{1, Frame::fixed, {-1, 0, 0}}});
}

inline scene::Scene tapered() {
  scene::Scene rod = uniform_rod(10, slender(900, 600), {});
  rod.sections.assign(8, rod.sections[0]);
  double factor = 1;
  for (scene::Section& section : rod.sections) {
    section.cross_section = slender(900 * factor, 600 * factor);
    factor *= 0.8;
  }
  rod.loads = {Force{80, Frame::fixed, {0.1, 0.2, -0.1}}, Force{35, Frame::fixed, {0, -0.3, 0.2}}};
  return rod;
}

}  // namespace path_support
