// The `solve` command that fam and fam-studies share: options, the solve, its time, its output, its exit status.
#pragma once

#include "fam/solve.h"
#include "studies/methods/method.h"

#include <CLI/CLI.hpp>

namespace apps {

// Exit statuses of both commands.
constexpr int exit_solved = 0;
constexpr int exit_not_converged = 1;  // also: a result file could not be written
constexpr int exit_wrong_input = 2;    // scene, usage, or a file to read that is not there

struct SolveArguments {
  std::string scene_path;
  std::string method = "fam";
  fam::Options fam;
  std::string format = "text";
  std::string svg_path, vtu_path;
  bool derivatives = false;
};

// The scene, --tolerance-mm, --arcs, --law, --model.
void add_scene_and_options(CLI::App* command, std::string& scene_path, fam::Options& options,
                           const std::string& what = "Scene file (JSON), or - for standard input");
// --format, --svg.
void add_output_options(CLI::App* command, std::string& format, std::string& svg_path, const std::string& picture);

// Adds `solve` with the options that every method has.
CLI::App* add_solve_command(CLI::App& app, SolveArguments& arguments);

using MethodFactory = std::function<std::unique_ptr<studies::Method>(const SolveArguments&)>;

// Reads the scene, solves, prints. Returns the exit status; nothing is printed on standard output unless solved,
// but for --format json, which states the status.
int run_solve(const SolveArguments& arguments, const MethodFactory& make_method);

// Adds --version, parses and runs `work`; turns wrong usage, wrong scenes and files that cannot be read or written into
// a line and the exit status.
int run(CLI::App& app, int argc, char** argv, const std::function<int()>& work);

}  // namespace apps
