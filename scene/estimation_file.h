// The estimation file (JSON, UTF-8) in. docs/estimation.md states the format.
#pragma once

#include "scene/estimation.h"

#include <istream>

namespace scene {

// Reads and validates { "scene": {...}, "unknowns": [...], "measurements": [...] }, or, of one rod under several sets
// of loads, { "scenes": [{"scene": {...}, "measurements": [...]}, ...], "unknowns": [...] }. Throws SceneError naming
// `source`, JSON path, value and rule.
EstimationProblem read_estimation(std::istream& input, const std::string& source);

// The same from a file, or from standard input where path is "-".
EstimationProblem read_estimation_file(const std::string& path);

}  // namespace scene
