#include "studies/report/output_file.h"

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

namespace studies {
namespace {

[[noreturn]] void cannot_be_written(const std::filesystem::path& path, const std::string& reason) {
  throw OutputError(path.string() + ": cannot be written: " + reason);
}

// A device or a pipe is written to as it is.
bool is_written_in_place(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error);
}

std::filesystem::path partial_of(std::filesystem::path path) {
  if (!is_written_in_place(path)) path += ".partial";
  return path;
}

void write_partial(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) cannot_be_written(path, error.message());
  const std::filesystem::path partial = partial_of(path);
  errno = 0;
  std::ofstream file(partial, std::ios::binary);
  file << text;
  file.close();
  if (file) return;
  const std::string reason = std::strerror(errno);
  if (partial != path) std::filesystem::remove(partial, error);
  cannot_be_written(path, reason);
}

void rename_partial(const std::filesystem::path& path) {
  const std::filesystem::path partial = partial_of(path);
  if (partial == path) return;
  std::error_code error;
  std::filesystem::rename(partial, path, error);
  if (error) cannot_be_written(path, error.message());
}

// Devices and pipes, such as /dev/null, may be written to twice.
bool is_same_file(const std::string& a, const std::string& b) {
  if (a.empty() || a == "-" || b.empty() || b == "-") return false;
  std::error_code error;
  if (std::filesystem::exists(a, error) && !std::filesystem::is_regular_file(a, error)) return false;
  const auto canonical = [&](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  };
  const std::filesystem::path whole = canonical(a);
  return std::filesystem::equivalent(a, b, error) || (!whole.empty() && whole == canonical(b));  // empty: no name
}

}  // namespace

void write_file(const std::filesystem::path& path, const std::string& text) {
  write_partial(path, text);
  rename_partial(path);
}

void write_files(const std::filesystem::path& folder, const std::map<std::string, std::string>& files) {
  std::vector<std::filesystem::path> written;
  try {
    for (const auto& [name, text] : files) {
      write_partial(folder / name, text);
      written.push_back(folder / name);
    }
  } catch (const OutputError&) {
    std::error_code error;
    for (const std::filesystem::path& path : written) {
      if (!is_written_in_place(path)) std::filesystem::remove(partial_of(path), error);
    }
    throw;
  }
  for (const std::filesystem::path& path : written) rename_partial(path);
}

void make_folder(const std::filesystem::path& path) {
  const std::filesystem::path probe = path / ".probe";
  write_file(probe, "");
  std::filesystem::remove(probe);
}

CLI::Option* add_file_option(CLI::App* command, const std::string& option, std::string& path, const std::string& what) {
  const auto no_name = [](const std::string& text) { return text.empty() ? "must name a file" : ""; };
  return command->add_option(option, path, what)->check(CLI::Validator(no_name, "FILE"));
}

void refuse_overwriting(const NamedFiles& inputs, const NamedFiles& outputs) {
  NamedFiles before = inputs;
  for (const auto& [option, path] : outputs) {
    for (const auto& [name, other] : before) {
      if (is_same_file(path, other)) throw CLI::ValidationError(option, "names the file of " + name);
    }
    before.emplace_back(option, path);
  }
}

}  // namespace studies
