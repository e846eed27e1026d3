// A path as a picture: the parameter against the tip's displacement, and three of its shapes.
#pragma once

#include "scene/path.h"

#include <functional>
#include <string>
#include <vector>

namespace studies {

// Of a point: places on the rod, clamp to tip, mm, base frame.
using CentrelineOf = std::function<std::vector<Eigen::Vector3d>(std::size_t point)>;

// Points of the same path by another method.
struct PathMarks {
  std::string name, colour;
  double radius;
  std::vector<scene::PathPoint> points;
};

std::string path_chart(const scene::Path& path, const CentrelineOf& centreline_mm, const std::string& title,
                       const std::string& parameter, const std::vector<PathMarks>& others = {});

}  // namespace studies
