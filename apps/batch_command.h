// The command `fam batch`: one rod, many values of its loads.
#pragma once

#include "apps/solve_command.h"

namespace apps {

struct BatchArguments {
  std::string scene_path, values_path;
  std::string output_path = "-", pvd_path;
  fam::Options fam;
};

CLI::App* add_batch_command(CLI::App& app, BatchArguments& arguments);

// A row of output for each row of values; nothing is written before all are solved. Returns the exit status.
int run_batch(const BatchArguments& arguments);

}  // namespace apps
