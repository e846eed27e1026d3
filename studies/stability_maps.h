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
  bool y_is_cells = false;  // y: number of arcs or elements; else `fixed_cells` of them
  std::function<scene::Scene(double x, double y)> scene;
  // Tip by another theory than the exact method's, where there is one; mm, base frame.
  std::function<std::optional<Eigen::Vector3d>(double x, double y)> closed_form;
};

constexpr int fixed_cells = 16;

// A method with its number of arcs or elements (0: automatic).
struct Contender {
  std::string name;
  bool automatic;       // takes no number of arcs or elements
  int most_cells;       // not asked beyond
  std::string command;  // options of fam-studies solve, but for the number of cells
  std::function<scene::Equilibrium(const scene::Scene&, int cells)> solve;
};

std::vector<StabilityMap> stability_maps();
std::vector<Contender> contenders();

// The scene with its fixed point loads replaced by follower loads of the same components in the sections where
// `equilibrium` has them: it then has the same equilibrium, and can be marched from the tip. Empty where a load is
// distributed or weight in the base frame, or acts elsewhere than at the tip.
std::optional<scene::Scene> turned_to_follower(const scene::Scene& scene, const scene::Equilibrium& equilibrium);

}  // namespace studies
