// What tests share that link fam.
#pragma once

#include "fam/solver.h"

#include <gtest/gtest.h>

namespace support {

inline scene::Equilibrium solved(const scene::Scene& scene, double tolerance_mm) {
  fam::Options options;
  options.tolerance_mm = tolerance_mm;
  return fam::solve(scene, options);
}

// A solver that must be made.
inline fam::Solver kept(const scene::Scene& scene, const fam::Options& options) {
  auto made = fam::Solver::make(scene, options);
  if (const fam::Refusal* refusal = std::get_if<fam::Refusal>(&made)) ADD_FAILURE() << refusal->message;
  return std::get<fam::Solver>(std::move(made));
}

}  // namespace support
