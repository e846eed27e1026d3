// Result files: written whole under another name and then renamed, so that none is ever half-written.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

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

}  // namespace studies
