// A scene: one clamped rod and its loads.
//
// Units: mm, N, N mm, N mm^2, MPa, rad. Base frame B: at the clamp (s = 0), x along the undeformed rod,
// right-handed. Section frame S(s): x along the tangent, y and z in the section.
#pragma once

#include "scene/load.h"
#include "scene/section.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace scene {

struct Scene {
  std::string title;
  std::vector<Section> sections;  // clamp to tip
  std::vector<Load> loads;
};

// Wrong input. what() is one line: "<source>: <JSON path> = <value>: <rule>".
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Two places on a rod are the same place when they are closer than this times the rod's length.
constexpr double same_place_relative = 1e-12;

// Limits that keep a scene within what the methods are tested for.
constexpr int max_sections = 10'000;
constexpr int max_loads = 100'000;
constexpr int max_tendon_offsets = 32;  // different ones

double length_mm(const Scene& scene);

// The section at a place; where two meet that towards the clamp.
const Section& section_at(const Scene& scene, double s_mm);

// Throws SceneError at the first rule of the scene format that the values break; `source` names the scene in the
// message, usually its file, and `path` where it stands there.
void validate(const Scene& scene, const std::string& source = "scene", const std::string& path = "");

}  // namespace scene
