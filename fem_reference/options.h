// How a rod is cut into elements and how its equations are solved.
#pragma once

#include "scene/rod_model.h"

namespace fem_reference {

using scene::RodModel;  // kirchhoff: exact, not a penalty

struct Options {
  int elements = 50;              // on the whole rod, shared out over the spans; each span gets at least one
  int order = 2;                  // of the shape functions: 1, 2 or 3
  bool full_integration = false;  // order + 1 Gauss points in place of `order`; shows shear locking, else useless
  RodModel model = RodModel::reissner;
  bool estimate_error = true;  // a second solve, on about half the elements

  double initial_load_step = 0.25;    // 0 < . <= 1
  double smallest_load_step = 1e-8;   // below it the solve gives up
  int max_load_steps = 100'000;       // accepted and rejected
  int max_newton_iterations = 15;     // in a load step
  double largest_rotation_rad = 0.6;  // of any node in a load step: keeps to the branch that starts at no load
  double tolerance = 1e-10;           // on Newton increments to come (lengths over L, rad), residuals; load_stepping.h
};

// Throws scene::SceneError if an option is out of its range.
void validate(const Options& options);

}  // namespace fem_reference
