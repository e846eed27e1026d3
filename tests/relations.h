// Scenes that must have the same answer as another, and how their shapes map onto each other.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace support {

struct Relation {
  std::string name;
  std::function<scene::Scene(const scene::Scene&)> change;        // of the scene
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> map_mm;  // of a position of the old scene to the new one's
  double scale = 1;                                               // of lengths
};

// Turned by 90 degrees about the axis (the sections too); mirrored in the x-y plane; lengths times 1000 and forces
// times 7; each section split in two; each distributed load split in two; each load written twice at half.
const std::vector<Relation>& relations();

}  // namespace support
