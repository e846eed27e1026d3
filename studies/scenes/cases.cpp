#include "studies/scenes/cases.h"

#include "scene/scene_file.h"

#include <algorithm>

namespace studies {

scene::Scene read_case(const std::filesystem::path& cases, const std::string& name) {
  return scene::read_scene_file((cases / (name + ".json")).string());
}

std::vector<std::string> cases_in(const std::filesystem::path& cases, const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(cases / folder)) {
    if (file.path().extension() == ".json") names.push_back(file.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> study1_cases() {
  std::vector<std::string> cases;
  for (const char set : {'P', 'S'}) {
    for (int i = 1; i <= 8; ++i) cases.push_back(set + std::to_string(i));
  }
  return cases;
}

std::vector<std::string> study1_cases(bool planar) {
  std::vector<std::string> cases;
  for (const std::string& load_case : study1_cases()) {
    if (is_planar(load_case) == planar) cases.push_back(load_case);
  }
  return cases;
}

bool is_planar(const std::string& load_case) {
  return load_case[0] == 'P';
}

}  // namespace studies
