// The tables, pictures and page of Study II, as pure functions of what was solved.
#pragma once

#include "studies/compare/stopwatch.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace studies {

// A solve: scene "study2", "study2_gravity_y" or "study2_gravity_z". The shape, and its difference from the exact one,
// at the exact solution's stations; empty where the method did not converge.
struct Study2Row {
  std::string scene, method, status;
  std::vector<double> s_mm;
  std::vector<Eigen::Vector3d> positions_mm;  // base frame
  std::vector<double> errors_mm;
  Timing timing;
};

// File name to content.
std::map<std::string, std::string> study2_files(const std::vector<Study2Row>& rows);

}  // namespace studies
