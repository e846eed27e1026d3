// The documents say what the programs do: every example in them is run, every option, status and field is in them.
//
// Fenced blocks of README.md and docs/*.md, by their info string, in the order of the page, in one scratch folder:
//   json scene [name]   written to `name` (scene.json); `fam solve` must read and solve it
//   json path name, json estimation name, json statistic name   written to `name`, for the commands that follow
//   json wrong          `fam solve wrong.json` must refuse it with the line in the `text` block that follows
//   sh                  each line is run with the programs on PATH; its exit status is 0, or as `# exit status 2` says;
//                       what they print is compared with the `text` block that follows, if one does; ... in it stands
//                       for any text
//   cpp, python, cmake  left alone: tests/library_page_test.cpp builds and runs them
// Rows `| path | value | rule |` of a table headed "refused at": the first scene of the page with that value at that
// path, "(missing)" for none, is refused with `wrong.json: path = value: rule`.
#include "commands.h"
#include "page_blocks.h"

#include "scene/equilibrium.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <regex>
#include <set>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using namespace commands;
using namespace page_blocks;
using nlohmann::json;

const fs::path project = PROJECT_FOLDER;

// The examples of one page, run.
class Examples {
 public:
  explicit Examples(const fs::path& page) : page_(page) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const std::string text = contents(page);
    const std::vector<Block> blocks = blocks_of(text);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const std::string& info = blocks[i].info;
      const bool asks = info == "sh" || info == "json wrong" || info == "cpp" || info == "python";
      const bool answered =
          asks && i + 1 < blocks.size() && blocks[i + 1].info == "text" && blocks[i + 1].follows_directly;
      run(blocks[i], answered ? &blocks[i + 1] : nullptr);
      if (answered) ++i;
    }
    run_refusals(text);
  }

  int scenes = 0, wrong = 0, commands = 0, compared = 0, refused = 0;
  std::set<std::string> refused_fields;
  std::vector<std::string> problems;

  std::string all_problems() const {
    std::string all;
    for (const std::string& problem : problems) all += problem + "\n";
    return all;
  }

 private:
  void problem(int line, const std::string& what) {
    problems.push_back(page_.filename().string() + ":" + std::to_string(line) + ": " + what);
  }

  void run(const Block& block, const Block* answer) {
    static const std::set<std::string> other = {"cpp", "python", "cmake"};  // of the library's page: library_page_test
    if (block.info.rfind("json scene", 0) == 0) {
      run_scene(block);
    } else if (block.info.rfind("json path ", 0) == 0 || block.info.rfind("json estimation ", 0) == 0 ||
               block.info.rfind("json statistic ", 0) == 0) {
      std::ofstream(folder_ / block.info.substr(block.info.rfind(' ') + 1)) << block.text;
    } else if (block.info == "json wrong") {
      ++wrong;
      if (!answer) return problem(block.line, "a wrong scene without the line that it is refused with");
      refuse(block.line, block.text, answer->text);
    } else if (block.info == "sh") {
      run_lines(block, answer);
    } else if (other.count(block.info) == 0) {
      problem(block.line, "no test knows what to do with a block of \"" + block.info + "\"");
    }
  }

  // Standard output and error of a line of sh.
  std::string shell(const std::string& line, int& exit_status) const {
    std::ofstream(scratch() / "line.sh") << "cd '" << folder_.string() << "'\n" << line << "\n";
    const std::string out = (scratch() / "out").string();
    exit_status = WEXITSTATUS(
        std::system(("sh '" + (scratch() / "line.sh").string() + "' >'" + out + "' 2>&1 </dev/null").c_str()));
    return contents(out);
  }

  void run_scene(const Block& block) {
    ++scenes;
    const std::string name = block.info.size() > 11 ? block.info.substr(11) : "scene.json";
    std::ofstream(folder_ / name) << block.text;
    if (first_scene_.empty()) first_scene_ = block.text;
    int status = 0;
    const std::string printed = shell("fam solve " + name, status);
    if (status != 0) problem(block.line, "not solved: " + printed);
  }

  void refuse(int line, const std::string& scene, const std::string& expected) {
    std::ofstream(folder_ / "wrong.json") << scene;
    int status = 0;
    const std::string printed = shell("fam solve wrong.json", status);
    if (status != 2) problem(line, "not refused, exit status " + std::to_string(status));
    if (!matches(expected, printed)) problem(line, "refused with\n" + printed + "in place of\n" + expected);
  }

  void run_lines(const Block& block, const Block* answer) {
    static const std::regex told("# exit status (\\d+)");
    std::string printed;
    for (const std::string& line : lines_of(block.text)) {
      if (line.empty() || line[0] == '#') continue;
      ++commands;
      std::smatch match;
      const int expected = std::regex_search(line, match, told) ? std::stoi(match[1]) : 0;
      int status = 0;
      const std::string here = shell(line, status);
      printed += here;
      if (status != expected)
        problem(block.line, "`" + line + "` ends with exit status " + std::to_string(status) + ":\n" + here);
    }
    if (!answer) return;
    ++compared;
    if (!matches(answer->text, printed)) problem(block.line, "prints\n" + printed + "in place of\n" + answer->text);
  }

  void run_refusals(const std::string& text) {
    static const std::regex row("\\| `([^`]+)` \\| `([^`]+)` \\| (.+) \\|"), step("\\w+");
    bool in_table = false;
    int number = 0;
    for (const std::string& line : lines_of(text)) {
      ++number;
      in_table = in_table ? line.rfind("|", 0) == 0 : line.rfind("| refused at |", 0) == 0;
      std::smatch cell;
      if (!in_table || line.rfind("| refused at", 0) == 0 || line.rfind("|---", 0) == 0) continue;
      if (!std::regex_match(line, cell, row)) {
        problem(number, "not a row `path`, `value`, rule");
        continue;
      }
      const std::string path = cell[1], value = cell[2], rule = cell[3];
      std::string pointer, field;
      for (std::sregex_iterator at(path.begin(), path.end(), step), end; at != end; ++at) {
        field = at->str();
        pointer += "/" + field;
      }
      json scene = json::parse(first_scene_);
      if (value == "(missing)") scene.at(json::json_pointer(pointer).parent_pointer()).erase(field);
      else scene[json::json_pointer(pointer)] = json::parse(value);
      ++refused;
      refused_fields.insert(field);
      refuse(number, scene.dump(), "wrong.json: " + path + " = " + value + ": " + rule + "\n");
    }
  }

  fs::path page_, folder_ = scratch() / "examples";
  std::string first_scene_;
};

void put_programs_on_path() {
  const std::string folder = fs::path(fam).parent_path().string();
  const std::string path = std::getenv("PATH");
  if (path.rfind(folder, 0) != 0) setenv("PATH", (folder + ":" + path).c_str(), 1);
}

class Docs : public testing::Test {
 protected:
  void SetUp() override { put_programs_on_path(); }
};

TEST_F(Docs, ExamplesOfTheReadme) {
  const Examples examples(project / "README.md");
  EXPECT_EQ(examples.all_problems(), "");
  EXPECT_GE(examples.scenes, 1);
  EXPECT_GE(examples.commands, 3);
}

TEST_F(Docs, ExamplesOfTheSceneFormat) {
  const Examples examples(project / "docs/scene_format.md");
  EXPECT_EQ(examples.all_problems(), "");
  EXPECT_GE(examples.scenes, 5);
  EXPECT_GE(examples.wrong, 5);
  EXPECT_GE(examples.refused, 30);
  EXPECT_GE(examples.compared, 1);
}

TEST_F(Docs, ExamplesOfTheCommands) {
  const Examples examples(project / "docs/commands.md");
  EXPECT_EQ(examples.all_problems(), "");
  EXPECT_GE(examples.commands, 20);
  EXPECT_GE(examples.compared, 10);
}

TEST_F(Docs, ExamplesOfTheOtherPages) {
  int pages = 0;
  for (const auto& entry : fs::directory_iterator(project / "docs")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".md" || name == "scene_format.md" || name == "commands.md") continue;
    EXPECT_EQ(Examples(entry.path()).all_problems(), "");
    ++pages;
  }
  RecordProperty("pages", pages);
}

// A page with one fault of each kind: each is found, and nothing else.
TEST_F(Docs, WrongExamplesFail) {
  const std::string scene =
      R"({"rod":{"sections":[{"length_mm":40,"stiffness":{"bending_Nmm2":1500,"torsion_Nmm2":1000}}]}})";
  const std::string table = "| refused at | value | because |\n|---|---|---|\n";
  const auto block = [](const std::string& info, const std::string& text) {
    return "```" + info + "\n" + text + "\n```\n";
  };
  const std::string right = block("json scene", scene);
  const auto faults = [&](const std::string& text) {
    const fs::path page = scratch() / "page.md";
    std::ofstream(page) << right << text;
    return Examples(page).problems.size();
  };
  EXPECT_EQ(faults(""), 0u);
  EXPECT_EQ(faults(block("json scene", "{")), 1u);
  EXPECT_EQ(faults(block("json wrong", scene) + block("text", "wrong.json: refused")), 2u);  // accepted, other words
  EXPECT_EQ(faults(block("json wrong", "[]") + block("text", "wrong.json: refused")), 1u);
  EXPECT_EQ(faults(block("json wrong", "[]")), 1u);
  EXPECT_EQ(faults(block("json wrong", "[]") + block("text", "wrong.json: (top level) = []: must be an object")), 0u);
  EXPECT_EQ(faults(block("json", scene)), 1u);
  EXPECT_EQ(faults(block("text", "alone")), 1u);
  EXPECT_EQ(faults("```sh\ntrue\n"), 1u);  // without its end
  EXPECT_EQ(faults(block("sh", "false")), 1u);
  EXPECT_EQ(faults(block("sh", "true # exit status 1")), 1u);
  EXPECT_EQ(faults(block("sh", "fam solve no.json # exit status 2")), 0u);
  EXPECT_EQ(faults(block("sh", "echo 1 2 3") + block("text", "1 ... 3")), 0u);
  EXPECT_EQ(faults(block("sh", "echo 1 2 3") + block("text", "1 ... 4")), 1u);
  EXPECT_EQ(faults(block("sh", "echo 1 2 3") + block("text", "1 2")), 1u);
  EXPECT_EQ(faults(block("sh", "echo 1 2 3") + "words between\n" + block("text", "1 2 3")), 1u);
  EXPECT_EQ(faults(table + "| `rod.sections[0].length_mm` | `-4` | must be > 0 |\n"), 0u);
  EXPECT_EQ(faults(table + "| `rod.sections[0].length_mm` | `-4` | must be > 1 |\n"), 1u);
  EXPECT_EQ(faults(table + "| `rod.sections[0].length_mm` | `4` | must be > 0 |\n"), 2u);
  EXPECT_EQ(faults(table + "| rod.sections[0].length_mm | -4 | must be > 0 |\n"), 1u);
}

std::set<std::string> all_matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) found.insert((*at)[1]);
  return found;
}

// What `--help` prints, of the command and of all its subcommands.
std::string all_help(const std::string& command, const std::string& subcommand = "") {
  const std::string help = run(command, subcommand + " --help").out;
  std::string all = help;
  const std::size_t list = help.find("Subcommands:");
  if (list == std::string::npos) return all;
  for (const std::string& name : all_matches(help.substr(list), "\n  ([a-z][a-z0-9-]*)"))
    all += all_help(command, subcommand + " " + name);
  return all;
}

// Options and the names that they take, subcommands: those of the page are those of the programs.
TEST_F(Docs, CommandsPageNamesWhatThereIs) {
  const std::string page = contents(project / "docs/commands.md");
  const std::string help = all_help(fam) + all_help(fam_studies);
  const std::set<std::string> options = all_matches(help, "(--[a-z][a-z-]*)");
  EXPECT_GE(options.size(), 15u);
  EXPECT_EQ(all_matches(page, "[^-](--[a-z][a-z-]*)"), options);
  int names = 0;
  for (const std::string& list : all_matches(help, "\\{([^}]*)\\}")) {
    for (const std::string& name : all_matches(list, "([^,]+)")) {
      EXPECT_NE(page.find(name), std::string::npos) << name;
      ++names;
    }
  }
  EXPECT_GE(names, 15);
  const std::string top = run(fam_studies, "--help").out;
  const std::set<std::string> subcommands = all_matches(top.substr(top.find("Subcommands:")), "\n  ([a-z][a-z0-9-]*)");
  EXPECT_GE(subcommands.size(), 10u);
  for (const std::string& name : subcommands)
    EXPECT_TRUE(std::regex_search(page, std::regex("`(fam-studies )?" + name + "\\b"))) << name;
}

void collect_keys(const json& value, std::set<std::string>& keys) {
  for (const auto& [key, inner] : value.items()) {
    if (value.is_object()) keys.insert(key);
    if (inner.is_structured()) collect_keys(inner, keys);
  }
}

// Every status, every key of the JSON, every column of the CSV.
TEST_F(Docs, CommandsPageNamesWhatIsPrinted) {
  const std::string page = contents(project / "docs/commands.md");
  int statuses = 0;
  for (int i = 0; std::string(scene::name(static_cast<scene::Status>(i))) != "unknown"; ++i, ++statuses) {
    const std::string name = scene::name(static_cast<scene::Status>(i));
    EXPECT_NE(page.find("| `" + name + "` |"), std::string::npos) << name;
  }
  EXPECT_GE(statuses, 9);
  std::set<std::string> keys;
  for (const std::string& scene : {case_file("study1/S4_follower"), case_file("study2/study2_gravity_z")}) {
    for (const std::string method : {"fam", "fem", "exact", "rk4"}) {
      const Outcome outcome = run(fam_studies, "solve " + scene + " --format json --method " + method);
      collect_keys(json::parse(outcome.out), keys);
    }
  }
  EXPECT_GE(keys.size(), 20u);
  for (const std::string& key : keys) EXPECT_NE(page.find("`" + key + "`"), std::string::npos) << key;
  const std::string csv = run(fam, "solve " + case_file("study1/S4_follower") + " --format csv").out;
  EXPECT_NE(page.find(csv.substr(0, csv.find('\n'))), std::string::npos);
}

// Constants that the page gives, as `name = value`: one of that name and value stands in the sources.
TEST_F(Docs, ConstantsAreThoseOfTheSources) {
  std::string sources;
  for (const std::string folder : {"scene", "fam", "fem_reference", "exact_reference"}) {
    for (const auto& file : fs::directory_iterator(project / folder)) sources += contents(file.path());
  }
  sources.erase(std::remove(sources.begin(), sources.end(), '\''), sources.end());
  const std::set<std::string> constants =
      all_matches(contents(project / "docs/commands.md"), "`(\\w+ = [0-9][0-9.e-]*)`");
  EXPECT_GE(constants.size(), 10u);
  for (const std::string& constant : constants)
    EXPECT_TRUE(std::regex_search(sources, std::regex("\\b" + constant + "[;,]"))) << constant;
}

// "10 000" for 10000.
std::string grouped(int number) {
  std::string digits = std::to_string(number);
  for (int place = static_cast<int>(digits.size()) - 3; place > 0; place -= 3)
    digits.insert(static_cast<std::size_t>(place), " ");
  return digits;
}

TEST_F(Docs, LimitsAreThoseOfTheSources) {
  const std::string page = contents(project / "docs/scene_format.md");
  for (const std::string& limit :
       {grouped(scene::max_sections) + " of them", grouped(scene::max_loads) + " of them",
        "at most " + grouped(scene::max_tendon_offsets) + " different offsets",
        "at most " + grouped(static_cast<int>(scene::max_scene_file_bytes >> 20)) + " MiB and 16 levels of nesting"}) {
    EXPECT_NE(page.find(limit), std::string::npos) << limit;
  }
  const auto nested = [](std::size_t levels) {
    return run(fam, "solve -", std::string(levels, '[') + std::string(levels, ']')).err;
  };
  EXPECT_EQ(nested(16).find("nested too deeply"), std::string::npos);
  EXPECT_NE(nested(17).find("nested too deeply"), std::string::npos);
}

// Every field that the format's tables name is refused once, and every key that the program knows has its row.
TEST_F(Docs, SceneFormatPageNamesEveryField) {
  const fs::path path = project / "docs/scene_format.md";
  const std::string page = contents(path);
  const std::set<std::string> fields = all_matches(page, "\n\\| `(\\w+)` \\|");
  EXPECT_GE(fields.size(), 25u);
  const std::set<std::string> refused = Examples(path).refused_fields;
  for (const std::string& field : fields) EXPECT_EQ(refused.count(field), 1u) << field;
  int known = 0;
  for (const std::string& list : all_matches(page, "unknown key; known here: ([a-zA-Z0-9_, ]*)")) {
    for (const std::string& key : all_matches(list, "(\\w+)")) {
      EXPECT_EQ(fields.count(key), 1u) << key;
      ++known;
    }
  }
  EXPECT_GE(known, 30);
}

// The scenes of the page are those of its folder, and solved.
TEST_F(Docs, RobotsPageNamesEveryScene) {
  const fs::path folder = project / "studies/cases/robots";
  std::set<std::string> scenes;
  for (const auto& file : fs::directory_iterator(folder)) {
    if (file.path().extension() != ".json") continue;
    scenes.insert(file.path().stem().string());
    EXPECT_EQ(run(fam, "solve '" + file.path().string() + "'").exit_status, 0) << file.path();
  }
  EXPECT_GE(scenes.size(), 12u);
  EXPECT_EQ(all_matches(contents(folder / "README.md"), "\n\\| `(\\w+)` \\|"), scenes);
}

// "0.03" for 0.0261 and two decimals.
std::string rounded(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

// What the README says of Study I, from the gates that the tests hold the laws to.
TEST_F(Docs, ReadmeGivesTheErrorsOfStudy1) {
  const auto errors_mm = [](const std::string& law, const std::string& arcs, char set) {
    std::vector<double> errors;
    for (const support::Row& row : support::read_csv("study1_gates.csv")) {
      if (row.at("law") == law && row.at("arcs") == arcs && row.at("model") == "kirchhoff" && row.at("case")[0] == set)
        errors.push_back(support::number(row, "measured_mm"));
    }
    EXPECT_EQ(errors.size(), 8u);
    std::sort(errors.begin(), errors.end());
    return errors;
  };
  const auto median = [](const std::vector<double>& v) { return (v[3] + v[4]) / 2; };
  const std::vector<double> plane = errors_mm("published", "12", 'P'), space = errors_mm("published", "12", 'S');
  std::string page = contents(project / "README.md");
  std::replace(page.begin(), page.end(), '\n', ' ');
  const std::string typical = rounded(median(plane), 2) + " mm in the plane and " + rounded(median(space), 1) +
                              " mm in space on the median case";
  EXPECT_TRUE(std::regex_search(page, std::regex(std::regex_replace(typical, std::regex(" "), " +")))) << typical;
  const std::string worst = "(" + rounded(plane.back(), 2) + " and " + rounded(space.back(), 1) + " mm on the worst)";
  EXPECT_NE(page.find(worst), std::string::npos) << worst;
  for (const char set : {'P', 'S'}) EXPECT_LT(errors_mm("sixth_order", "4", set).back(), 1.05e-3);
}

// Links lead somewhere, and what stands in the words of these pages as a path in the project is one.
TEST_F(Docs, LinksAndPathsExist) {
  int links = 0, paths = 0;
  for (const std::string name :
       {"README.md", "CONTRIBUTING.md", "docs/scene_format.md", "docs/commands.md", "docs/library.md",
        "docs/paraview.md", "docs/theory.md", "docs/estimation.md", "docs/population.md", "docs/frames.svg",
        "docs/library.svg", "studies/cases/robots/README.md"}) {
    ASSERT_TRUE(fs::exists(project / name)) << name;
    const std::string page = contents(project / name);
    const fs::path folder = (project / name).parent_path();
    for (const std::string& link : all_matches(page, "\\]\\(([^):#]+)[#)]")) {
      EXPECT_TRUE(fs::exists(folder / link)) << name << ": " << link;
      ++links;
    }
    for (const std::string& there :
         all_matches(page,
                     "`((?:apps|docs|scene|fam|fem_reference|exact_reference|studies|tests|results|cmake)/"
                     "[A-Za-z0-9_./]*)`")) {
      EXPECT_TRUE(fs::exists(project / there)) << name << ": " << there;
      ++paths;
    }
  }
  EXPECT_GE(links, 10);
  EXPECT_GE(paths, 15);
}

}  // namespace
