// The command `fam path`: the equilibria of a scene while one number of it changes, through folds and past branch
// points.
#pragma once

#include "apps/solve_command.h"

namespace apps {

struct PathArguments {
  std::string path;  // of the file
  fam::Options fam;
  std::string format = "text";
  std::string svg_path, pvd_path;
};

CLI::App* add_path_command(CLI::App& app, PathArguments& arguments);

// Prints the path, as far as it was followed. Returns the exit status.
int run_path(const PathArguments& arguments);

}  // namespace apps
