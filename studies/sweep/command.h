// `fam-studies sweep FILE`
#pragma once

#include "studies/report/progress.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace studies {

struct SweepArguments {
  std::string file;
  std::filesystem::path output = "sweep";
  double tolerance_mm = 0;  // 0: fam::Options' own
  std::uint64_t chunk = 1000;
  bool quiet = false;
};

CLI::App* add_sweep_command(CLI::App& app, SweepArguments& arguments);

// Writes sweep.csv and workspace.svg beside the chunks (studies/engine/engine.h). Exit status 0 also where points
// have no answer: their lines say why.
int run_sweep(const SweepArguments& arguments, Progress::Style style);

}  // namespace studies
