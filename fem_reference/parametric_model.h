// A beam model that depends on one parameter.
#pragma once

#include "fem_reference/imbalance.h"
#include "fem_reference/options.h"
#include "scene/path.h"

#include <functional>

namespace fem_reference {

// Of a scene, cut as the options say.
BeamModel beam_model(const scene::Scene& scene, const Options& options);

struct ParametricModel {
  std::function<BeamModel(double parameter)> at;  // elements of the same lengths for all
  double from = 0, to = 1;
  bool turns = false;  // the parameter is an angle, and all goes with its cosine and sine; else linearly with it

  double reach() const;  // |to - from|, 1 where they are the same
};

ParametricModel parametric_model(const scene::PathRequest& request, const Options& options);

// The parameter is the load factor.
ParametricModel parametric_model(const BeamModel& full_load);

// Derivative by the parameter of what a state leaves unbalanced: for either kind of dependence a difference over a
// finite distance is exact.
class ParameterSlope {
 public:
  explicit ParameterSlope(const ParametricModel& parametric);
  Imbalance at(const BeamState& state, double parameter);

 private:
  const ParametricModel& parametric_;
  BeamModel before_, after_;
  double factor_ = 1;
};

// What holds at all values of the parameter.
struct PathFacts {
  bool conservative = false;
  // A turn about the x axis costs nothing: round about it, with nothing but loads along it.
  bool turns_freely = false;
  // And that rod, as long as it is straight, bends in one plane without the other.
  bool planes_apart = false;
};
PathFacts path_facts(const ParametricModel& parametric);

}  // namespace fem_reference
