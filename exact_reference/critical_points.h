// Folds and branch points on a stretch of a path.
#pragma once

#include "exact_reference/continuation.h"
#include "scene/path.h"

#include <vector>

namespace exact_reference {

struct CriticalPoint {
  scene::PathPoint::Kind kind = scene::PathPoint::Kind::fold;
  int multiplicity = 1;
  double s = 0;  // from the continuation's base
  Eigen::VectorXd x, tangent;
  Eigen::MatrixXd null_vectors;  // of a branch point, besides the path's tangent; `multiplicity` columns
  std::optional<int> index;      // the smaller one of those beside it
};

// Between the continuation's base and the solution at a distance s from it, in their order. A fold: the slope of the
// parameter changes its sign; a branch point: the determinant does; a double one: the index changes by two, or, of a
// straight rod under loads without an energy, the determinant of motions in the x-y plane changes its sign alone.
// Their places: the zero of the polynomial through six values of a smooth function with that zero, nearby; measured
// accuracy: path.h. Empty: the stretch is too long to tell them apart, or Newton's iteration fails on it.
std::optional<std::vector<CriticalPoint>> critical_points(Continuation& path, const Solution& end, double s);

}  // namespace exact_reference
