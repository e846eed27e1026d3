#include "studies/model_choice/data.h"

#include <algorithm>

namespace studies {

const Rung* ChosenModel::beside(const std::string& what) const {
  for (const Neighbour& neighbour : neighbours) {
    if (neighbour.what == what) return &neighbour.rung;
  }
  return nullptr;
}

const Rung* ChoiceScene::smallest_elements(double tolerance) const {
  for (const std::vector<Rung>& ladder : ladders) {
    const ModelSize& model = ladder.front().model;
    if (model.finite_elements && model.shear) return smallest_sufficient(ladder, tolerance);
  }
  return nullptr;
}

std::vector<std::string> ModelChoiceData::groups() const {
  std::vector<std::string> list;
  for (const ChoiceScene& scene : scenes) {
    if (std::find(list.begin(), list.end(), scene.group) == list.end()) list.push_back(scene.group);
  }
  return list;
}

std::vector<const ChoiceScene*> ModelChoiceData::of(const std::string& group) const {
  std::vector<const ChoiceScene*> list;
  for (const ChoiceScene& scene : scenes) {
    if (group.empty() || scene.group == group) list.push_back(&scene);
  }
  return list;
}

}  // namespace studies
