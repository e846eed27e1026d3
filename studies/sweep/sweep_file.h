// A sweep's file: a scene, which of its numbers vary and how. docs/sweeps.md states the format.
#pragma once

#include "scene/json_file.h"
#include "scene/scene.h"

#include <istream>
#include <string>
#include <vector>

namespace studies {

struct Variable {
  enum class Spread { even, logarithmic, normal };
  std::string path;  // JSON path of a number of the scene, as errors spell it: loads[0].value_N[1]
  Spread spread = Spread::even;
  double from = 0, to = 0;  // even, logarithmic
  double mean = 0, sd = 0;  // normal
  int points = 0;           // of a grid

  // The value at a share u of the way, 0..1; of a normal one its quantile, u inside (0, 1).
  double value(double u) const;
};

enum class Sampling { grid, latin_hypercube, sobol };

class Sweep {
 public:
  scene::Json scene;
  std::string source;  // of errors
  std::vector<Variable> variables;
  Sampling sampling = Sampling::grid;
  std::uint64_t points = 0;
  std::uint64_t seed = 0;  // of a Latin hypercube

  // Values of all points, row by row: a function of the file alone.
  std::vector<double> samples() const;
  // Throws scene::SceneError where the values make no valid scene.
  scene::Scene scene_with(const double* values) const;
};

// Throws scene::SceneError naming `source`, JSON path, value and rule.
Sweep read_sweep(std::istream& input, const std::string& source);
Sweep read_sweep_file(const std::string& path);

}  // namespace studies
