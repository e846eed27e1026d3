#include "studies/own_scene/command.h"

#include "scene/scene_file.h"
#include "studies/own_scene/comparison.h"
#include "studies/report/output_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace studies {
namespace {

std::string source_of(const std::string& path) {
  return path == "-" ? "(standard input)" : path;
}

void check_usage(const CompareArguments& arguments, bool has_gate) {
  const auto& [scenes, methods, output, gate_mm, against] = arguments;
  if (has_gate && !(std::isfinite(gate_mm) && gate_mm > 0))
    throw CLI::ValidationError("--gate-mm", "must be a number > 0");
  if (std::set<std::string>(methods.begin(), methods.end()).size() < methods.size())
    throw CLI::ValidationError("--methods", "names a method twice");
  if (!against.empty() && scenes.size() > 1) throw CLI::ValidationError("--against", "needs one scene");
  if (std::count(scenes.begin(), scenes.end(), "-") + (against == "-") > 1)
    throw CLI::ValidationError("-", "standard input is read once");
  NamedFiles inputs{{"--against", against}};
  for (const std::string& scene : scenes) inputs.emplace_back("the scene", scene);
  for (const char* name : {"compare.md", "compare.csv", "compare.json", "compare.svg"})
    refuse_overwriting(inputs, {{"--output", (output / name).string()}});
}

}  // namespace

CLI::App* add_compare_command(CLI::App& app, CompareArguments& arguments) {
  const auto& keys = compared_methods();
  arguments.methods.assign(keys.begin(), keys.begin() + compared_by_default);
  CLI::App* command = app.add_subcommand("compare", "Solve scenes by several methods, beside each other");
  command->add_option("scene", arguments.scenes, "Scene files (JSON), or - for standard input")->required();
  command->add_option("--methods", arguments.methods, "Separated by commas (default: fam,published,fem,exact)")
      ->delimiter(',')
      ->check(CLI::IsMember(keys));
  command->add_option("--output", arguments.output,
                      "Folder for compare.md, compare.csv, compare.json and compare.svg (default: compare)");
  const auto* gate = command->add_option(
      "--gate-mm", arguments.gate_mm, "Exit status 1 if a shape is farther than this from the most accurate one, mm");
  add_file_option(command, "--against", arguments.against,
                  "A centreline of your own (CSV: s_mm,x,y,z), or -; the gate then holds it alone");
  command->callback([&arguments, gate] { check_usage(arguments, gate->count() > 0); });
  return command;
}

int run_compare(const CompareArguments& arguments) {
  std::vector<scene::Scene> scenes;
  for (const std::string& path : arguments.scenes) scenes.push_back(scene::read_scene_file(path));
  std::vector<CentrelinePoint> centreline;
  if (!arguments.against.empty()) centreline = read_centreline(arguments.against, scenes.front());

  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    comparisons.push_back(compare(source_of(arguments.scenes[i]), scenes[i], arguments.methods));
  if (!centreline.empty()) compare_file(comparisons.front(), source_of(arguments.against), centreline);

  const std::map<std::string, std::string> files = comparison_files(comparisons, arguments.gate_mm);
  write_files(arguments.output, files);
  fmt::print("{}", files.at("compare.md"));
  std::fflush(stdout);  // failures stand below the tables where both go to one place
  int status = 0;
  for (const Comparison& comparison : comparisons) {
    std::vector<std::string> failures;
    if (arguments.gate_mm > 0) failures = gate_failures(comparison, arguments.gate_mm);
    else if (!comparison.truth()) failures = {comparison.source + ": no method solved it"};
    for (const std::string& failure : failures) fmt::print(stderr, "{}\n", failure);
    if (!failures.empty()) status = 1;
  }
  return status;
}

}  // namespace studies
