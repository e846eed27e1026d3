#include "studies/random/command.h"

#include "scene/scene_file.h"
#include "studies/random/blocks.h"
#include "studies/random/page.h"
#include "studies/report/output_file.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

namespace studies {
namespace {

int write_all(const std::map<std::string, std::string>& files, const std::filesystem::path& output) {
  for (const auto& [name, text] : files) write_file(output / name, text);
  return 0;
}

// The arguments of the subcommands, in one place: CLI11 writes to them while it parses.
struct Arguments {
  std::uint64_t seed = 0, from = 0, to = 0, scenes = 0;
  std::string folder, output, list;
};

}  // namespace

void add_random_commands(CLI::App& random, const Progress::Style& progress, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  const auto add = [&](const std::string& name, const std::string& what, const std::function<int()>& work) {
    CLI::App* command = random.add_subcommand(name, what);
    command->callback([arguments, &chosen, work] { chosen = work; });
    return command;
  };

  CLI::App* scene = add("scene", "Print one scene", [&a] {
    fmt::print("{}", scene::write_scene(random_scene(a.seed)));
    return 0;
  });
  constexpr auto largest_number = std::numeric_limits<std::uint64_t>::max();  // which larger ones are read as
  scene->add_option("seed", a.seed)->required()->check(CLI::Range(std::uint64_t{0}, largest_number - 1));

  const CLI::Validator whole_blocks(
      [](const std::string& text) {
        return text.size() <= 12 && text.find_first_not_of("0123456789") == std::string::npos &&
                       std::strtoull(text.c_str(), nullptr, 10) % 500 == 0
                   ? std::string()
                   : "must be a multiple of 500";
      },
      "MULTIPLE OF 500");
  CLI::App* run = add("run", "Solve and judge the scenes FROM..TO-1 (multiples of 500)", [&a, &progress] {
    run_blocks(a.from, a.to, a.folder, progress);
    return 0;
  });
  run->add_option("from", a.from)->required()->check(whole_blocks);
  run->add_option("to", a.to)->required()->check(whole_blocks);
  run->add_option("folder", a.folder)->required();

  CLI::App* second = add("second", "A second opinion where FAM is wrong and silent", [&a] {
    second_opinions(a.folder);
    return 0;
  });
  second->add_option("folder", a.folder)->required();

  CLI::App* sum = add("sum", "Tables of a folder of outcomes",
                      [&a] { return write_all(outcome_tables(all_outcomes(a.folder)), a.output); });
  sum->add_option("folder", a.folder)->required();
  sum->add_option("output", a.output)->required();

  CLI::App* promise = add("promise", "Is the tolerance kept?", [&a, &progress] {
    return write_all(promise_tables(all_promises(a.scenes, mixed_seed, progress)), a.output);
  });
  CLI::App* estimates = add("estimates", "Is an estimate below half the error? Strips and heavy rods", [&a, &progress] {
    return write_all(estimate_tables(all_promises(a.scenes, estimate_seed, progress)), a.output);
  });
  for (CLI::App* command : {promise, estimates}) {
    command->add_option("scenes", a.scenes)->required();
    command->add_option("output", a.output)->required();
  }

  CLI::App* known = add("check", "Exit status 1 on an outcome that the list does not hold",
                        [&a] { return check_outcomes(a.folder, a.list); });
  known->add_option("folder", a.folder)->required();
  known->add_option("list", a.list)->required();
}

}  // namespace studies
