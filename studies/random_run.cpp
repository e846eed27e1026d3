// random_scenes: runs the random scenes in blocks of 1000 seeds, each block's outcomes in a file of its own, so that a
// run resumes where it was stopped and several processes share one folder.
//   random_scenes scene SEED            one scene as a file on standard output
//   random_scenes run FROM TO FOLDER    FROM and TO multiples of the block; every 100th scene by finite elements too
//   random_scenes second FOLDER         a second opinion on every scene in which FAM is wrong and silent
//   random_scenes sum FOLDER OUTPUT     counts.csv, failures.csv and README.md from the blocks
//   random_scenes promise N OUTPUT      N scenes: is the tolerance kept (promise.h)?
//   random_scenes estimates N OUTPUT    N strips and heavy rods: is an estimate below half the error?
//   random_scenes check FOLDER LIST     fails on a listed outcome (random_study.h) of a seed that LIST does not hold
#include "scene/scene_file.h"
#include "studies/output_file.h"
#include "studies/promise.h"
#include "studies/random_scene.h"
#include "studies/random_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <thread>

#include <fcntl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using studies::RandomOutcome;

constexpr std::uint64_t block = 1000, finite_elements_every = 100;
constexpr unsigned work_limit_s = 5;  // of processor time for one scene

std::vector<RandomOutcome> read_outcomes(const fs::path& path) {
  std::vector<RandomOutcome> list;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) list.push_back(studies::from_line(line));
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
    studies::random_outcomes(seed, by_finite_elements(seed), [&](const RandomOutcome& o) {
      file << studies::to_line(o) << '\n';
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
    std::ofstream(part, std::ios::app) << studies::to_line(stopped) << '\n';
    seed = stopped.seed + 1;
  }
  fs::rename(part, done);
  fmt::print(stderr, "random scenes: {} to {}\n", first, first + block - 1);
}

std::vector<RandomOutcome> all_outcomes(const fs::path& folder) {
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

void second_opinions(const fs::path& folder) {
  const std::vector<RandomOutcome> all = all_outcomes(folder);
  std::ofstream file(folder / "second.txt");
  for (const RandomOutcome& o : all) {
    if (o.method != "fam" || o.outcome.rfind("wrong", 0) != 0 || o.outcome == "wrong but flagged") continue;
    file << studies::to_line(studies::second_opinion(o.seed)) << std::endl;
  }
}

// failures.csv: the head line, then outcomes.
std::set<std::uint64_t> listed_seeds(const fs::path& path) {
  std::set<std::uint64_t> seeds;
  std::ifstream file(path);
  std::string line;
  for (std::getline(file, line); std::getline(file, line);) seeds.insert(studies::from_line(line).seed);
  return seeds;
}

// By two threads, each taking the next scene.
template <class Seed>
std::vector<studies::Promise> all_promises(std::uint64_t scenes, Seed&& seed_of) {
  std::vector<studies::Promise> promises(scenes);
  std::atomic<std::uint64_t> next = 0;
  const auto work = [&] {
    for (std::uint64_t i = next++; i < scenes; i = next++) {
      const bool count_needed = i / 10 % 4 == 0;  // a quarter of the scenes, all kinds and tolerances
      promises[i] = studies::promise_of(seed_of(i), count_needed);
      if (i % 1000 == 999) fmt::print(stderr, "promise: {} of {}\n", i + 1, scenes);
    }
  };
  std::thread other(work);
  work();
  other.join();
  return promises;
}

int check(const fs::path& folder, const fs::path& list) {
  const std::set<std::uint64_t> known = listed_seeds(list);
  int unknown = 0;
  for (const RandomOutcome& o : all_outcomes(folder)) {
    const bool slow = o.outcome == "work limit";  // depends on the machine
    if (!studies::is_listed(o) || slow || known.count(o.seed) != 0) continue;
    fmt::print(stderr, "not in {}: {}\n", list.string(), studies::to_line(o));
    ++unknown;
  }
  return unknown == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::string command = arguments.empty() ? "" : arguments[0];
  if (command == "scene" && arguments.size() == 2) {
    std::cout << scene::write_scene(studies::random_scene(std::stoull(arguments[1])));
  } else if (command == "run" && arguments.size() == 4) {
    fs::create_directories(arguments[3]);
    const std::uint64_t to = std::stoull(arguments[2]);
    for (std::uint64_t seed = std::stoull(arguments[1]); seed < to; seed += block) run_block(seed, arguments[3]);
  } else if (command == "second" && arguments.size() == 2) {
    second_opinions(arguments[1]);
  } else if (command == "sum" && arguments.size() == 3) {
    for (const auto& [name, text] : studies::random_files(all_outcomes(arguments[1]))) {
      studies::write_file(fs::path(arguments[2]) / name, text);
    }
  } else if (command == "promise" && arguments.size() == 3) {
    const auto promises = all_promises(std::stoull(arguments[1]), studies::promise_seed);
    for (const auto& [name, text] : studies::promise_files(promises)) {
      studies::write_file(fs::path(arguments[2]) / name, text);
    }
  } else if (command == "estimates" && arguments.size() == 3) {
    const auto promises = all_promises(std::stoull(arguments[1]), studies::estimate_seed);
    for (const auto& [name, text] : studies::estimate_files(promises)) {
      studies::write_file(fs::path(arguments[2]) / name, text);
    }
  } else if (command == "check" && arguments.size() == 3) {
    return check(arguments[1], arguments[2]);
  } else {
    fmt::print(stderr,
               "random_scenes scene SEED | run FROM TO FOLDER | second FOLDER | sum FOLDER OUTPUT | promise N OUTPUT | "
               "estimates N OUTPUT "
               "| check FOLDER LIST\n");
    return 2;
  }
  return 0;
}
