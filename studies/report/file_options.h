// Options of commands that name files.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace studies {

CLI::Option* add_file_option(CLI::App* command, const std::string& option, std::string& path, const std::string& what);

// Wrong usage: an output that would overwrite an input, or an output before it. Pairs of what is said and of the path,
// which may be empty or -.
using NamedFiles = std::vector<std::pair<std::string, std::string>>;
void refuse_overwriting(const NamedFiles& inputs, const NamedFiles& outputs);

}  // namespace studies
