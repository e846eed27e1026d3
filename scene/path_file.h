// The path file (JSON, UTF-8) in, a path out as the command prints it. docs/paths.md states the format.
#pragma once

#include "scene/path.h"

#include <istream>

namespace scene {

// Reads and validates a request: { "scene": {...}, "path": {...} }. Throws SceneError naming `source`, JSON path, value
// and rule.
PathRequest read_path(std::istream& input, const std::string& source);

// The same from a file, or from standard input where path is "-".
PathRequest read_path_file(const std::string& path);

// The parameter for a person: "load factor", "turn, rad", "loads[1].x".
std::string name_of_parameter(const PathRequest& request);

// One JSON object: `status`, `message`, `points`.
std::string to_json(const Path& path);
// A line a point.
std::string to_csv(const Path& path);
// For a person: folds and where the rod lands, branch points, ends.
std::string to_text(const PathRequest& request, const Path& path);

// Where the rod lands that snaps at a fold of a path: the next point of the branch with the fold's parameter that is
// stable, the next at all where the loads have no energy; points.size(): nowhere on it.
std::size_t landing(const Path& path, std::size_t fold);

}  // namespace scene
