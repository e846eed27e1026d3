// Who competes in the work-precision study, and at which resolutions.
#pragma once

#include "studies/methods/registry.h"

#include <vector>

namespace studies {

// A method of the registry with its settings, over all resolutions.
struct Series {
  std::string key;                         // in CSV files
  std::string method;                      // key in the registry
  bool kirchhoff = true, reissner = true;  // the rod models that it is asked with
  bool whole_load = false;

  const MethodRow& row() const { return method_row(method); }
  std::string name() const;  // on pages
};

const std::vector<Series>& all_series();  // in the order of the tables
const Series& series_named(const std::string& key);

struct Competitor {
  std::string series;      // "fam fourth_order", "fe quadratic adaptive", ...
  std::string model;       // "Kirchhoff" or "Reissner": the exact rod that it is compared with
  std::string resolution;  // "12 arcs", "1e-06 L", ...
  std::string label;       // the same in a table: "12"
  std::unique_ptr<Method> method;
};

// How many finite element meshes a scene is worth: they cost the most.
enum class FeMeshes {
  few,   // 1 to 50 elements, Reissner
  many,  // 1 to 100 elements, both models
  most   // the same, and Reissner up to 400
};

// In the order of tables; a series in order of rising effort.
std::vector<Competitor> competitors(FeMeshes meshes);

}  // namespace studies
