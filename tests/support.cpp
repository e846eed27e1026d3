#include "support.h"

#include "scene/scene_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace support {

std::vector<Row> read_csv(const std::string& name) {
  std::ifstream file(std::string(TEST_DATA_DIR) + "/" + name);
  EXPECT_TRUE(file.good()) << name;
  std::vector<std::string> header;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(header.size(), cells.size()); ++i) row[header[i]] = cells[i];
  }
  return rows;
}

double number(const Row& row, const std::string& column) {
  return std::stod(row.at(column));
}

Eigen::Vector3d position_mm(const Row& row) {
  return {number(row, "x_mm"), number(row, "y_mm"), number(row, "z_mm")};
}

Eigen::Vector3d study1_tip_mm(const std::string& load_case, const std::string& frame, const std::string& model) {
  static const std::vector<Row> rows = read_csv("study1_tips.csv");
  for (const Row& row : rows) {
    if (row.at("case") == load_case && row.at("frame") == frame && row.at("model") == model) return position_mm(row);
  }
  ADD_FAILURE() << "no reference tip for " << load_case << " " << frame << " " << model;
  return Eigen::Vector3d::Zero();
}

const std::vector<std::string>& study1_cases() {
  static const std::vector<std::string> cases = {"P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8",
                                                 "S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8"};
  return cases;
}

scene::Scene study1_scene(const std::string& load_case, const std::string& frame) {
  return scene::read_scene_file(std::string(STUDY_CASES_DIR) + "/study1/" + load_case + "_" + frame + ".json");
}

scene::Scene uniform_rod(double length_mm, const scene::Stiffness& stiffness, std::vector<scene::Load> loads) {
  scene::Section section;
  section.length_mm = length_mm;
  section.cross_section = stiffness;
  scene::Scene scene;
  scene.sections = {section};
  scene.loads = std::move(loads);
  return scene;
}

scene::Stiffness slender(double bending_Nmm2, double torsion_Nmm2) {
  scene::Stiffness stiffness;
  stiffness.bending_Nmm2.setConstant(bending_Nmm2);
  stiffness.torsion_Nmm2 = torsion_Nmm2;
  return stiffness;
}

scene::Stiffness random_stiffness(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(0, 1);
  scene::Stiffness stiffness = slender(500 + 1000 * uniform(generator), 300 + 700 * uniform(generator));
  stiffness.bending_Nmm2[1] *= 0.5 + uniform(generator);
  return stiffness;
}

scene::Scene stiffer(scene::Scene scene, double factor) {
  for (scene::Section& section : scene.sections) {
    scene::Stiffness stiffness = stiffness_of(section);
    stiffness.bending_Nmm2 *= factor;
    stiffness.torsion_Nmm2 *= factor;
    if (stiffness.axial_N) *stiffness.axial_N *= factor;
    if (stiffness.shear_N) *stiffness.shear_N *= factor;
    section.cross_section = stiffness;
  }
  return scene;
}

}  // namespace support
