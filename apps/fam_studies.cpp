// fam-studies: everything that compares. `fam-studies --help`, `fam-studies --list` and docs/commands.md say more.
#include "allocation_counter.h"
#include "apps/solve_command.h"
#include "scene/scene_file.h"
#include "studies/campaign/command.h"
#include "studies/methods/fam_method.h"
#include "studies/methods/registry.h"
#include "studies/own_scene/command.h"
#include "studies/population/data.h"
#include "studies/random/command.h"
#include "studies/registry.h"
#include "studies/report/output_file.h"
#include "studies/stability/maps.h"
#include "studies/sweep/command.h"
#include "studies/third_party/command.h"
#include "studies/work_precision/instructions.h"

#include <fmt/format.h>

#include <array>
#include <set>

namespace {

// --method fam: the options of `fam solve`; fem: with --order; else a key of the registry.
struct MethodArguments {
  int order = 2;
  std::map<std::string, int> counts;  // by what a row counts
};

std::unique_ptr<studies::Method> make_method(const apps::SolveArguments& arguments, const MethodArguments& of_method) {
  if (arguments.method == "fam") return studies::fam_method(arguments.fam);
  const std::array<std::string, 3> by_order = {"fe_linear", "fe", "fe_cubic"};
  const bool by_elements = arguments.method == "fem";
  const studies::MethodRow& row =
      studies::method_row(by_elements ? by_order.at(static_cast<std::size_t>(of_method.order - 1)) : arguments.method);
  studies::Request request;
  request.model = arguments.fam.model;
  if (const auto count = of_method.counts.find(row.counts); count != of_method.counts.end()) {
    request.count = count->second;
  } else if (row.counts == "arc") {
    request.count = arguments.fam.arcs;
  }
  return row(request);
}

void add_method_options(CLI::App* solve, apps::SolveArguments& arguments, MethodArguments& of_method) {
  std::vector<std::string> keys = {"fem"};
  std::map<std::string, std::string> counts;
  for (const studies::MethodRow& row : studies::all_methods()) {
    keys.push_back(row.key);
    if (row.counts != "arc" && !row.counts.empty())
      counts[row.counts] += (counts[row.counts].empty() ? "" : ", ") + row.key;
  }
  solve->add_option("--method", arguments.method, "fam, fem, exact, rk4 (plain shooting) or another key")
      ->check(CLI::IsMember(keys));
  for (const auto& [what, of] : counts) {
    solve
        ->add_option_function<int>(
            "--" + what + "s", [&of_method, what = what](const int& n) { of_method.counts[what] = n; },
            of + ": number of " + what + "s (default: 50)")
        ->check(CLI::Range(1, 100'000));
  }
  solve->add_option("--order", of_method.order, "fem: order of the elements (default: 2)")->check(CLI::Range(1, 3));
}

// An option of another method would change nothing, and say nothing.
void refuse_options_of_others(const CLI::App& solve, const std::string& method) {
  std::set<std::string> taken = {"scene", "--model", "--format", "--svg", "--vtu", "--method"};
  if (method == "fam")
    taken.insert({"--tolerance-mm", "--arcs", "--law", "--twist-order", "--derivatives", "--after-snap"});
  else if (method == "fem") taken.insert({"--elements", "--order"});
  else taken.insert("--" + studies::method_row(method).counts + "s");
  for (const CLI::Option* option : solve.get_options()) {
    if (option->count() > 0 && taken.count(option->get_name()) == 0)
      throw CLI::ValidationError(option->get_name(), "is no option of --method " + method);
  }
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
  studies::make_folder(options.output);  // before hours of work, not after
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
  CLI::App app{"Studies of the finite arc method", "fam-studies"};
  bool list = false;
  app.add_flag("--list", list, "Print the studies, what each answers and how long it takes");
  apps::SolveArguments solve_arguments;
  CLI::App* solve = apps::add_solve_command(app, solve_arguments);
  MethodArguments of_method;
  add_method_options(solve, solve_arguments, of_method);

  studies::CompareArguments compare_arguments;
  const CLI::App* compare = studies::add_compare_command(app, compare_arguments);

  studies::ExportArguments export_arguments;
  const CLI::App* write_deck = studies::add_export_command(app, export_arguments);

  studies::SweepArguments sweep_arguments;
  const CLI::App* sweep = studies::add_sweep_command(app, sweep_arguments);

  StudyArguments arguments;
  arguments.options.cases = STUDIES_DIR "/cases";
  arguments.options.pages = STUDIES_DIR;
  arguments.options.committed = STUDIES_DIR "/../results";
  arguments.options.allocations = allocation_count;
  arguments.options.data = STUDY_DATA_DIR;
  for (const studies::Study& study : studies::all_studies()) {
    add_study_options(app.add_subcommand(study.command(), study.question), arguments);
  }
  CLI::App* all = app.add_subcommand("all", "Run every study");
  add_study_options(all, arguments);
  all->add_flag("--full", arguments.full, "Those that take long, too");

  std::function<int()> chosen = [&] { return run_studies(app, arguments); };
  const studies::Progress::Style progress = studies::Progress::style_of(stderr);
  studies::add_random_commands(*app.get_subcommand("random"), progress, chosen);
  studies::add_statistic_option(*app.get_subcommand("population"), arguments.options.quick, arguments.quiet, chosen);

  studies::add_campaign_commands(*app.get_subcommand("campaign"), progress, chosen);

  std::string map;
  double x = 0, y = 0;
  CLI::App* cell = app.add_subcommand("cell", "Print the scene of a cell of a stability map");
  cell->add_option("map", map, "follower, fixed, ... as in results/stability")->required();
  cell->add_option("x", x, "Value on the map's x axis")->required();
  cell->add_option("y", y, "Value on the map's y axis; left out where that is a number of arcs or elements");

  std::string counted;
  CLI::App* count = app.add_subcommand("counted-solves", "What `work-precision` runs under callgrind");
  count->group("")->add_option("list", counted)->required();

  return apps::run(app, argc, argv, [&] {
    if (list) {
      print_list();
      return apps::exit_solved;
    }
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
    if (solve->parsed()) {
      refuse_options_of_others(*solve, solve_arguments.method);
      return apps::run_solve(solve_arguments, [&](const apps::SolveArguments& a) { return make_method(a, of_method); });
    }
    if (compare->parsed()) return studies::run_compare(compare_arguments);
    if (write_deck->parsed()) return studies::run_export(export_arguments);
    if (sweep->parsed()) return studies::run_sweep(sweep_arguments, progress);
    if (cell->parsed()) {
      fmt::print("{}", scene::write_scene(studies::cell_scene(map, x, y)));
      return apps::exit_solved;
    }
    if (count->parsed()) return studies::run_counted_solves(counted, arguments.options.cases);
    return chosen();
  });
}
