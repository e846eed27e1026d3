#include "studies/work_precision/instructions.h"

#include "studies/report/table.h"
#include "studies/scenes/cases.h"
#include "studies/work_precision/competitors.h"
#include "studies/work_precision/random_races.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else  // nothing is counted
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_TOGGLE_COLLECT
#define CALLGRIND_DUMP_STATS_AT(name)
#endif

namespace studies {
namespace {

const std::vector<double> counted_targets = {1e-3, 1e-5};

bool has_valgrind() {
  return std::system("command -v valgrind >/dev/null 2>&1") == 0;
}

std::string line_of(const CountedSolve& solve) {
  return fmt::format("{},{},{},{},{}", solve.folder, solve.scene, solve.series, solve.model, solve.resolution);
}

// The coarsest resolution within the target, of FAM's automatic choice the one asked for it; none: null.
const WorkPoint* within(const WorkData& data, const std::string& scene, const std::string& series,
                        const std::string& model, double target) {
  const bool as_asked = series_named(series).method == "fam";
  for (const WorkPoint* p : data.of(scene, series, model)) {
    if (as_asked && p->label != target_text(target)) continue;
    if (p->converged() && p->error <= target) return p;
  }
  return nullptr;
}

std::vector<CountedSolve> to_be_counted(const WorkData& data) {
  std::vector<CountedSolve> solves;
  for (const WorkScene& scene : data.scenes) {
    for (const Contestant& c : contestants()) {
      for (const std::string& series : c.series) {
        for (const double target : counted_targets) {
          const WorkPoint* point = within(data, scene.name, series, c.model, target);
          if (point) solves.push_back({scene.name, scene.folder, series, c.model, point->resolution, target, NAN});
        }
      }
    }
  }
  return solves;
}

// "desc: Trigger: Client Request: 17" and "totals: 123456" of each of callgrind's files.
std::map<std::size_t, double> counts_in(const std::filesystem::path& folder) {
  std::map<std::size_t, double> counts;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("out.", 0) != 0) continue;
    std::ifstream file(entry.path());
    std::optional<std::size_t> number;
    for (std::string line; std::getline(file, line);) {
      const std::string trigger = "desc: Trigger: Client Request: ", totals = "totals: ";
      if (line.rfind(trigger, 0) == 0) number = std::stoul(line.substr(trigger.size()));
      if (line.rfind(totals, 0) == 0 && number) counts[*number] = std::stod(line.substr(totals.size()));
    }
  }
  return counts;
}

const Competitor& named(const std::vector<Competitor>& all, const std::vector<std::string>& cells) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Competitor& c) {
    return c.series == cells[2] && c.model == cells[3] && c.resolution == cells[4];
  });
  if (found == all.end()) throw std::runtime_error("counted-solves: no competitor " + cells[2] + ", " + cells[4]);
  return *found;
}

Spread spread_over(const WorkData& data, WorkGroup group, const Contestant& contestant, double target) {
  std::vector<double> counts;
  for (const std::string& scene : data.names(group)) {
    double least = std::numeric_limits<double>::infinity();
    for (const CountedSolve& solve : data.counted) {
      const bool is_its =
          std::find(contestant.series.begin(), contestant.series.end(), solve.series) != contestant.series.end();
      if (is_its && solve.scene == scene && solve.model == contestant.model && solve.target == target)
        least = std::min(least, solve.instructions);
    }
    counts.push_back(least);
  }
  return spread_of(counts);
}

}  // namespace

std::vector<double> instructions_of(const std::vector<std::string>& lines) {
  std::vector<double> instructions(lines.size(), NAN);
  if (!has_valgrind()) return instructions;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("fam_instructions_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  {
    std::ofstream list(folder / "list");
    for (const std::string& line : lines) list << line << '\n';
  }
  const std::string command = fmt::format(
      "valgrind --tool=callgrind --collect-atstart=no --dump-line=no --callgrind-out-file='{0}/out' '{1}' "
      "counted-solves "
      "'{0}/list' >'{0}/log' 2>&1",
      folder.string(), self.string());
  const bool ran = std::system(command.c_str()) == 0;
  const std::map<std::size_t, double> counts = ran ? counts_in(folder) : std::map<std::size_t, double>();
  std::filesystem::remove_all(folder);
  for (const auto& [number, count] : counts)
    if (number < instructions.size()) instructions[number] = count;
  return instructions;
}

std::vector<CountedSolve> counted_solves(const WorkData& data) {
  if (!has_valgrind()) return {};
  std::vector<CountedSolve> solves = to_be_counted(data);
  std::vector<std::string> lines;
  for (const CountedSolve& solve : solves) lines.push_back(line_of(solve));
  const std::vector<double> instructions = instructions_of(lines);
  for (std::size_t i = 0; i < solves.size(); ++i) solves[i].instructions = instructions[i];
  return solves;
}

int run_counted_solves(const std::filesystem::path& list, const std::filesystem::path& cases) {
  const std::vector<Competitor> all = competitors(FeMeshes::most);
  std::ifstream file(list);
  if (!file) throw std::runtime_error(list.string() + ": cannot be read");
  std::size_t number = 0;
  for (std::string line; std::getline(file, line); ++number) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (cells.size() != 5) throw std::runtime_error(list.string() + ": " + line + ": five cells a line");
    const std::function<void()> solve =
        cells[0] == "random" ? raced_solve(std::stoull(cells[1]), cells[2], std::stod(cells[4]))
                             : named(all, cells).method->bare_solve(read_case(cases, cells[0] + "/" + cells[1]));
    solve();
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
    solve();
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_DUMP_STATS_AT(std::to_string(number).c_str());
  }
  return 0;
}

std::string instructions_table(const WorkData& data) {
  std::vector<std::string> head{"thousand instructions"};
  for (const WorkGroup group : work_groups)
    for (const double target : counted_targets) head.push_back(title(group) + ", " + target_text(target));
  Table table(head);
  for (const Contestant& c : contestants()) {
    std::vector<std::string> cells{c.name()};
    for (const WorkGroup group : work_groups) {
      for (const double target : counted_targets) {
        const Spread n = spread_over(data, group, c, target);
        if (!std::isfinite(n.median)) {
          cells.push_back(fmt::format("– [{}/{}]", n.reached, n.scenes));
          continue;
        }
        const std::string share = n.reached == n.scenes ? "" : fmt::format(" [{}/{}]", n.reached, n.scenes);
        cells.push_back(fmt::format("{} ({} … {}){}", significant(n.median / 1e3, 3), significant(n.lower / 1e3, 3),
                                    significant(n.upper / 1e3, 3), share));
      }
    }
    table.add(std::move(cells));
  }
  return table.markdown();
}

std::string instructions_csv(const WorkData& data) {
  Table table({"scene", "method", "model", "resolution", "target_over_L", "instructions"});
  for (const CountedSolve& solve : data.counted)
    table.add({solve.scene, solve.series, solve.model, solve.resolution, scientific(solve.target, 0),
               std::isfinite(solve.instructions) ? fmt::format("{:.0f}", solve.instructions) : "nan"});
  return table.csv(
      {"One bare solve, memory and caches warm, by callgrind; the coarsest resolution within the target."});
}

}  // namespace studies
