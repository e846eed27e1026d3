// fam: `fam solve SCENE`, one scene, at once; `fam batch SCENE`, many values of its loads; `fam path FILE`, its
// equilibria while one number of it changes; `fam estimate FILE`, loads from a measured shape. `fam --help` and
// docs/commands.md say more.
#include "apps/batch_command.h"
#include "apps/estimate_command.h"
#include "apps/path_command.h"
#include "studies/methods/fam_method.h"

int main(int argc, char** argv) {
  CLI::App app{"The finite arc method: the static shape of a clamped slender rod", "fam"};
  app.require_subcommand(1);
  apps::SolveArguments solve;
  apps::add_solve_command(app, solve);
  apps::BatchArguments batch;
  const CLI::App* batch_command = apps::add_batch_command(app, batch);
  apps::PathArguments path;
  const CLI::App* path_command = apps::add_path_command(app, path);
  apps::EstimateArguments estimate;
  const CLI::App* estimate_command = apps::add_estimate_command(app, estimate);
  return apps::run(app, argc, argv, [&] {
    if (batch_command->parsed()) return apps::run_batch(batch);
    if (path_command->parsed()) return apps::run_path(path);
    if (estimate_command->parsed()) return apps::run_estimate(estimate);
    return apps::run_solve(solve, [](const apps::SolveArguments& a) { return studies::fam_method(a.fam); });
  });
}
