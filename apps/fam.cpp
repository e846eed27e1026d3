// fam: one scene, at once. `fam solve SCENE`; `fam solve --help` and docs/commands.md say more.
#include "apps/solve_command.h"
#include "studies/methods/fam_method.h"

int main(int argc, char** argv) {
  CLI::App app{"The finite arc method: the static shape of a clamped slender rod", "fam"};
  app.require_subcommand(1);
  apps::SolveArguments arguments;
  apps::add_solve_command(app, arguments);
  return apps::run(app, argc, argv, [&] {
    return apps::run_solve(arguments, [](const apps::SolveArguments& a) { return studies::fam_method(a.fam); });
  });
}
