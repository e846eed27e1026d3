#include "studies/third_party/command.h"

#include "scene/scene_file.h"
#include "studies/report/output_file.h"

#include <fmt/format.h>

namespace studies {

CLI::App* add_export_command(CLI::App& app, ExportArguments& arguments) {
  CLI::App* command = app.add_subcommand("export", "Write a scene as a keyword deck of another program");
  command->add_option("scene", arguments.scene, "Scene file (JSON), or - for standard input")->required();
  static const std::map<std::string, DeckFormat> formats = {{"abaqus", DeckFormat::abaqus},
                                                            {"calculix", DeckFormat::calculix}};
  command
      ->add_option_function<std::string>(
          "--format", [&arguments](const std::string& name) { arguments.format = formats.at(name); },
          "Whose beam elements: abaqus or calculix")
      ->check(CLI::IsMember(formats))
      ->required();
  add_file_option(command, "--output", arguments.output, "File to write (default: -, standard output)");
  command->add_option("--elements", arguments.elements, "Number of elements (default: 50)")
      ->check(CLI::Range(1, 100'000));
  command->callback([&arguments] {
    refuse_overwriting({{"the scene", arguments.scene}}, {{"--output", arguments.output}});
  });
  return command;
}

int run_export(const ExportArguments& arguments) {
  const std::string source = arguments.scene == "-" ? "(standard input)" : arguments.scene;
  const std::string text = deck(scene::read_scene_file(arguments.scene), source, arguments.format, arguments.elements);
  if (arguments.output == "-") fmt::print("{}", text);
  else write_file(arguments.output, text);
  return 0;
}

}  // namespace studies
