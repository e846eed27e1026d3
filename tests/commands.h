// The commands as a user runs them.
#pragma once

#include "support.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace commands {

struct Outcome {
  int exit_status;
  std::string out, err;
};

inline std::filesystem::path scratch() {
  static const std::filesystem::path folder = [] {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("fam_command_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(path);
    return path;
  }();
  return folder;
}

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline Outcome run(const std::string& command, const std::string& arguments, const std::string& input = "") {
  std::ofstream(scratch() / "in") << input;
  const std::string line = command + " " + arguments + " <" + (scratch() / "in").string() + " >" +
                           (scratch() / "out").string() + " 2>" + (scratch() / "err").string();
  const int status = std::system(line.c_str());
  return {WEXITSTATUS(status), contents(scratch() / "out"), contents(scratch() / "err")};
}

inline std::string case_file(const std::string& name) {
  return std::string(STUDY_CASES_DIR) + "/" + name + ".json";
}

inline const std::string fam = FAM_COMMAND;
inline const std::string fam_studies = FAM_STUDIES_COMMAND;

}  // namespace commands
