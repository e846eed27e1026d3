// The maps of the stability study: which scene stands in which cell, and which methods are asked.
#pragma once

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace studies {

struct MapAxis {
  std::string label;  // with its unit
  std::vector<double> values;
};

// One scene a cell. Rods of 100 mm; the scale is in the axes.
struct StabilityMap {
  std::string name, title;
  MapAxis x, y;
  bool y_is_cells = false;  // y: number of arcs or elements; else the contender's `fixed_cells`
  std::function<scene::Scene(double x, double y)> scene;
  // Tip by another theory than the exact method's, where there is one; mm, base frame.
  std::function<std::optional<Eigen::Vector3d>(double x, double y)> closed_form;
};

// A method with its number of arcs or elements.
struct Contender {
  std::string key;         // in CSV files
  std::string method;      // key in the registry
  int most_cells;          // not asked beyond; 0: chooses its own
  int fixed_cells;         // in maps that do not say; 0: not asked there
  double largest_x;        // not asked beyond, where the work would be too much for a picture
  std::string only_in;     // the one map that asks it, and asks no other
  std::string arithmetic;  // of the march in the precision map: double or single
  std::function<scene::Equilibrium(const scene::Scene&, int cells)> solve;

  bool automatic() const { return most_cells == 0; }
  std::string name() const;              // on pages
  std::string command(int cells) const;  // options of fam-studies solve
};

constexpr int most_load_steps = 150;  // of finite elements, accepted and rejected

std::vector<StabilityMap> stability_maps();
// The scene of a cell; maps whose y is the number of arcs or elements do not look at y. scene::SceneError: no such map,
// or values that make no scene.
scene::Scene cell_scene(const std::string& map, double x, double y);
const std::vector<Contender>& contenders();  // in the order of the tables
const Contender& contender(const std::string& key);

// The scene with its fixed point loads replaced by follower loads of the same components in the sections where
// `equilibrium` has them: it then has the same equilibrium, and can be marched from the tip. Empty where a load is
// distributed or weight in the base frame, or acts elsewhere than at the tip.
std::optional<scene::Scene> turned_to_follower(const scene::Scene& scene, const scene::Equilibrium& equilibrium);

}  // namespace studies
