#include "studies/random/blocks.h"

#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>

#include <fcntl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace studies {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t block = 500, finite_elements_every = 100;
// Of processor time for one scene. Of 10 000 some take five seconds, in which 7 to 16 ended with the machine's load.
constexpr unsigned work_limit_s = 20;

std::vector<RandomOutcome> read_outcomes(const fs::path& path) {
  std::vector<RandomOutcome> list;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) list.push_back(from_line(line));
  return list;
}

bool by_finite_elements(std::uint64_t seed) {
  return seed % finite_elements_every == 0;
}

// Solves seeds from..to-1 in a process of its own, adding to the file, until a scene takes too long.
void work(std::uint64_t from, std::uint64_t to, const fs::path& path) {
  std::ofstream file(path, std::ios::app);
  for (std::uint64_t seed = from; seed < to; ++seed) {
    const itimerval limit{{0, 0}, {work_limit_s, 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);
    random_outcomes(seed, by_finite_elements(seed), [&](const RandomOutcome& o) {
      file << to_line(o) << '\n';
      file.flush();
    });
  }
  std::_Exit(0);
}

// The solve that a process was at when it ended: the one after the last in the file.
RandomOutcome unfinished(const std::vector<RandomOutcome>& so_far, std::uint64_t first) {
  if (so_far.empty()) return {first, "any", "exact", "", 0, 0};
  RandomOutcome next = so_far.back();
  next.error = next.estimate = 0;
  if (next.method == "exact") {
    next.method = "fam";
  } else if (next.method == "fam" && by_finite_elements(next.seed)) {
    next.method = "fem";
  } else {
    ++next.seed;
    next.method = "exact", next.loads = "any";
  }
  return next;
}

void run_block(std::uint64_t first, const fs::path& folder) {
  const fs::path done = folder / fmt::format("{:09}.txt", first), part = fs::path(done).replace_extension(".part");
  if (fs::exists(done)) return;
  const int lock = open(part.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0644);
  if (lock < 0) return;  // another process has it; a stale one is to be removed by hand
  close(lock);
  for (std::uint64_t seed = first; seed < first + block;) {
    const pid_t child = fork();
    if (child == 0) work(seed, first + block, part);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) break;
    RandomOutcome stopped = unfinished(read_outcomes(part), seed);
    stopped.outcome = WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF ? "work limit" : "crash";
    std::ofstream(part, std::ios::app) << to_line(stopped) << '\n';
    seed = stopped.seed + 1;
  }
  fs::rename(part, done);
}

// failures.csv: the head line, then outcomes.
std::set<std::uint64_t> listed_seeds(const fs::path& path) {
  std::set<std::uint64_t> seeds;
  std::ifstream file(path);
  std::string line;
  for (std::getline(file, line); std::getline(file, line);) seeds.insert(from_line(line).seed);
  return seeds;
}

// All blocks from..to-1 that no other process has taken.
void run_range(std::uint64_t from, std::uint64_t to, const fs::path& folder, Progress& progress) {
  for (std::uint64_t seed = from; seed < to; seed += block) {
    progress.at((seed - from) / block, fmt::format("seeds {} to {}", seed, seed + block - 1));
    run_block(seed, folder);
  }
}

}  // namespace

std::vector<RandomOutcome> all_outcomes(const std::filesystem::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".txt") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<RandomOutcome> all;
  for (const fs::path& file : files) {
    const std::vector<RandomOutcome> list = read_outcomes(file);
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

void second_opinions(const std::filesystem::path& folder) {
  const std::vector<RandomOutcome> all = all_outcomes(folder);
  std::ofstream file(folder / "second.txt");
  for (const RandomOutcome& o : all) {
    if (o.method != "fam" || o.outcome.rfind("wrong", 0) != 0 || o.outcome == "wrong but flagged") continue;
    file << to_line(second_opinion(o.seed)) << std::endl;
  }
}

int check_outcomes(const std::filesystem::path& folder, const std::filesystem::path& list) {
  const std::set<std::uint64_t> known = listed_seeds(list);
  int unknown = 0;
  for (const RandomOutcome& o : all_outcomes(folder)) {
    const bool slow = o.outcome == "work limit";  // depends on the machine
    if (!is_listed(o) || slow || known.count(o.seed) != 0) continue;
    fmt::print(stderr, "not in {}: {}\n", list.string(), to_line(o));
    ++unknown;
  }
  return unknown == 0 ? 0 : 1;
}

void run_blocks(std::uint64_t from, std::uint64_t to, const std::filesystem::path& folder, Progress::Style style) {
  fs::create_directories(folder);
  const pid_t helper = fork();
  Progress progress("random scenes", (to - from + block - 1) / block, helper == 0 ? Progress::Style::quiet : style);
  run_range(from, to, folder, progress);
  if (helper == 0) std::_Exit(0);
  waitpid(helper, nullptr, 0);
}

}  // namespace studies
