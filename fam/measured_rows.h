// What is measured of a rod against what a solved model gives: residuals over their standard deviations, and slopes by
// the unknowns.
#pragma once

#include "fam/solver.h"

#include "scene/estimation.h"

#include <Eigen/Core>

namespace fam {

// Of all scenes, unlike a load's value and place.
inline bool is_of_section(const scene::Unknown& unknown) {
  return unknown.kind != scene::Unknown::Kind::component && unknown.kind != scene::Unknown::Kind::place;
}

int rows_of(const scene::Measurement& measurement);

// Whether put_slopes gives the same for both, but for how far a measured rotation is from the model's.
bool has_slopes_of(const scene::Measurement& a, const scene::Measurement& b);

// What the model gives less what is measured, over sd.
void put_residual(const Solver& solver, const scene::Measurement& measurement, Eigen::Ref<Eigen::VectorXd> rows);

// Of these rows by each unknown in the unit of the scene: a column each, left alone where the unknown is a load's of
// another scene. `given` has the sections before any factor; `unit`: of the unknowns (unit_of), by which round-off is
// told and put to zero.
void put_slopes(const Solver& solver, const scene::MeasuredScene& given, std::size_t scene,
                const std::vector<scene::Unknown>& unknowns, const Eigen::VectorXd& unit,
                const scene::Measurement& measurement, Eigen::Ref<Eigen::MatrixXd> rows);

}  // namespace fam
