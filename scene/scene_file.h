// The scene file (JSON, UTF-8) in and out. docs/scene_format.md states the format.
#pragma once

#include "scene/scene.h"

#include <istream>

namespace scene {

// A larger file is refused before it is parsed.
constexpr std::size_t max_scene_file_bytes = 64u << 20;

// Reads and validates a scene. Throws SceneError naming `source`, JSON path, value and rule.
Scene read_scene(std::istream& input, const std::string& source);

// The same from a file, or from standard input where path is "-".
Scene read_scene_file(const std::string& path);

// The scene as a file that read_scene reads back to the same values.
std::string write_scene(const Scene& scene);

}  // namespace scene
