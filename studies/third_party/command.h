// `fam-studies export SCENE --format abaqus|calculix`
#pragma once

#include "studies/third_party/deck.h"

#include <CLI/CLI.hpp>

namespace studies {

struct ExportArguments {
  std::string scene, output = "-";
  DeckFormat format = DeckFormat::abaqus;
  int elements = default_deck_elements;
};

CLI::App* add_export_command(CLI::App& app, ExportArguments& arguments);
int run_export(const ExportArguments& arguments);

}  // namespace studies
