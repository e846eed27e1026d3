// Everything that competes, one row a method. A new competitor is a file here and a row in registry.cpp; the command
// line, the sweeps, the tables and the pictures know it from there.
#pragma once

#include "scene/rod_model.h"
#include "studies/methods/method.h"
#include "studies/report/svg.h"

#include <span>

namespace studies {

// How a method is asked to solve.
struct Request {
  int count = 0;         // arcs, steps or elements, as the row counts; 0: its default, FAM's automatic choice
  double tolerance = 0;  // over the rod's length, of a row that counts nothing; 0: its default
  scene::RodModel model = scene::RodModel::automatic;
  bool estimate_error = true;
  bool twist_first = false;  // FAM published: the other rotation order
  bool whole_load = false;   // finite elements: try the whole load in one step
  int most_load_steps = 0;   // finite elements: accepted and rejected; 0: their default
};

struct MethodRow {
  std::string key;      // in CSV files and on the command line
  std::string name;     // on pages and in pictures
  Style style;          // in pictures
  std::string counts;   // "arc", "step", "element"; empty: it has a tolerance, or nothing to choose
  bool kirchhoff_only;  // knows no shear and no stretch
  std::string options;  // of `fam-studies solve`, the count last where it takes one
  std::unique_ptr<Method> (*make)(const MethodRow&, const Request&);

  std::unique_ptr<Method> operator()(const Request& request = {}) const { return make(*this, request); }
};

// In the order of tables and legends.
std::span<const MethodRow> all_methods();
const MethodRow& method_row(const std::string& key);  // throws std::out_of_range

// "FAM published, 12 arcs", "FE", "exact, Kirchhoff": name, count and rod model as pages write them.
std::string label(const MethodRow& row, const Request& request);
std::string counted(int count, const std::string& thing);  // "1 arc", "12 arcs"

}  // namespace studies
