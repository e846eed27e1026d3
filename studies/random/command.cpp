#include "studies/random/command.h"

#include "scene/scene_file.h"
#include "studies/random/promise.h"
#include "studies/random/random.h"
#include "studies/report/output_file.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>

#include <fcntl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace studies {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t block = 1000, finite_elements_every = 100;
constexpr unsigned work_limit_s = 5;  // of processor time for one scene

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
    file << to_line(second_opinion(o.seed)) << std::endl;
  }
}

// failures.csv: the head line, then outcomes.
std::set<std::uint64_t> listed_seeds(const fs::path& path) {
  std::set<std::uint64_t> seeds;
  std::ifstream file(path);
  std::string line;
  for (std::getline(file, line); std::getline(file, line);) seeds.insert(from_line(line).seed);
  return seeds;
}

// By two threads, each taking the next scene.
template <class Seed>
std::vector<Promise> all_promises(std::uint64_t scenes, Seed&& seed_of, Progress::Style style) {
  std::vector<Promise> promises(scenes);
  Progress progress("promise", scenes, style);
  std::mutex reporting;
  std::atomic<std::uint64_t> next = 0;
  const auto work = [&] {
    for (std::uint64_t i = next++; i < scenes; i = next++) {
      const bool count_needed = i / 10 % 4 == 0;  // a quarter of the scenes, all kinds and tolerances
      promises[i] = promise_of(seed_of(i), count_needed);
      if (i % 100 != 99) continue;
      const std::lock_guard<std::mutex> lock(reporting);
      progress.at(i, "scenes");
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
    if (!is_listed(o) || slow || known.count(o.seed) != 0) continue;
    fmt::print(stderr, "not in {}: {}\n", list.string(), to_line(o));
    ++unknown;
  }
  return unknown == 0 ? 0 : 1;
}

std::string seeds_text(std::uint64_t first) {
  return fmt::format("seeds {} to {}", first, first + block - 1);
}

int run_blocks(std::uint64_t from, std::uint64_t to, const fs::path& folder, Progress::Style style) {
  fs::create_directories(folder);
  Progress progress("random scenes", (to - from + block - 1) / block, style);
  for (std::uint64_t seed = from; seed < to; seed += block) {
    progress.step(seeds_text(seed));
    run_block(seed, folder);
  }
  return 0;
}

int write_all(const std::map<std::string, std::string>& files, const fs::path& output) {
  for (const auto& [name, text] : files) write_file(output / name, text);
  return 0;
}

// The arguments of the subcommands, in one place: CLI11 writes to them while it parses.
struct Arguments {
  std::uint64_t seed = 0, from = 0, to = 0, scenes = 0;
  std::string folder, output, list;
};

}  // namespace

void add_random_command(CLI::App& app, const Progress::Style& progress, std::function<int()>& chosen) {
  CLI::App* random = app.add_subcommand("random", "Random scenes by the thousand, each answer judged");
  random->require_subcommand(1);
  const auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  const auto add = [&](const std::string& name, const std::string& what, const std::function<int()>& work) {
    CLI::App* command = random->add_subcommand(name, what);
    command->callback([arguments, &chosen, work] { chosen = work; });
    return command;
  };
  const auto promises = [&progress, &a](const auto& seed_of) { return all_promises(a.scenes, seed_of, progress); };

  CLI::App* scene = add("scene", "Print one scene", [&a] {
    fmt::print("{}", scene::write_scene(random_scene(a.seed)));
    return 0;
  });
  scene->add_option("seed", a.seed)->required();

  CLI::App* run = add("run", "Solve and judge the scenes FROM..TO-1 (multiples of 1000)",
                      [&a, &progress] { return run_blocks(a.from, a.to, a.folder, progress); });
  run->add_option("from", a.from)->required();
  run->add_option("to", a.to)->required();
  run->add_option("folder", a.folder)->required();

  CLI::App* second = add("second", "A second opinion where FAM is wrong and silent", [&a] {
    second_opinions(a.folder);
    return 0;
  });
  second->add_option("folder", a.folder)->required();

  CLI::App* sum = add("sum", "Tables and page of a folder of outcomes",
                      [&a] { return write_all(random_files(all_outcomes(a.folder)), a.output); });
  sum->add_option("folder", a.folder)->required();
  sum->add_option("output", a.output)->required();

  CLI::App* promise = add("promise", "Is the tolerance kept?",
                          [&a, promises] { return write_all(promise_files(promises(promise_seed)), a.output); });
  CLI::App* estimates = add("estimates", "Is an estimate below half the error? Strips and heavy rods",
                            [&a, promises] { return write_all(estimate_files(promises(estimate_seed)), a.output); });
  for (CLI::App* command : {promise, estimates}) {
    command->add_option("scenes", a.scenes)->required();
    command->add_option("output", a.output)->required();
  }

  CLI::App* known =
      add("check", "Exit status 1 on an outcome that the list does not hold", [&a] { return check(a.folder, a.list); });
  known->add_option("folder", a.folder)->required();
  known->add_option("list", a.list)->required();
}

}  // namespace studies
