// A scene as a keyword deck, which Abaqus and CalculiX read: quadratic beam elements, large displacements, one static
// step from no load to all of it.
#pragma once

#include "scene/scene.h"

namespace studies {

enum class DeckFormat { abaqus, calculix };

constexpr int default_deck_elements = 50;

// mm, N, MPa, t. Nodes stand along x, the clamp is node 1, the tip the node set TIP. Throws scene::SceneError naming
// source, JSON path, value and rule where the deck cannot say what the scene says.
std::string deck(const scene::Scene& scene, const std::string& source, DeckFormat format,
                 int elements = default_deck_elements);

}  // namespace studies
