#include "apps/solve_command.h"

#include "apps/derivatives.h"
#include "apps/shape_chart.h"
#include "apps/vtu_file.h"
#include "scene/equilibrium_file.h"
#include "scene/scene_file.h"
#include "studies/compare/stopwatch.h"
#include "studies/report/chart.h"
#include "studies/report/output_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace apps {
namespace {

// One view where the rod stays in the x-y plane, three where it does not.
std::string picture(const scene::Scene& scene, const scene::Equilibrium& result, const std::string& method) {
  const bool planar = std::all_of(result.stations.begin(), result.stations.end(), [](const scene::Station& station) {
    return std::abs(station.X_BS.position_B_mm[2]) < 1e-12 * (1 + station.s_mm);
  });
  const std::vector<View> views = planar ? std::vector<View>{{0, 1}} : std::vector<View>{{0, 1}, {0, 2}, {1, 2}};
  Centreline unloaded{
      "", {Eigen::Vector3d::Zero(), {scene::length_mm(scene), 0, 0}}, studies::colour::grey, "4 3", false};
  return shape_chart({unloaded, centreline(result, method, studies::colour::blue)}, views, scene.title);
}

std::string not_positive(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return *end == 0 && std::isfinite(value) && value > 0 ? "" : "must be a number > 0";
}

// An option that takes one of a few names.
template <class Value>
void add_choice(CLI::App* command, const std::string& option, Value& target, const std::string& what,
                const std::map<std::string, Value>& names) {
  command
      ->add_option_function<std::string>(
          option, [&target, names](const std::string& n) { target = names.at(n); }, what)
      ->check(CLI::IsMember(names));
}

}  // namespace

void add_output_options(CLI::App* command, std::string& format, std::string& svg_path, const std::string& picture) {
  command->add_option("--format", format, "text, json or csv (default: text)")
      ->check(CLI::IsMember({"text", "json", "csv"}));
  studies::add_file_option(command, "--svg", svg_path, picture);
}

void add_scene_and_options(CLI::App* command, std::string& scene_path, fam::Options& options, const std::string& what) {
  command->add_option("scene", scene_path, what)->required();
  auto* tolerance = command->add_option("--tolerance-mm", options.tolerance_mm,
                                        "Largest error of any place along the rod, mm (default: 1e-3 of the length)");
  tolerance->check(CLI::Validator(not_positive, "> 0"));
  command->add_option("--arcs", options.arcs, "Number of arcs (default: as many as the tolerance takes)")
      ->check(CLI::Range(1, fam::max_arcs))
      ->excludes(tolerance);
  std::map<std::string, fam::Law> laws{{fam::name(fam::Law::automatic), fam::Law::automatic}};
  for (const fam::Law law : fam::all_laws()) laws.emplace(fam::name(law), law);
  add_choice(command, "--law", options.law, "Arc law (default: auto, which is sixth_order)", laws);
  add_choice<fam::RodModel>(command, "--model", options.model,
                            "Rod model (default: auto, without shear where it does not matter)",
                            {{"auto", fam::RodModel::automatic},
                             {"kirchhoff", fam::RodModel::kirchhoff},
                             {"reissner", fam::RodModel::reissner}});
}

CLI::App* add_solve_command(CLI::App& app, SolveArguments& arguments) {
  fam::Options& options = arguments.fam;
  CLI::App* solve = app.add_subcommand("solve", "Solve one scene");
  add_scene_and_options(solve, arguments.scene_path, options);
  add_choice<fam::TwistOrder>(
      solve, "--twist-order", options.twist_order, "Published law: order of its rotations (default: bend_twist)",
      {{"bend_twist", fam::TwistOrder::bend_twist}, {"twist_bend", fam::TwistOrder::twist_bend}});
  add_output_options(solve, arguments.format, arguments.svg_path,
                     "Write a picture of the deformed centreline to this file");
  studies::add_file_option(solve, "--vtu", arguments.vtu_path, "Write the rod to this file for ParaView (VTK's XML)");
  solve->add_flag("--derivatives", arguments.derivatives,
                  "Add the tip's derivatives by loads, sections and a wrench at the tip to --format json");
  solve->add_flag("--after-snap", options.after_snap,
                  "Where the rod snaps: the next stable equilibrium under the full load");
  solve->callback([solve, &options, &arguments] {
    if (arguments.derivatives && (arguments.format != "json" || arguments.method != "fam"))
      throw CLI::ValidationError("--derivatives", "needs --format json and the method fam");
    if (arguments.derivatives && options.law == fam::Law::published)
      throw CLI::ValidationError("--derivatives", "the law published has none");
    if (!arguments.vtu_path.empty() && arguments.method == "elastica")
      throw CLI::ValidationError("--vtu", "the method elastica gives the tip alone");
    studies::refuse_overwriting({{"the scene", arguments.scene_path}},
                                {{"--svg", arguments.svg_path}, {"--vtu", arguments.vtu_path}});
    if (options.after_snap && arguments.method != "fam")
      throw CLI::ValidationError("--after-snap", "needs the method fam");
    if (solve->count("--twist-order") > 0 && options.law != fam::Law::published)
      throw CLI::ValidationError("--twist-order", "needs --law published");
  });
  return solve;
}

int run_solve(const SolveArguments& arguments, const MethodFactory& make_method) {
  const scene::Scene scene = scene::read_scene_file(arguments.scene_path);
  const std::unique_ptr<studies::Method> method = make_method(arguments);
  scene::Equilibrium result;
  const double first_solve_s = studies::seconds_of([&] { result = method->solve(scene); });
  const double time_us = result.converged() ? studies::time_us(method->bare_solve(scene), first_solve_s) : 0;
  if (result.converged() && !arguments.svg_path.empty()) {
    studies::write_file(arguments.svg_path, picture(scene, result, method->name()));
  }
  if (result.converged() && !arguments.vtu_path.empty()) {
    studies::write_file(arguments.vtu_path, to_vtu(scene, result));
  }
  if (arguments.format == "json") {
    const std::string json = scene::to_json(result, arguments.method, time_us);
    const bool adds = arguments.derivatives && result.converged();
    fmt::print("{}", adds ? with_derivatives(json, scene, arguments.fam) : json);
  } else if (result.converged()) {
    fmt::print("{}",
               arguments.format == "csv" ? scene::to_csv(result) : scene::to_text(result, method->name(), time_us));
  }
  if (result.converged()) return exit_solved;
  const std::string source = arguments.scene_path == "-" ? "(standard input)" : arguments.scene_path;
  fmt::print(stderr, "{}: {}: {}\n", source, scene::name(result.status), result.message);
  return exit_not_converged;
}

int run(CLI::App& app, int argc, char** argv, const std::function<int()>& work) {
  app.set_version_flag("--version", app.get_name() + " " FAM_VERSION, "Print the version and exit");
  try {
    app.parse(argc, argv);
    const int status = work();
    if (std::fflush(stdout) != 0) throw studies::OutputError("standard output: cannot be written");
    return status;
  } catch (const CLI::RequiredError& error) {  // a name that is misspelt, rather than that another one is missing
    const std::vector<std::string> unknown = app.remaining(true);
    unknown.empty() ? app.exit(error) : app.exit(CLI::ExtrasError(unknown));
    return exit_wrong_input;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_solved : exit_wrong_input;
  } catch (const scene::SceneError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exit_wrong_input;
  } catch (const std::filesystem::filesystem_error& error) {
    fmt::print(stderr, "{}: {}\n", error.path1().string(), error.code().message());
    return exit_wrong_input;
  } catch (const std::exception& error) {  // OutputError among them
    fmt::print(stderr, "{}\n", error.what());
    return exit_not_converged;
  }
}

}  // namespace apps
