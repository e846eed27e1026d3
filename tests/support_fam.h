// What tests share that link fam.
#pragma once

#include "fam/solve.h"

namespace support {

inline scene::Equilibrium solved(const scene::Scene& scene, double tolerance_mm) {
  fam::Options options;
  options.tolerance_mm = tolerance_mm;
  return fam::solve(scene, options);
}

}  // namespace support
