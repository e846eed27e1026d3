// What Study II solves.
#pragma once

#include "scene/scene.h"
#include "studies/compare/stopwatch.h"
#include "studies/methods/registry.h"

#include <Eigen/Core>

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
  bool interpolated;  // some of those stations are not the method's own
  Timing timing;
};

struct Study2Data {
  std::vector<Study2Row> rows;
  scene::Scene forces_alone, with_weight;  // "study2", "study2_gravity_y"
};

inline const std::vector<std::string> study2_scenes = {"study2", "study2_gravity_y", "study2_gravity_z"};

// A competitor: its key in the CSV files, and how it is made. tolerance_mm > 0: FAM's choice for that error.
struct Study2Method {
  std::string key, row;
  Request request;
  double tolerance_mm = 0;
  bool section_frames = false;  // the forces are given in the frames of the bent sections
};

// In groups; the CSV files hold one group after the other.
const std::vector<std::vector<Study2Method>>& study2_groups();
const Study2Method& study2_method(const std::string& key);
std::string study2_label(const std::string& key);  // as pages write it

// Whether the method solved the scene, or did not: throws std::out_of_range where nobody asked it.
const Study2Row& row(const Study2Data& data, const std::string& scene, const std::string& method);

// Largest distance from the exact rod, and from the undeformed line; NaN where not solved.
double largest_error_mm(const Study2Row& row);
double largest_deflection_mm(const Study2Row& row);

}  // namespace studies
