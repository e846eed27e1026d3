// Parts of reading a scene file, for files that hold a scene among other things.
#pragma once

#include "scene/json_node.h"
#include "scene/scene.h"

#include <istream>

namespace scene {

// All of a stream, or of a file ("-": standard input), which `source` then names. Throws SceneError.
std::string read_text(std::istream& input, const std::string& source);
std::string read_text_file(const std::string& path, std::string& source);

// The scene at a node; not validated.
Scene read_scene(const JsonNode& node);

}  // namespace scene
