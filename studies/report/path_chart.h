// An equilibrium path as a picture: the parameter against the tip's displacement, and shapes on the way.
#pragma once

#include "scene/path.h"
#include "studies/report/shape_chart.h"

namespace studies {

// Another method's points, as dots.
struct PathDots {
  std::string name, colour;
  std::vector<scene::PathPoint> points;
};

// Stable parts full, unstable ones dashed, those of loads without an energy grey; folds and branch points are named.
// shapes: of points of the path, in the plane in which they reach farthest.
std::string path_chart(const scene::PathRequest& request, const scene::Path& path,
                       const std::vector<Centreline>& shapes, const std::vector<PathDots>& others = {});

// The parameter as axes and texts call it, with its unit.
std::string parameter_label(const scene::PathRequest& request);

}  // namespace studies
