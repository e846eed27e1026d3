// fam-studies: everything that compares. `fam-studies --help`, `fam-studies --list` and docs/commands.md say more.
#include "apps/solve_command.h"
#include "scene/scene_file.h"
#include "studies/methods/exact_method.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/fem_method.h"
#include "studies/methods/rk4_method.h"
#include "studies/random/command.h"
#include "studies/registry.h"
#include "studies/stability/maps.h"

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

struct StudyArguments {
  studies::StudyOptions options;
  bool quiet = false, full = false;
};

void add_study_options(CLI::App* command, StudyArguments& arguments) {
  studies::StudyOptions& options = arguments.options;
  command->add_option("--output", options.output, "Folder to write to (default: results)");
  command->add_option("--cases", options.cases, "Folder of the scene files (default: the project's studies/cases)");
  command->add_option("--data", options.data, "Folder of the published numbers (default: the project's tests/data)");
  command->add_flag("--quick", options.quick, "The smallest setting that still runs every line");
  command->add_flag("--quiet", arguments.quiet, "Do not say what is done");
}

void print_list() {
  for (const studies::Study& study : studies::all_studies()) {
    fmt::print("{:<16} {:<70} {}{}\n", study.command(), study.question, study.time, study.full ? " (all --full)" : "");
  }
}

// The studies that the words of the command line ask for, then the index of all results.
int run_studies(const CLI::App& app, StudyArguments& arguments) {
  studies::StudyOptions& options = arguments.options;
  options.progress = arguments.quiet ? studies::Progress::Style::quiet : studies::Progress::style_of(stderr);
  for (const studies::Study& study : studies::all_studies()) {
    const bool in_all = app.got_subcommand("all") && (arguments.full || !study.full);
    if (app.got_subcommand(study.command()) || in_all) {
      study.run(options);
    } else if (app.got_subcommand("all") && !arguments.quiet) {
      fmt::print(stderr, "{}: not run, the results of before stay; `fam-studies all --full` runs it ({})\n",
                 study.command(), study.time);
    }
  }
  studies::write_index(options);
  return apps::exit_solved;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Studies of the finite arc method"};
  bool list = false;
  app.add_flag("--list", list, "Print the studies, what each answers and how long it takes");
  apps::SolveArguments solve_arguments;
  CLI::App* solve = apps::add_solve_command(app, solve_arguments);
  add_method_options(solve, solve_arguments);

  StudyArguments arguments;
  arguments.options.cases = STUDIES_DIR "/cases";
  arguments.options.pages = STUDIES_DIR;
  arguments.options.data = STUDY_DATA_DIR;
  for (const studies::Study& study : studies::all_studies()) {
    add_study_options(app.add_subcommand(study.command(), study.question), arguments);
  }
  CLI::App* all = app.add_subcommand("all", "Run every study");
  add_study_options(all, arguments);
  all->add_flag("--full", arguments.full, "Those that take long, too");

  std::function<int()> chosen = [&] { return run_studies(app, arguments); };
  const studies::Progress::Style progress = studies::Progress::style_of(stderr);
  studies::add_random_command(app, progress, chosen);

  std::string map;
  double x = 0, y = 0;
  CLI::App* cell = app.add_subcommand("cell", "Print the scene of a cell of a stability map");
  cell->add_option("map", map, "follower, fixed, ... as in results/stability")->required();
  cell->add_option("x", x, "Value on the map's x axis")->required();
  cell->add_option("y", y, "Value on the map's y axis; left out where that is a number of arcs or elements");

  return apps::run(app, argc, argv, [&] {
    if (list) {
      print_list();
      return apps::exit_solved;
    }
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
    if (solve->parsed()) return apps::run_solve(solve_arguments, make_method);
    if (cell->parsed()) {
      fmt::print("{}", scene::write_scene(studies::cell_scene(map, x, y)));
      return apps::exit_solved;
    }
    return chosen();
  });
}
