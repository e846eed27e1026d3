// What tests share: reference data, scenes, the rod that must fail.
#pragma once

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <vector>

namespace support {

using Row = std::map<std::string, std::string>;  // column name -> text

// A CSV file of tests/data; lines that start with # are left out. Fails the test if the file cannot be read.
std::vector<Row> read_csv(const std::string& name);
double number(const Row& row, const std::string& column);
Eigen::Vector3d position_mm(const Row& row);  // columns x_mm, y_mm, z_mm

// The row of tests/data/study1_tips.csv: exact tips by an independent solver (origin in the file's head).
Eigen::Vector3d study1_tip_mm(const std::string& load_case, const std::string& frame, const std::string& model);

// P1..P8, S1..S8, and the scene files of studies/cases.
const std::vector<std::string>& study1_cases();
scene::Scene study1_scene(const std::string& load_case, const std::string& frame);

// A straight rod with one section.
scene::Scene uniform_rod(double length_mm, const scene::Stiffness& stiffness, std::vector<scene::Load> loads);
// EI in both directions, GJ; neither stretches nor shears.
scene::Stiffness slender(double bending_Nmm2, double torsion_Nmm2);

// That of EI 500 .. 1500 about one axis, 0.5 .. 1.5 times as much about the other, GJ 300 .. 1000 N mm^2.
scene::Stiffness random_stiffness(std::mt19937& generator);

// The same scene with every stiffness multiplied: the twin that must fail a gate.
scene::Scene stiffer(scene::Scene scene, double factor = 1.05);

// A fact of the model, as Equilibrium::model names it; a test that asks for one that is not there fails.
template <class T = int>
T fact(const scene::Equilibrium& result, const std::string& name) {
  for (const auto& [key, value] : result.model) {
    if (key == name) return std::get<T>(value);
  }
  ADD_FAILURE() << "no fact " << name << ": " << result.message;
  return {};
}

}  // namespace support
