#include "studies/sweep/command.h"

#include "fam/solve.h"
#include "studies/engine/engine.h"
#include "studies/report/output_file.h"
#include "studies/sweep/sweep_file.h"
#include "studies/sweep/workspace.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace studies {
namespace {

std::string head_of(const Sweep& sweep) {
  std::string head = "point";
  for (const Variable& variable : sweep.variables) head += "," + variable.path;
  return head + ",status,x_mm,y_mm,z_mm,tip_angle_rad,error_estimate_mm,stable\n";
}

fam::Options options_of(const SweepArguments& arguments) {
  fam::Options options;
  options.tolerance_mm = arguments.tolerance_mm;
  options.whole_rod = false;
  options.locate_limit = false;
  return options;
}

// The numbers of a point without an answer are left out.
std::string line_of(const Sweep& sweep, std::uint64_t point, const double* values, const fam::Options& options) {
  std::string line = std::to_string(point);
  for (std::size_t k = 0; k < sweep.variables.size(); ++k) line += fmt::format(",{:.10g}", values[k]);
  scene::Scene scene;
  try {
    scene = sweep.scene_with(values);
  } catch (const scene::SceneError&) {  // the tail of a normal distribution
    return line + ",no_valid_scene,,,,,,\n";
  }
  const scene::Equilibrium answer = fam::solve(scene, options);
  if (!answer.converged()) return line + fmt::format(",{},,,,,,\n", scene::name(answer.status));
  const Eigen::Vector3d tip = answer.tip().position_B_mm;
  const char* stable = !answer.stable ? "" : *answer.stable ? "yes" : "no";
  return line + fmt::format(",converged,{:.9g},{:.9g},{:.9g},{:.9g},{:.2e},{}\n", tip[0], tip[1], tip[2],
                            answer.tip_angle_rad, answer.error_estimate_mm, stable);
}

// What the folder's manifest holds of a sweep: file and tolerance, hashed.
std::string identity_of(const Sweep& sweep, const std::vector<double>& samples, double tolerance_mm) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](const std::string& text) {
    for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  };
  add(sweep.scene.dump() + head_of(sweep) + fmt::format("{:.17g}", tolerance_mm));
  for (const double value : samples) add(fmt::format("{:.10g},", value));
  return fmt::format("{:016x}", hash);
}

// The tips of the lines of a chunk that have one.
void collect_tips(const std::string& text, std::size_t variables, std::vector<Eigen::Vector3d>& tips) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t k = 0; k < variables + 2; ++k) std::getline(cells, cell, ',');
    if (cell != "converged") continue;
    Eigen::Vector3d tip;
    for (double& x : tip) {
      std::getline(cells, cell, ',');
      x = std::strtod(cell.c_str(), nullptr);
    }
    tips.push_back(tip);
  }
}

}  // namespace

CLI::App* add_sweep_command(CLI::App& app, SweepArguments& arguments) {
  CLI::App* command = app.add_subcommand("sweep", "Solve a scene over ranges of its numbers: tips and their workspace");
  command->add_option("file", arguments.file, "Sweep file (JSON, docs/sweeps.md), or - for standard input")->required();
  command->add_option("--output", arguments.output, "Folder to write to, and to go on in (default: sweep)");
  command->add_option("--tolerance-mm", arguments.tolerance_mm, "Largest error of any place (default: 1e-3 L)")
      ->check(CLI::PositiveNumber);
  command->add_option("--chunk", arguments.chunk, "Points a file; as many are lost where a process is killed")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000}));
  command->add_flag("--quiet", arguments.quiet, "Do not say what is done");
  return command;
}

int run_sweep(const SweepArguments& arguments, Progress::Style style) {
  const Sweep sweep = read_sweep_file(arguments.file);
  const std::vector<double> samples = sweep.samples();
  if (!std::isfinite(arguments.tolerance_mm)) throw scene::SceneError("--tolerance-mm: must be a number > 0");
  const fam::Options options = options_of(arguments);
  const CampaignPlan plan{"sweep", identity_of(sweep, samples, arguments.tolerance_mm), sweep.points, arguments.chunk,
                          arguments.output};
  const std::size_t width = sweep.variables.size();
  Crew crew;
  const auto work = [&](std::uint64_t from, std::uint64_t to, const std::function<void()>& help) {
    std::string text;
    for (std::uint64_t point = from; point < to; ++point) {
      text += line_of(sweep, point, &samples[point * width], options);
      help();
    }
    return text;
  };
  if (!run_chunks(crew, plan, work, arguments.quiet ? Progress::Style::quiet : style)) return 1;
  if (!crew.leads()) return 0;
  std::string table = head_of(sweep);
  std::vector<Eigen::Vector3d> tips;
  read_chunks(plan, [&](const std::string& text) {
    table += text;
    collect_tips(text, width, tips);
  });
  const double length_mm = scene::length_mm(sweep.scene_with(samples.data()));
  write_files(arguments.output,
              {{"sweep.csv", table}, {"workspace.svg", workspace_svg(tips, length_mm, sweep.points)}});
  fmt::print("{} points, {} with an answer: {}\n", sweep.points, tips.size(),
             (arguments.output / "sweep.csv").string());
  return 0;
}

}  // namespace studies
