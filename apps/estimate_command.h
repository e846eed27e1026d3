// The command `fam estimate`: loads, places, stiffness factors and rest curvatures from what was measured of a shape.
#pragma once

#include "apps/solve_command.h"

namespace apps {

struct EstimateArguments {
  std::string path;  // of the file
  fam::Options fam;
  std::string format = "text";
};

CLI::App* add_estimate_command(CLI::App& app, EstimateArguments& arguments);

// Prints the estimate. Returns the exit status.
int run_estimate(const EstimateArguments& arguments);

}  // namespace apps
