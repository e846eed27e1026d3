// Scenes and files that the tests of exact_reference share.
#pragma once

#include "exact_reference/solve.h"
#include "scene/scene.h"

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace exact_test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using scene::Frame;

inline scene::Scene uniform_rod(double length_mm, double bending_Nmm2, double torsion_Nmm2) {
  scene::Section section;
  section.length_mm = length_mm;
  section.cross_section = scene::Stiffness{torsion_Nmm2, Vector2d::Constant(bending_Nmm2), {}, {}, 0};
  return {"test", {section}, {}};
}

inline scene::Stiffness& stiffness(scene::Scene& rod, std::size_t section = 0) {
  return std::get<scene::Stiffness>(rod.sections[section].cross_section);
}

inline scene::Scene with(scene::Scene rod, const scene::Load& load) {
  rod.loads.push_back(load);
  return rod;
}

inline scene::Scene tip_force(const scene::Scene& rod, Frame frame, const Vector3d& value_N) {
  return with(rod, scene::Force{scene::length_mm(rod), frame, value_N});
}

inline scene::Scene tip_moment(const scene::Scene& rod, Frame frame, const Vector3d& value_Nmm) {
  return with(rod, scene::Moment{scene::length_mm(rod), frame, value_Nmm});
}

// The twin of a gate: the same scene on a rod that is 5 % stiffer.
inline scene::Scene stiffer(scene::Scene rod) {
  for (scene::Section& section : rod.sections) {
    scene::Stiffness s = scene::stiffness_of(section);
    s.torsion_Nmm2 *= 1.05;
    s.bending_Nmm2 *= 1.05;
    if (s.axial_N) *s.axial_N *= 1.05;
    if (s.shear_N) *s.shear_N *= 1.05;
    section.cross_section = s;
  }
  return rod;
}

inline scene::Equilibrium solve(const scene::Scene& rod, exact_reference::Way way = exact_reference::Way::automatic,
                                exact_reference::RodModel model = exact_reference::RodModel::reissner) {
  return exact_reference::solve(rod, {model, 1e-12, way});
}

// The tip; not a number if the solve did not converge, so that no comparison holds.
inline Vector3d tip_mm(const scene::Equilibrium& result) {
  return result.converged() ? result.tip().position_B_mm : Vector3d::Constant(std::nan(""));
}

// Rows of a CSV file, each a list of cells; comment lines and the head are left out.
inline std::vector<std::vector<std::string>> rows(const std::string& file) {
  std::ifstream input(std::string(TEST_DATA_DIR) + "/" + file);
  if (!input) throw std::runtime_error("cannot read " + file);
  std::vector<std::vector<std::string>> result;
  bool head = true;
  for (std::string line; std::getline(input, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (!std::exchange(head, false)) {
      std::stringstream cells(line);
      std::string cell;
      for (result.emplace_back(); std::getline(cells, cell, ',');) result.back().push_back(cell);
    }
  }
  return result;
}

inline double number(const std::string& cell) {
  return std::stod(cell);
}

}  // namespace exact_test
