// Result files: written whole under another name and then renamed, so that none is ever half-written; and the options
// of commands that name files.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace studies {

class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Writes text to a file, making its folder; throws OutputError naming the path and the system's reason.
void write_file(const std::filesystem::path& path, const std::string& text);

// The same of several files of a folder (name to text): none is renamed before all are written.
void write_files(const std::filesystem::path& folder, const std::map<std::string, std::string>& files);

// Makes a folder that files can be written to; throws likewise.
void make_folder(const std::filesystem::path& path);

CLI::Option* add_file_option(CLI::App* command, const std::string& option, std::string& path, const std::string& what);

// Wrong usage: an output that would overwrite an input, or an output before it. Pairs of what is said and of the path,
// which may be empty or -.
using NamedFiles = std::vector<std::pair<std::string, std::string>>;
void refuse_overwriting(const NamedFiles& inputs, const NamedFiles& outputs);

}  // namespace studies
