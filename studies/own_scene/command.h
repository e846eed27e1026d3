// `fam-studies compare SCENE...`
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>

namespace studies {

struct CompareArguments {
  std::vector<std::string> scenes, methods;
  std::filesystem::path output = "compare";
  double gate_mm = 0;
  std::string against;
};

CLI::App* add_compare_command(CLI::App& app, CompareArguments& arguments);

// Writes the files, prints the tables; exit status 1 if the gate fails or no method solves a scene, with a line on
// standard error for each failure.
int run_compare(const CompareArguments& arguments);

}  // namespace studies
