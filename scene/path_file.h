// The path file (JSON) in, and a path as the commands print it. docs/paths.md states both.
#pragma once

#include "scene/path.h"

#include <istream>

namespace scene {

// { "scene": ..., "path": ... }. Reads and validates. Throws SceneError naming `source`, JSON path, value and rule.
PathRequest read_path(std::istream& input, const std::string& source);

// The same from a file, or from standard input where path is "-".
PathRequest read_path_file(const std::string& path);

// One JSON object: `points`, `status`, `message`.
std::string to_json(const Path& path);
// A row a point.
std::string to_csv(const Path& path);

}  // namespace scene
