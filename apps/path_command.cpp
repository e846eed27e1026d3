#include "apps/path_command.h"

#include "apps/vtu_file.h"
#include "fam/path.h"
#include "scene/path_file.h"
#include "studies/report/output_file.h"
#include "studies/report/path_chart.h"

#include <fmt/format.h>

#include <cstdio>

namespace apps {
namespace {

void write_rods(const std::string& path, const scene::PathRequest& request, const fam::Path& followed) {
  RodCollection rods(path);
  const std::vector<scene::PathPoint>& points = followed.points().points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    rods.add(i, scene::scene_at(request, points[i].parameter), followed.equilibrium(i),
             {{"parameter", points[i].parameter}, {"branch", points[i].branch}});
  }
  rods.write();
}

}  // namespace

CLI::App* add_path_command(CLI::App& app, PathArguments& arguments) {
  CLI::App* path = app.add_subcommand("path", "Follow the equilibria of a scene while one number of it changes");
  add_scene_and_options(path, arguments.path, arguments.fam, "Path file (JSON), or - for standard input");
  add_output_options(path, arguments.format, arguments.svg_path, "Write a picture of the path to this file");
  studies::add_file_option(path, "--pvd", arguments.pvd_path,
                           "Write the rods of the path for ParaView, and this file that lists them");
  path->callback([&arguments] {
    studies::refuse_overwriting({{"the path file", arguments.path}},
                                {{"--svg", arguments.svg_path}, {"--pvd", arguments.pvd_path}});
  });
  return path;
}

int run_path(const PathArguments& arguments) {
  const scene::PathRequest request = scene::read_path_file(arguments.path);
  const fam::Path followed = fam::Path::follow(request, arguments.fam);
  const scene::Path& path = followed.points();
  const std::string source = arguments.path == "-" ? "(standard input)" : arguments.path;
  if (!arguments.svg_path.empty() && !path.points.empty()) {
    const std::string title = request.scene.title.empty() ? "equilibrium path" : request.scene.title;
    const auto centreline_mm = [&](std::size_t point) { return followed.centreline_mm(point); };
    studies::write_file(arguments.svg_path,
                        studies::path_chart(path, centreline_mm, title, scene::name_of_parameter(request)));
  }
  if (!arguments.pvd_path.empty() && !path.points.empty()) write_rods(arguments.pvd_path, request, followed);
  if (arguments.format == "json") fmt::print("{}", scene::to_json(path));
  else if (!path.points.empty())
    fmt::print("{}", arguments.format == "csv" ? scene::to_csv(path) : scene::to_text(request, path));
  if (scene::is_complete(path.status)) return exit_solved;
  fmt::print(stderr, "{}: {}: {}\n", source, scene::name(path.status), path.message);
  return exit_not_converged;
}

}  // namespace apps
