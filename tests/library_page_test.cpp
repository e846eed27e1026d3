// The code of docs/library.md, built and run as a user would.
//
// In the order of the page: the first `cmake` block is the project; a `cpp` block with a main() is its program, all
// others are one after the other what stands in it before its end. `python` blocks are one script. A `text` block that
// follows is what a block prints, "..." for any text.
#include "commands.h"
#include "page_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

namespace fs = std::filesystem;
using namespace commands;
using page_blocks::Block;

struct Code {
  std::string cmake, program, rest, python;
  std::string program_prints, python_prints;
  int blocks = 0;
};

Code code_of(const std::string& page) {
  Code code;
  const std::vector<Block> blocks = page_blocks::blocks_of(page);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& [line, info, text, direct] = blocks[i];
    if (info == "text" && i > 0) (blocks[i - 1].info == "cpp" ? code.program_prints : code.python_prints) += text;
    if (info == "text") continue;
    ++code.blocks;
    if (info == "cmake" && code.cmake.empty()) code.cmake = text;
    if (info == "cpp") (text.find("int main()") == std::string::npos ? code.rest : code.program) += text;
    if (info == "python") code.python += text;
  }
  return code;
}

int run_line(const std::string& line, std::string& output) {
  const fs::path out = scratch() / "out";
  const int status = std::system((line + " >" + out.string() + " 2>&1 </dev/null").c_str());
  output = contents(out);
  return WEXITSTATUS(status);
}

// Builds the program as the page's project, against an install prefix.
class Project {
 public:
  explicit Project(const std::string& cmake) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "CMakeLists.txt") << cmake;
    must(CMAKE " --install " BUILD_FOLDER " --prefix " + (folder_ / "prefix").string());
  }

  int run(const std::string& program, std::string& output) {
    std::ofstream(folder_ / "catheter.cpp") << program;
    const std::string folder = folder_.string(), build = folder + "/build";
    must(CMAKE " -S " + folder + " -B " + build + " -G Ninja -DCMAKE_PREFIX_PATH=" + folder + "/prefix");
    must(CMAKE " --build " + build);
    return run_line(build + "/catheter", output);
  }

 private:
  static void must(const std::string& line) {
    std::string output;
    ASSERT_EQ(run_line(line, output), 0) << line << "\n" << output;
  }
  fs::path folder_ = scratch() / "library_page";
};

const std::string page = contents(PROJECT_FOLDER "/docs/library.md");

TEST(LibraryPage, CppPrintsWhatThePageSays) {
  const Code code = code_of(page);
  ASSERT_GE(code.blocks, 6);
  Project project(code.cmake);
  std::string printed;
  EXPECT_EQ(project.run(code.program, printed), 0);
  EXPECT_TRUE(page_blocks::matches(code.program_prints, printed)) << printed;

  // The other blocks, where the program ends.
  std::string longer = code.program;
  longer.insert(longer.rfind('}'), code.rest);
  longer.insert(0, "#include <utility>\n#include <vector>\n");
  EXPECT_EQ(project.run(longer, printed), 0);
  const std::string batch = "\ny = ";
  EXPECT_NE(printed.find(batch), std::string::npos) << printed;
  EXPECT_EQ(printed.find("nan"), std::string::npos) << printed;
}

TEST(LibraryPage, PythonPrintsWhatThePageSays) {
  bool there = false;
  for (const auto& entry : fs::directory_iterator(BUILD_FOLDER))
    there |= entry.path().filename().string().starts_with("fam.cpython-");
  if (!there) GTEST_SKIP() << "the Python module was not built";
  const Code code = code_of(page);
  std::ofstream(scratch() / "page.py") << code.python;
  std::string printed;
  EXPECT_EQ(run_line("PYTHONPATH=" BUILD_FOLDER " " PYTHON " " + (scratch() / "page.py").string(), printed), 0);
  EXPECT_TRUE(page_blocks::matches(code.python_prints, printed)) << printed;
  EXPECT_EQ(code.python_prints, code.program_prints);
}

}  // namespace
