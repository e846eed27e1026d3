// Many rods of one kind at once.
#pragma once

#include "fam/options.h"

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace fam {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Which number of the scene a column of values replaces: a component of a load's value; of a tendon, 0: its tension.
struct BatchColumn {
  std::size_t load;
  int component;
};

// A row for each rod. Of one that did not converge the numbers are NaN.
struct BatchResult {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> position_mm;  // of the tip, base frame
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>
      rotation_wxyz;  // unit quaternion of R_BS at the tip, w >= 0
  std::vector<scene::Status> status;
  Eigen::VectorXd error_estimate_mm;  // 0 where Options::estimate_error is false
};

// Row k of values replaces the numbers of the loads named in columns. Each row is a cold solve: what a Solver gives
// with these values and Start::unloaded, and where that is no answer fam::solve, whatever the order of the rows and
// Options::threads, to the bit; on another vector unit within 1e-11 L (fam/lanes.h). Newton's method goes to round-off
// here. A row whose error estimate exceeds the tolerance (Options::arcs = 0) has tolerance_not_met. Throws
// scene::SceneError on wrong input: a column that is not there or twice, another number of columns than values has,
// NaN, a negative tension.
BatchResult solve_batch(const scene::Scene& scene, std::span<const BatchColumn> columns,
                        Eigen::Ref<const RowMajorMatrix> values, const Options& options = {});

}  // namespace fam
