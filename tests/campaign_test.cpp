// Campaigns and sweeps: the same files from any number of processes, killed or not; one line where nothing can be
// written.
#include "commands.h"
#include "studies/campaign/summary.h"
#include "studies/campaign/tally.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <random>
#include <sstream>
#include <thread>

namespace {

namespace fs = std::filesystem;
using namespace commands;
using studies::SceneOutcome;
using studies::Tally;

// More processes than cores, and by root in a container.
const std::string mpirun = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n ";
const std::string of_random = " campaign random --scenes 120 --seed 3 --chunk 5 --quiet --output ";

std::map<std::string, std::string> compared(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && name != "timing.csv" && name != "manifest.json")
      files[name] = contents(entry.path());
  }
  return files;
}

const std::map<std::string, std::string>& alone() {
  static const std::map<std::string, std::string> files = [] {
    EXPECT_EQ(run(fam_studies, of_random + (scratch() / "alone").string()).exit_status, 0);
    return compared(scratch() / "alone");
  }();
  return files;
}

TEST(Campaign, IsTheSameFromAnyNumberOfProcesses) {
  ASSERT_GE(alone().size(), 24u + 4u);  // chunks and tables
  for (const std::string n : {"1", "2", "4"}) {
    const fs::path folder = scratch() / ("ranks" + n);
    const Outcome outcome = run(mpirun + n + " " + fam_studies, of_random + folder.string());
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    EXPECT_EQ(compared(folder), alone()) << n;
  }
}

// The processes that run the campaign: this one's child, or mpirun's children.
std::vector<pid_t> workers_of(pid_t parent) {
  std::vector<pid_t> workers;
  std::ifstream children("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
  for (pid_t child; children >> child;) workers.push_back(child);
  return workers;
}

// What a folder holds that another process writes to; what vanishes meanwhile is no error.
std::size_t chunks_in(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator file(folder / "chunks", error); file != fs::end(file); file.increment(error))
    count += file->path().extension() == ".csv";
  return count;
}

// Starts the command and kills it, or one of its ranks, when it has written so many chunks and a while later.
void start_and_kill(const std::string& command, const fs::path& folder, std::size_t chunks, int later_ms,
                    bool one_rank) {
  const pid_t child = fork();
  if (child == 0) {
    std::freopen("/dev/null", "w", stderr);
    std::freopen("/dev/null", "w", stdout);
    execl("/bin/sh", "sh", "-c", ("exec env " + command).c_str(), nullptr);
    _exit(127);
  }
  const std::size_t before = chunks_in(folder);
  while (chunks_in(folder) < before + chunks) {
    if (waitpid(child, nullptr, WNOHANG) != 0) return;  // through before it could be killed
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(later_ms));
  const std::vector<pid_t> workers = workers_of(child);
  if (!one_rank) kill(child, SIGKILL);
  else if (!workers.empty()) kill(workers.back(), SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(Campaign, GoesOnWhereItWasKilled) {
  std::mt19937 random(20);
  for (const bool one_rank : {false, true}) {
    const fs::path folder = scratch() / (one_rank ? "killed_rank" : "killed");
    const std::string command = (one_rank ? mpirun + "2 " : "") + fam_studies + of_random + folder.string();
    for (int time = 0; time < 5; ++time)
      start_and_kill(command, folder, 1 + random() % 2, static_cast<int>(random() % 50), one_rank);
    std::size_t whole = 0;
    for (const auto& [name, text] : compared(folder)) {
      if (fs::path(name).extension() != ".csv") continue;
      ASSERT_TRUE(alone().count(name)) << name;
      EXPECT_EQ(text, alone().at(name)) << name;
      ++whole;
    }
    EXPECT_GE(whole, 5u);
    if (!one_rank) {
      EXPECT_LT(chunks_in(folder), 24u);  // the other rank may go on for a second until mpirun ends it
    }
    const Outcome outcome = run(mpirun + "3 " + fam_studies, of_random + folder.string());
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    EXPECT_EQ(compared(folder), alone());
  }
}

// As a power cut, a full quota or a copy in the wrong place leave them.
TEST(Campaign, DoesChunksAgainThatAreNotWhole) {
  const fs::path folder = scratch() / "damaged", chunks = folder / "chunks" / "000000";
  ASSERT_EQ(run(fam_studies, of_random + folder.string()).exit_status, 0);
  const auto chunk = [&](int k) { return chunks / fmt::format("{:012}-{:012}.csv", 5 * k, 5 * k + 4); };
  const std::string text = contents(chunk(2));
  std::ofstream(chunk(1)) << "";
  std::ofstream(chunk(2)) << text.substr(0, text.find('\n') + 1);
  std::ofstream(chunk(3)) << text.substr(0, text.size() - 1);
  std::ofstream(chunk(4)) << text;
  const Outcome outcome = run(fam_studies, of_random + folder.string());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(compared(folder), alone());
  // Without the manifest nobody knows whose they are.
  fs::remove(folder / "manifest.json");
  const Outcome unknown = run(fam_studies, of_random + folder.string());
  EXPECT_EQ(unknown.exit_status, 2);
  EXPECT_NE(unknown.err.find("manifest.json: (missing)"), std::string::npos) << unknown.err;
  EXPECT_EQ(compared(folder), alone());
}

TEST(Campaign, GrowsAndRefusesTheFolderOfAnother) {
  const fs::path folder = scratch() / "grown";
  const std::string start = " campaign random --seed 3 --chunk 5 --quiet --output " + folder.string() + " --scenes ";
  ASSERT_EQ(run(fam_studies, start + "45").exit_status, 0);
  ASSERT_EQ(run(fam_studies, start + "120").exit_status, 0);
  EXPECT_EQ(compared(folder), alone());
  for (const std::string other :
       {" campaign promise --scenes 20 --seed 3 --chunk 5", " campaign random --scenes 20 --chunk 5",
        " campaign random --scenes 20 --seed 3 --chunk 6"}) {
    const Outcome outcome = run(fam_studies, other + " --quiet --output " + folder.string());
    EXPECT_EQ(outcome.exit_status, 2) << other;
    EXPECT_NE(outcome.err.find("manifest.json"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(compared(folder), alone());
}

std::size_t partial_files(const fs::path& folder) {
  std::size_t count = 0;
  if (!fs::exists(folder)) return 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) count += entry.path().extension() == ".partial";
  return count;
}

TEST(Campaign, AFullDiskOrNoFolderIsOneError) {
  const fs::path file = scratch() / "in_the_way";
  std::ofstream(file) << "a file";
  const Outcome none = run(fam_studies, of_random + file.string());
  EXPECT_EQ(none.exit_status, 1);
  EXPECT_EQ(std::count(none.err.begin(), none.err.end(), '\n'), 1) << none.err;
  EXPECT_NE(none.err.find("cannot be written"), std::string::npos) << none.err;
  // A file may not grow beyond a block, as on a disk that is full.
  const fs::path limited = scratch() / "limited.sh";
  std::ofstream(limited) << "trap '' XFSZ\nulimit -f 1\nexec \"$@\"\n";
  const fs::path folder = scratch() / "full";
  const Outcome full = run("sh " + limited.string() + " " + fam_studies, of_random + folder.string());
  EXPECT_EQ(full.exit_status, 1) << full.err;
  EXPECT_NE(full.err.find("cannot be written: File too large"), std::string::npos) << full.err;
  EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
  EXPECT_EQ(partial_files(folder), 0u);
  // Of two ranks, which mpirun itself adds lines to.
  const fs::path blocked = scratch() / "blocked";
  fs::create_directories(blocked);
  std::ofstream(blocked / "chunks") << "in the way";
  const Outcome ranks = run(mpirun + "2 " + fam_studies, of_random + blocked.string());
  EXPECT_NE(ranks.exit_status, 0);
  EXPECT_NE(ranks.err.find("cannot be written: Not a directory"), std::string::npos) << ranks.err;
  EXPECT_EQ(partial_files(blocked), 0u);
}

TEST(Campaign, TalliesOfPartsAddUpInAnyOrder) {
  std::mt19937 random(5);
  std::vector<SceneOutcome> scenes;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const double value = std::pow(10.0, static_cast<double>(random() % 1000) / 50 - 12);
    scenes.push_back({i,
                      i % 3 ? "general" : "cables",
                      random() % 9 ? "right" : "wrong",
                      random() % 9 == 0,
                      {{"position", value}, {"wrench", random() % 5 ? value * value : 0.0}}});
  }
  const auto tally_of = [](const std::vector<SceneOutcome>& list) {
    Tally tally;
    for (const SceneOutcome& scene : list) tally.add(scene);
    return tally;
  };
  const std::string whole = tally_of(scenes).text();
  EXPECT_EQ(Tally::from_text(whole).text(), whole);
  std::shuffle(scenes.begin(), scenes.end(), random);
  Tally sum;
  for (std::size_t from = 0; from < scenes.size(); from += 50)
    sum.add(Tally::from_text(
        tally_of({scenes.begin() + static_cast<long>(from), scenes.begin() + static_cast<long>(from) + 50}).text()));
  EXPECT_EQ(sum.text(), whole);
  EXPECT_EQ(sum.scenes(), 300u);
  EXPECT_THROW(Tally::from_text("nonsense\n"), std::runtime_error);
  scenes.pop_back();
  EXPECT_NE(tally_of(scenes).text(), whole);
}

// Where a distance is not known, it is counted in the last bin and is not the worst.
TEST(Campaign, TheWorstAreNumbers) {
  Tally tally;
  for (std::uint64_t i = 0; i < 20; ++i)
    tally.add({i, "general", "no judge", true, {{"position", i < 15 ? HUGE_VAL : static_cast<double>(i)}}});
  const auto& worst = tally.worst().at("position");
  ASSERT_EQ(worst.size(), 5u);
  EXPECT_EQ(worst.begin()->index, 19u);
  EXPECT_EQ(tally.histograms().at("position").at(studies::bin_of(HUGE_VAL)), 15u);
  EXPECT_EQ(tally.failures().size(), 20u);
}

// Clopper and Pearson's one-sided bounds: none of n, 1 - 0.05^(1/n); one of ten 0.3942 (tables of the binomial
// distribution: P(X <= 1 | 10, 0.3942) = 0.05).
TEST(Campaign, RateBounds) {
  EXPECT_NEAR(studies::rate_bound(0, 1'000'000), 2.9957e-6, 1e-9);
  const double p = studies::rate_bound(1, 10);
  EXPECT_NEAR(std::pow(1 - p, 10) + 10 * p * std::pow(1 - p, 9), 0.05, 1e-9);
  EXPECT_EQ(studies::rate_bound(7, 7), 1);
  // Rare events, Poisson's: P(X <= 2 | 6.2958) = 0.05.
  EXPECT_NEAR(studies::rate_bound(2, 343'530), 6.2958 / 343'530, 1e-9);
}

const std::string swept = R"({ "scene": { "rod": { "sections": [ { "length_mm": 100, "stiffness":
  { "torsion_Nmm2": 1000, "bending_Nmm2": 1500 } } ] }, "loads": [
  { "kind": "force", "at": "tip", "frame": "fixed", "value_N": [0, 0.05, 0] } ] }, )";

fs::path sweep_file(const std::string& rest) {
  const fs::path path = scratch() / "sweep.json";
  std::ofstream(path) << swept << rest << "}";
  return path;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Sweep, IsTheSameFromAnyNumberOfProcessesAndKeepsItsSamples) {
  const std::string range = R"({"path": "loads[0].value_N[1]", "from": -0.1, "to": 0.1)";
  const std::string stiffness =
      R"({"path": "rod.sections[0].stiffness.bending_Nmm2", "from": 500, "to": 5000, "scale": "log")";
  const std::map<std::string, std::string> files{
      {"grid", "\"vary\": [" + range + ", \"points\": 9}, " + stiffness + ", \"points\": 5}]"},
      {"sobol", "\"sample\": \"sobol\", \"points\": 45, \"vary\": [" + range + "}, " + stiffness + "}]"},
      {"latin",
       "\"sample\": \"latin_hypercube\", \"points\": 45, \"seed\": 4, \"vary\": [" + range + "}, " + stiffness + "}]"}};
  for (const auto& [name, rest] : files) {
    const std::string command = " sweep " + sweep_file(rest).string() + " --chunk 7 --quiet --output ";
    ASSERT_EQ(run(fam_studies, command + (scratch() / name).string()).exit_status, 0);
    const Outcome two = run(mpirun + "2 " + fam_studies, command + (scratch() / (name + "2")).string());
    ASSERT_EQ(two.exit_status, 0) << two.err;
    EXPECT_EQ(compared(scratch() / name), compared(scratch() / (name + "2")));
    EXPECT_EQ(lines_of(contents(scratch() / name / "sweep.csv")).size(), 46u) << name;
    EXPECT_NE(contents(scratch() / name / "workspace.svg").find("45 points, 45 with an answer"), std::string::npos);
  }
  // The grid's corners, and in the hypercube one value in each of 45 equal parts.
  const auto grid = lines_of(contents(scratch() / "grid" / "sweep.csv"));
  EXPECT_EQ(grid[1].rfind("0,-0.1,500,converged,", 0), 0u) << grid[1];
  EXPECT_EQ(grid[45].rfind("44,0.1,5000,converged,", 0), 0u) << grid[45];
  std::vector<int> parts(45, 0);
  const auto latin = lines_of(contents(scratch() / "latin" / "sweep.csv"));
  for (std::size_t i = 1; i < latin.size(); ++i) {
    const double value = std::stod(latin[i].substr(latin[i].find(',') + 1));
    ++parts.at(static_cast<std::size_t>((value + 0.1) / 0.2 * 45));
  }
  EXPECT_EQ(std::count(parts.begin(), parts.end(), 1), 45);
}

// One point beside `fam solve` of the same scene.
TEST(Sweep, SaysWhatFamSolveSays) {
  const fs::path folder = scratch() / "one";
  const fs::path file =
      sweep_file(R"("vary": [{"path": "loads[0].value_N[1]", "from": 0.08, "to": 0.2, "points": 2}])");
  ASSERT_EQ(run(fam_studies, "sweep " + file.string() + " --quiet --output " + folder.string()).exit_status, 0);
  std::string scene = swept.substr(swept.find('{', 1));
  scene = scene.substr(0, scene.rfind(','));
  scene.replace(scene.find("0.05"), 4, "0.08");
  std::ofstream(scratch() / "one.json") << scene;
  const Outcome solved = run(fam, "solve " + (scratch() / "one.json").string() + " --format csv");
  ASSERT_EQ(solved.exit_status, 0) << solved.err << scene;
  const std::string tip = lines_of(solved.out).back();
  const auto number = [](const std::string& line, int cell) {
    std::istringstream cells(line);
    std::string text;
    for (int i = 0; i <= cell; ++i) std::getline(cells, text, ',');
    return std::stod(text);
  };
  const std::string point = lines_of(contents(folder / "sweep.csv"))[1];
  EXPECT_NEAR(number(point, 3), number(tip, 1), 1e-6) << tip;
  EXPECT_NEAR(number(point, 4), number(tip, 2), 1e-6) << tip;
}

TEST(Sweep, WrongFilesAreOneLineWithTheirPath) {
  const auto refused = [](const std::string& rest, const std::string& path) {
    const Outcome outcome = run(
        fam_studies, "sweep " + sweep_file(rest).string() + " --quiet --output " + (scratch() / "refused").string());
    EXPECT_EQ(outcome.exit_status, 2) << rest;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("sweep.json: " + path), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(scratch() / "refused"));
  };
  const std::string force = R"("path": "loads[0].value_N[1]")";
  refused(R"("vary": [])", "vary");
  refused(R"("vary": [{"path": "loads[1].value_N[1]", "from": 0, "to": 1, "points": 3}])", "vary[0].path");
  refused(R"("vary": [{"path": "loads[0].kind", "from": 0, "to": 1, "points": 3}])", "vary[0].path");
  refused("\"vary\": [{" + force + R"(, "from": 1, "to": 1, "points": 3}])", "vary[0].to");
  refused("\"vary\": [{" + force + R"(, "from": 0, "to": 1}])", "vary[0].points");
  refused("\"vary\": [{" + force + R"(, "from": 0, "to": 1, "points": 1}])", "vary[0].points");
  refused("\"vary\": [{" + force + R"(, "from": 0, "to": 1, "scale": "log", "points": 3}])", "vary[0].from");
  refused("\"vary\": [{" + force + R"(, "mean": 0, "sd": 1}])", "vary[0].mean");
  refused("\"sample\": \"sobol\", \"points\": 9, \"vary\": [{" + force + R"(, "mean": 0, "sd": 0}])", "vary[0].sd");
  refused("\"sample\": \"random\", \"points\": 9, \"vary\": [{" + force + R"(, "from": 0, "to": 1}])", "sample");
  refused("\"sample\": \"sobol\", \"vary\": [{" + force + R"(, "from": 0, "to": 1}])", "points");
  refused(R"("vary": [{"path": "rod.sections[0].length_mm", "from": -1, "to": 1, "points": 3}])", "vary[0]");
  refused("\"vary\": [{" + force + R"(, "from": 0, "to": 1, "points": 2}, {)" + force +
              R"(, "from": 0, "to": 1, "points": 2}])",
          "vary[1].path");
}

}  // namespace
