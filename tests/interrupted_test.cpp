// Studies that are killed, cannot write, or run twice.
#include "commands.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <sstream>
#include <thread>

namespace {

namespace fs = std::filesystem;
using namespace commands;

// Small, and in it all methods: exact, FAM and finite elements.
const std::string study = "study2 --quick --output ";

bool is_compared(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.rfind("timing", 0) != 0 && name != "provenance.json";
}

// Without what was timed, which pages mark (studies/report/page.h).
std::string untimed(std::string text) {
  const std::string open = "<!--t-->", close = "<!--/t-->";
  for (std::size_t from; (from = text.find(open)) != std::string::npos;) {
    const std::size_t end = text.find(close, from);
    if (end == std::string::npos) return text;
    text.erase(from, end + close.size() - from);
  }
  return text;
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = contents(entry.path());
  }
  return files;
}

const std::map<std::string, std::string>& whole() {
  static const std::map<std::string, std::string> files = [] {
    EXPECT_EQ(run(fam_studies, study + (scratch() / "whole").string()).exit_status, 0);
    return files_in(scratch() / "whole");
  }();
  return files;
}

// Of a folder that another process writes to: nothing is opened, and what vanishes meanwhile is no error.
std::size_t count_of_files(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator file(folder, error); file != fs::end(file); file.increment(error)) {
    if (file->path().has_extension() && file->path().extension() != ".partial") ++count;
  }
  return count;
}

// Starts the study and kills it as soon as it has left so many files (0: at once), or has ended.
void kill_after(std::size_t files, const fs::path& folder) {
  const pid_t child = fork();
  if (child == 0) {
    std::freopen("/dev/null", "w", stderr);
    execl(fam_studies.c_str(), "fam-studies", "study2", "--quick", "--output", folder.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (count_of_files(folder) >= files) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

TEST(Interrupted, AKilledStudyLeavesWholeFilesOnly) {
  ASSERT_GT(whole().size(), 3u);
  const fs::path folder = scratch() / "killed";
  int found = 0;
  for (std::size_t files = 0; files < whole().size(); ++files) {
    fs::remove_all(folder);
    kill_after(files, folder);
    for (const auto& [name, text] : files_in(folder)) {
      if (fs::path(name).extension() == ".partial") continue;
      ASSERT_EQ(whole().count(name), 1u) << name;
      EXPECT_EQ(text.back(), '\n') << name;
      if (is_compared(name)) {
        EXPECT_EQ(untimed(text), untimed(whole().at(name))) << name << ", killed after " << files << " files";
      }
      ++found;
    }
  }
  EXPECT_GT(found, 0);
  fs::create_directories(folder / "study2");
  // What was left behind does not disturb the next run, which clears it.
  std::ofstream(folder / "study2" / "errors.csv.partial") << "half a li";
  EXPECT_EQ(run(fam_studies, study + folder.string()).exit_status, 0);
  EXPECT_EQ(files_in(folder).size(), whole().size());
}

TEST(Interrupted, TwoRunsAreTheSameWithAnyNumberOfThreads) {
  const fs::path folder = scratch() / "threads";
  const std::string two = "DEAL_II_NUM_THREADS=2 OMP_NUM_THREADS=2 OPENBLAS_NUM_THREADS=2 ";
  ASSERT_EQ(run(two + fam_studies, study + folder.string()).exit_status, 0);
  for (const auto& [name, text] : files_in(folder)) {
    if (is_compared(name)) {
      EXPECT_EQ(untimed(text), untimed(whole().at(name))) << name;
    }
  }
}

// But for the lines that tell the progress of the study.
void expect_one_error(const Outcome& outcome, const std::string& text) {
  EXPECT_EQ(outcome.exit_status, 1) << outcome.err;
  std::istringstream lines(outcome.err);
  std::vector<std::string> errors;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("study2: ", 0) != 0) errors.push_back(line);
  }
  ASSERT_EQ(errors.size(), 1u) << outcome.err;
  EXPECT_NE(errors[0].find(text), std::string::npos) << outcome.err;
}

TEST(Interrupted, AFolderThatCannotBeWrittenIsOneError) {
  const fs::path file = scratch() / "a_file";
  std::ofstream(file) << "in the way";
  expect_one_error(run(fam_studies, study + file.string()), "cannot be written: Not a directory");
}

// A file may not grow beyond a few blocks, as on a disk that is full.
TEST(Interrupted, AFullDiskIsOneError) {
  const fs::path folder = scratch() / "full";
  fs::create_directories(folder);
  const std::string limited = "trap '' XFSZ; ulimit -f 1; exec " + fam + " solve " + case_file("study1/P1_follower") +
                              " --svg " + (folder / "shape.svg").string();
  expect_one_error(run("sh", "-c \"" + limited + "\""), "cannot be written");
  EXPECT_TRUE(fs::is_empty(folder));
  const Outcome outcome = run("sh", "-c \"" + fam + " solve " + case_file("study1/P1_follower") + " >/dev/full\"");
  expect_one_error(outcome, "standard output: cannot be written");
  EXPECT_EQ(run(fam, "solve " + case_file("study1/P1_follower") + " --svg /dev/full").exit_status, 1);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace
