// Every competitor is a Method: a scene in, an equilibrium out, and the bare solve once more for the stopwatch.
#pragma once

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <functional>
#include <memory>
#include <string>

namespace studies {

class Method {
 public:
  virtual ~Method() = default;

  virtual std::string name() const = 0;        // "fam published", "fem", ...
  virtual std::string resolution() const = 0;  // "12 arcs", "50 quadratic elements", ...
  virtual scene::Equilibrium solve(const scene::Scene& scene) const = 0;

  // The solve alone, ready to be called again and again: no reading, no error estimate that is not a part of it.
  virtual std::function<void()> bare_solve(const scene::Scene& scene) const = 0;

  // The same from the solution under slightly smaller loads; empty where the method cannot start from a solution.
  virtual std::function<void()> warm_solve(const scene::Scene&) const { return {}; }
};

}  // namespace studies
