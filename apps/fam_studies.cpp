// fam-studies: everything that compares. `fam-studies --help` and README.md say more.
#include "apps/solve_command.h"
#include "scene/scene_file.h"
#include "studies/benchmarks.h"
#include "studies/exact_method.h"
#include "studies/fam_method.h"
#include "studies/fe_verification.h"
#include "studies/fem_method.h"
#include "studies/rk4_method.h"
#include "studies/segmentation.h"
#include "studies/stability.h"
#include "studies/stability_maps.h"
#include "studies/study1.h"
#include "studies/study2.h"
#include "studies/torsion.h"
#include "studies/work_precision.h"

#include <fmt/format.h>

namespace {

std::unique_ptr<studies::Method> make_method(const apps::SolveArguments& arguments) {
  if (arguments.method == "fam") return studies::fam_method(arguments.fam);
  const bool kirchhoff = arguments.fam.model == fam::RodModel::kirchhoff;
  if (arguments.method == "exact") {
    exact_reference::Options options;
    if (kirchhoff) options.model = exact_reference::RodModel::kirchhoff;
    return studies::exact_method(options);
  }
  if (arguments.method == "rk4") return studies::rk4_method({arguments.steps, !kirchhoff});
  fem_reference::Options options;
  options.elements = arguments.elements;
  options.order = arguments.order;
  if (kirchhoff) options.model = fem_reference::RodModel::kirchhoff;
  return studies::fem_method(options);
}

void add_method_options(CLI::App* solve, apps::SolveArguments& arguments) {
  solve->add_option("--method", arguments.method, "fam, fem, exact or rk4 (plain shooting)")
      ->check(CLI::IsMember({"fam", "fem", "exact", "rk4"}));
  solve->add_option("--elements", arguments.elements, "fem: number of elements (default: 50)")
      ->check(CLI::Range(1, 100'000));
  solve->add_option("--steps", arguments.steps, "rk4: number of steps (default: 50)")->check(CLI::Range(1, 100'000));
  solve->add_option("--order", arguments.order, "fem: order of the elements (default: 2)")->check(CLI::Range(1, 3));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Studies of the finite arc method"};
  app.require_subcommand(1);
  apps::SolveArguments arguments;
  CLI::App* solve = apps::add_solve_command(app, arguments);
  add_method_options(solve, arguments);

  studies::StudyOptions options;
  options.cases = STUDY_CASES_DIR;
  options.data = STUDY_DATA_DIR;
  const std::vector<std::pair<std::string, std::function<void(const studies::StudyOptions&)>>> studies = {
      {"study1", studies::study1},
      {"benchmarks", studies::benchmarks},
      {"fe-verification", studies::fe_verification},
      {"segmentation", studies::segmentation},
      {"torsion", studies::torsion},
      {"study2", studies::study2},
      {"work-precision", studies::work_precision},
      {"stability", studies::stability}};
  for (const auto& [name, study] : studies) app.add_subcommand(name, "Run this study and write its results");
  app.add_subcommand("all", "Run every study");
  for (CLI::App* command : app.get_subcommands({})) {
    if (command == solve) continue;
    command->add_option("--output", options.output, "Folder to write to (default: results)");
    command->add_option("--cases", options.cases, "Folder of the scene files (default: the project's studies/cases)");
    command->add_option("--data", options.data, "Folder of the published numbers (default: the project's tests/data)");
    command->add_flag("--quick", options.quick, "The smallest setting that still runs every line");
  }

  std::string map;
  double x = 0, y = 0;
  CLI::App* cell = app.add_subcommand("cell", "Print the scene of a cell of a stability map");
  cell->add_option("map", map, "follower, fixed, ... as in results/stability")->required();
  cell->add_option("x", x, "Value on the map's x axis")->required();
  cell->add_option("y", y, "Value on the map's y axis; left out where that is a number of arcs or elements");

  return apps::run(app, argc, argv, [&] {
    if (solve->parsed()) return apps::run_solve(arguments, make_method);
    if (cell->parsed()) {
      fmt::print("{}", scene::write_scene(studies::cell_scene(map, x, y)));
      return apps::exit_solved;
    }
    for (const auto& [name, study] : studies) {
      if (app.got_subcommand(name) || app.got_subcommand("all")) study(options);
    }
    studies::write_index(options.output);
    return apps::exit_solved;
  });
}
