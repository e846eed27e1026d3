// The models that one scene can be solved with, from the smallest on: how far each is from the exact rod.
#pragma once

#include "studies/compare/stopwatch.h"
#include "studies/methods/method.h"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace studies {

// What the model of a scene may be.
struct SceneFacts {
  double length_mm = 0;
  int spans = 0;           // each takes one arc at least
  bool planar = false;     // all lies in one plane: the planar kernel can solve it
  bool march = false;      // all loads follow the rod
  bool gives_way = false;  // some section shears or stretches
};
SceneFacts facts_of(const scene::Scene& scene);

struct ModelSize {
  bool finite_elements = false;  // else arcs of sixth order
  bool space = true, shear = true, march = false;
  int count = 0;  // arcs or elements

  std::string dimension() const { return space ? "space" : "plane"; }
  std::string rod() const { return shear ? "with shear" : "without shear"; }
  std::string solver() const { return march ? "march" : "boundary value"; }
  std::string resolution() const;  // "4 arcs"
};

// A model and its answer. Errors are the largest of any place along the rod, over its length L.
struct Rung {
  ModelSize model;
  std::string status = {};
  double error = std::numeric_limits<double>::quiet_NaN();  // where it did not converge
  std::optional<Timing> time = {};

  bool suffices(double tolerance) const { return error <= tolerance; }
};

// Of models that differ in their count alone, fewest first: the first that suffices, as all finer ones do, so that none
// is taken for luck. Null if there is none.
const Rung* smallest_sufficient(const std::vector<Rung>& rising, double tolerance);

// The least count from `least` to `most` that holds, by bisection from `guess`: as if all larger ones held, too.
// 0: none.
int fewest_sufficient(const std::function<bool(int)>& holds, int least, int guess, int most);

// The scene such that fam takes this model. It chooses plane or space and march or boundary value problem by the loads:
// a torque of 1e-60 N mm makes a scene spatial, a fixed force of 1e-60 N makes it a boundary value problem; neither
// changes a digit of a position.
scene::Scene made_to_take(const ModelSize& model, const SceneFacts& facts, scene::Scene scene);

std::unique_ptr<Method> method_of(const ModelSize& model);

// The largest distance of two shapes over L; NaN where one has none.
double shape_error(const scene::Equilibrium& answer, const scene::Equilibrium& truth);

Rung solved_rung(const ModelSize& model, const SceneFacts& facts, const scene::Scene& scene,
                 const scene::Equilibrium& truth);

// All models of a scene, a list for each that differ in their count alone: plane before space, without shear before
// with, march before boundary value, arcs before elements.
std::vector<std::vector<ModelSize>> all_models(const SceneFacts& facts);

}  // namespace studies
