#include "apps/batch_command.h"

#include "apps/values_file.h"
#include "apps/vtu_file.h"
#include "fam/batch.h"
#include "fam/solve.h"
#include "scene/load_visitor.h"
#include "scene/scene_file.h"
#include "studies/report/output_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace apps {
namespace {

std::string to_csv(const fam::BatchResult& result) {
  std::string csv = "x_mm,y_mm,z_mm,qw,qx,qy,qz,error_estimate_mm,status\n";
  for (std::size_t k = 0; k < result.status.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (result.status[k] == scene::Status::converged) {
      for (const double coordinate : result.position_mm.row(row)) csv += fmt::format("{},", coordinate);
      for (const double component : result.rotation_wxyz.row(row)) csv += fmt::format("{},", component);
      csv += fmt::format("{},", result.error_estimate_mm[row]);
    } else {
      csv += ",,,,,,,,";
    }
    csv += fmt::format("{}\n", scene::name(result.status[k]));
  }
  return csv;
}

// The rows that were solved, each once more for its shape.
void write_rods(const std::string& path, const scene::Scene& scene, const Values& values,
                const fam::BatchResult& result, const fam::Options& options) {
  RodCollection rods(path);
  scene::Scene row = scene;
  for (Eigen::Index k = 0; k < values.values.rows(); ++k) {
    const auto number = static_cast<std::size_t>(k);
    if (result.status[number] != scene::Status::converged) continue;
    for (std::size_t i = 0; i < values.columns.size(); ++i) {
      const auto [load, component] = values.columns[i];
      scene::numbers_of(row.loads[load])[static_cast<std::size_t>(component)] =
          values.values(k, static_cast<Eigen::Index>(i));
    }
    const scene::Equilibrium solved = fam::solve(row, options);
    if (solved.converged()) rods.add(number, row, solved);
  }
  rods.write();
}

}  // namespace

CLI::App* add_batch_command(CLI::App& app, BatchArguments& arguments) {
  CLI::App* batch = app.add_subcommand("batch", "Solve one scene for many values of its loads");
  add_scene_and_options(batch, arguments.scene_path, arguments.fam);
  studies::add_file_option(batch, "--values", arguments.values_path,
                           "Values (CSV), or - for standard input: a row a rod, columns such as 0.x or 2.tension")
      ->required();
  studies::add_file_option(batch, "--output", arguments.output_path,
                           "Results (CSV), a row a rod (default: -, standard output)");
  studies::add_file_option(batch, "--pvd", arguments.pvd_path,
                           "Write the rods that were solved for ParaView, and this file that lists them");
  batch->add_flag_callback(
      "--no-estimate", [&arguments] { arguments.fam.estimate_error = false; }, "Leave the error estimate out");
  batch
      ->add_option("--threads", arguments.fam.threads,
                   "Threads that share the rows (default: 1); 0: as many as the machine runs at once")
      ->check(CLI::Range(0, 1024));
  batch->callback([&arguments] {
    if (arguments.scene_path == "-" && arguments.values_path == "-")
      throw CLI::ValidationError("--values", "standard input is the scene already");
    studies::refuse_overwriting({{"the scene", arguments.scene_path}, {"--values", arguments.values_path}},
                                {{"--output", arguments.output_path}, {"--pvd", arguments.pvd_path}});
  });
  return batch;
}

int run_batch(const BatchArguments& arguments) {
  const scene::Scene scene = scene::read_scene_file(arguments.scene_path);
  const Values values = read_values_file(arguments.values_path, scene);
  const auto start = std::chrono::steady_clock::now();
  const fam::BatchResult result = fam::solve_batch(scene, values.columns, values.values, arguments.fam);
  const double time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const std::string csv = to_csv(result);
  if (arguments.output_path == "-") fmt::print("{}", csv);
  else studies::write_file(arguments.output_path, csv);
  if (!arguments.pvd_path.empty()) write_rods(arguments.pvd_path, scene, values, result, arguments.fam);
  const auto rods = static_cast<std::ptrdiff_t>(result.status.size());
  fmt::print(stderr, "{} rods in {:.3g} s, {:.3g} rods/s\n", rods, time_s, static_cast<double>(rods) / time_s);
  const auto solved = std::count(result.status.begin(), result.status.end(), scene::Status::converged);
  if (solved == rods) return exit_solved;
  fmt::print(stderr, "{} of {} rods not converged; their status says why\n", rods - solved, rods);
  return exit_not_converged;
}

}  // namespace apps
