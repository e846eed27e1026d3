#include "studies/report/output_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace studies {

void write_file(const std::filesystem::path& path, const std::string& text) {
  const auto fail = [&](const std::string& reason) {
    throw OutputError(path.string() + ": cannot be written: " + reason);
  };
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) fail(error.message());

  // A device or a pipe is written to as it is.
  const bool in_place = std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error);
  std::filesystem::path partial = path;
  if (!in_place) partial += ".partial";
  errno = 0;
  {
    std::ofstream file(partial, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
      const std::string reason = std::strerror(errno);
      if (!in_place) std::filesystem::remove(partial, error);
      fail(reason);
    }
  }
  if (in_place) return;
  std::filesystem::rename(partial, path, error);
  if (error) fail(error.message());
}

void make_folder(const std::filesystem::path& path) {
  const std::filesystem::path probe = path / ".probe";
  write_file(probe, "");
  std::filesystem::remove(probe);
}

}  // namespace studies
