// The rods of the batch study: their scenes, rows of random values, and the ways that solve them.
#pragma once

#include "fam/batch_rows.h"
#include "studies/batch/data.h"

namespace studies {

std::span<const BatchCase> batch_cases();

using BatchValues = Eigen::Ref<const fam::RowMajorMatrix>;

// Each number of a row is its own random share, 0 to 1, of that in the scene, scaled.
fam::RowMajorMatrix random_rows(scene::Scene scene, const BatchCase& rods, Eigen::Index rows);

// A scene with the values of a row.
void set_row(scene::Scene& scene, const BatchCase& rods, const BatchValues& values, Eigen::Index row);

// arcs 0: chosen for the aim.
fam::Options batch_options(const BatchCase& rods, int arcs, bool estimate);

// By one vector unit, as fam::solve_batch does with the best.
struct UnitOutcome {
  fam::BatchResult result;
  Eigen::Index in_lanes;  // rows
};
UnitOutcome solve_on_unit(const fam::LaneUnit& unit, const scene::Scene& scene, const BatchCase& rods,
                          const BatchValues& values, const fam::Options& options);

// By one Solver, a row after the other, each from the unloaded rod: tips and statuses.
fam::BatchResult solve_one_by_one(const scene::Scene& scene, const BatchCase& rods, const BatchValues& values,
                                  const fam::Options& options);

// The largest distance of two tips of a row; infinite where it converges in one of the two alone.
double largest_difference_mm(const fam::BatchResult& a, const fam::BatchResult& b);

Eigen::Index converged_rows(const fam::BatchResult& result);

}  // namespace studies
