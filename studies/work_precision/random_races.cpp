#include "studies/work_precision/random_races.h"

#include "exact_reference/solve.h"
#include "fam/solve.h"
#include "scene/span_facts.h"
#include "studies/compare/data_file.h"
#include "studies/compare/timing_cells.h"
#include "studies/methods/rk4_method.h"
#include "studies/report/chart.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/scenes/random_scene.h"
#include "studies/work_precision/data.h"
#include "studies/work_precision/instructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace studies {
namespace {

using scene::Equilibrium;
using scene::Scene;

constexpr std::size_t scenes_raced = 1000, raced_quickly = 20;
constexpr int most_steps = 512;
constexpr double slower = 0.8;      // shooting takes less than this share of the time of fam::solve
constexpr double budget_s = 0.002;  // of a timing

std::vector<std::uint64_t> seeds(std::size_t count) {
  std::vector<std::uint64_t> list;
  for (std::uint64_t index = 0; list.size() < count; ++index) {
    const std::uint64_t seed = mixed_seed(index);
    if (!scene::all_loads_follow(scene::spans_of(random_scene(seed)))) list.push_back(seed);
  }
  return list;
}

double error_of(const Equilibrium& answer, const Equilibrium& exact, double length_mm) {
  if (!answer.converged()) return std::numeric_limits<double>::quiet_NaN();
  return (answer.tip().position_B_mm - exact.tip().position_B_mm).norm() / length_mm;
}

fam::Options asked_for(double target, double length_mm) {
  fam::Options options;
  options.tolerance_mm = target * length_mm;
  options.whole_rod = false;
  return options;
}

RandomRace solved(std::uint64_t seed, const Scene& scene, const Equilibrium& exact, double target) {
  RandomRace race;
  race.seed = seed;
  race.target = target;
  race.judged = exact.converged();
  const double length_mm = scene::length_mm(scene);
  const Equilibrium answer = fam::solve(scene, asked_for(target, length_mm));
  race.status = scene::name(answer.status);
  if (!race.judged) return race;
  race.error = error_of(answer, exact, length_mm);
  for (int steps = 2; steps <= most_steps && race.steps == 0; steps *= 2) {
    const double error = error_of(rk4_method({steps, true})->solve(scene), exact, length_mm);
    if (error <= target) race.steps = steps, race.shooting_error = error;
  }
  return race;
}

std::function<void()> solve_by_fam(const Scene& scene, double target) {
  return [scene, options = asked_for(target, scene::length_mm(scene))] { fam::solve(scene, options); };
}
std::function<void()> solve_by_shooting(const Scene& scene, int steps) {
  return rk4_method({steps, true})->bare_solve(scene);
}

void take_times(RandomRace& race, const Scene& scene) {
  if (!race.judged) return;
  race.fam = measure(solve_by_fam(scene, race.target), budget_s);
  if (race.steps > 0) race.shooting = measure(solve_by_shooting(scene, race.steps), budget_s);
}

RandomRace read(const DataRow& row) {
  RandomRace race;
  race.seed = std::stoull(row.at("seed"));
  race.target = std::stod(row.at("target_over_L"));
  race.status = row.at("status");
  race.judged = row.at("judged") == "1";
  race.steps = std::stoi(row.at("steps"));
  if (!race.judged) return race;
  race.error = row.at("error_over_L") == "–" ? NAN : std::stod(row.at("error_over_L"));
  if (race.steps > 0) race.shooting_error = std::stod(row.at("shooting_error_over_L"));
  return race;
}

struct Standing {
  int scenes = 0, judged = 0, fam = 0, shooting = 0, slow = 0, more = 0;  // more: by instructions
  Spread all, both, counted;
};

Standing standing(const std::vector<RandomRace>& races, double target, const std::string& kind = "") {
  Standing result;
  std::vector<double> ratios, finite, counted;
  for (const RandomRace& race : races) {
    if (race.target != target || (!kind.empty() && kind_of(race.seed) != kind)) continue;
    ++result.scenes;
    result.judged += race.judged;
    result.fam += race.judged && race.fam_is_right();
    result.shooting += race.steps > 0;
    if (!race.fam_is_right() || !race.fam) continue;
    ratios.push_back(race.ratio());
    if (race.steps > 0) finite.push_back(race.ratio());
    result.slow += race.ratio() < slower;
    if (!std::isnan(race.ratio_of_instructions())) counted.push_back(race.ratio_of_instructions());
    result.more += race.ratio_of_instructions() < slower;
  }
  result.all = spread_of(ratios);
  result.both = spread_of(finite);
  result.counted = spread_of(counted);
  return result;
}

std::string spread_text(const Spread& spread) {
  const auto text = [](double ratio) { return std::isfinite(ratio) ? significant(ratio, 2) : std::string("∞"); };
  return fmt::format("{} ({} … {})", text(spread.median), text(spread.lower), text(spread.upper));
}

std::vector<std::string> kinds(const std::vector<RandomRace>& races) {
  std::vector<std::string> list;
  for (const RandomRace& race : races) {
    const std::string kind = kind_of(race.seed);
    if (std::find(list.begin(), list.end(), kind) == list.end()) list.push_back(kind);
  }
  return list;
}

}  // namespace

double RandomRace::ratio() const {
  return shooting ? shooting->median_us / fam->median_us : std::numeric_limits<double>::infinity();
}

double RandomRace::ratio_of_instructions() const {
  return shooting_instructions / fam_instructions;
}

std::function<void()> raced_solve(std::uint64_t seed, const std::string& by, double target_or_steps) {
  const Scene scene = random_scene(seed);
  if (by == "fam") return solve_by_fam(scene, target_or_steps);
  if (by == "rk4") return solve_by_shooting(scene, static_cast<int>(target_or_steps));
  throw std::runtime_error("counted-solves: no racer " + by);
}

void count_instructions(std::vector<RandomRace>& races) {
  std::vector<std::string> lines;
  std::vector<double*> counts;
  for (RandomRace& race : races) {
    if (!race.fam || race.steps == 0) continue;
    lines.push_back(fmt::format("random,{},fam,,{}", race.seed, race.target));
    counts.push_back(&race.fam_instructions);
    lines.push_back(fmt::format("random,{},rk4,,{}", race.seed, race.steps));
    counts.push_back(&race.shooting_instructions);
  }
  const std::vector<double> instructions = instructions_of(lines);
  for (std::size_t i = 0; i < counts.size(); ++i) *counts[i] = instructions[i];
}

std::vector<RandomRace> random_races(const StudyOptions& options) {
  std::vector<RandomRace> races;
  for (const std::uint64_t seed : seeds(options.quick ? raced_quickly : scenes_raced)) {
    const Scene scene = random_scene(seed);
    const Equilibrium exact = exact_reference::solve(scene);
    for (const double target : race_targets) {
      races.push_back(solved(seed, scene, exact, target));
      if (!options.quick) take_times(races.back(), scene);
    }
  }
  if (!options.quick) return races;
  const std::vector<DataRow> rows = data_rows(options.committed / "work_precision" / races_file);
  for (std::size_t i = races.size(); i < rows.size(); ++i) races.push_back(read(rows[i]));
  return races;
}

std::string races_csv(const std::vector<RandomRace>& races) {
  Table table({"seed", "kind", "target_over_L", "judged", "status", "error_over_L", "steps", "shooting_error_over_L"});
  for (const RandomRace& race : races) {
    table.add({std::to_string(race.seed), kind_of(race.seed), scientific(race.target, 0), race.judged ? "1" : "0",
               race.status, race.judged ? work_error_text(race.error) : "", std::to_string(race.steps),
               race.steps > 0 ? work_error_text(race.shooting_error) : ""});
  }
  return table.csv(
      {"Tip errors over L against the exact rod with shear and stretch; not judged: it has no answer. Errors below "
       "1e-12 are written as 1e-12.",
       "steps: the fewest of 2, 4, ... 512 of plain RK4 shooting that are within the target; 0: none."});
}

std::string races_timing_csv(const std::vector<RandomRace>& races) {
  const auto count = [](double n) { return std::isnan(n) ? std::string("nan") : fixed(n, 0); };
  Table table({"seed", "kind", "target_over_L", "fam_us", "shooting_us", "fam_instructions", "shooting_instructions"});
  for (const RandomRace& race : races) {
    if (!race.fam) continue;
    table.add({std::to_string(race.seed), kind_of(race.seed), scientific(race.target, 0), fixed(race.fam->median_us, 2),
               race.shooting ? fixed(race.shooting->median_us, 2) : "nan", count(race.fam_instructions),
               count(race.shooting_instructions)});
  }
  return table.csv({machine_line(),
                    "Medians, and instructions of one solve, memory and caches warm, by callgrind. "
                    "fam: fam::solve for the tip; shooting with its fewest steps, nan: none."});
}

std::string races_right(const std::vector<RandomRace>& races) {
  const Standing coarse = standing(races, race_targets[0]), fine = standing(races, race_targets[1]);
  return for_reader(fmt::format(
      "Of {} random scenes with a load fixed in space ([which](../random/README.md#how-it-was-measured)) the exact "
      "reference has an answer on {}. Within 1e-3 L `fam solve` is right on {} of these, plain shooting with as many "
      "steps as it takes, up to {}, on {}; within 1e-5 L on {} and {}.",
      coarse.scenes, coarse.judged, coarse.fam, most_steps, coarse.shooting, fine.fam, fine.shooting));
}

std::string races_answer(const std::vector<RandomRace>& races) {
  const Standing coarse = standing(races, race_targets[0]), fine = standing(races, race_targets[1]);
  return for_reader(fmt::format(
      "Shooting with the fewest steps takes {} times as long at 1e-3 L and {} at 1e-5 L, where it fails infinitely "
      "long; where both are right {} and {}. It takes less than {} of the time on {} and {} scenes. Of instructions, "
      "which do not depend on what else the machine does, it takes {} and {} times as many where both are right, and "
      "less than {} on {} and {} scenes.",
      spread_text(coarse.all), spread_text(fine.all), spread_text(coarse.both), spread_text(fine.both), slower,
      coarse.slow, fine.slow, spread_text(coarse.counted), spread_text(fine.counted), slower, coarse.more, fine.more));
}

std::string races_table(const std::vector<RandomRace>& races) {
  Table table({"kind", "judged scenes", "FAM right, 1e-3 L", "shooting right", "its time over FAM's, 1e-3 L",
               "below 0.8 (of instructions)", "1e-5 L", "below 0.8 (of instructions)"});
  const auto slow = [](const Standing& s) { return fmt::format("{} ({})", s.slow, s.more); };
  std::vector<std::string> list = kinds(races);
  std::sort(list.begin(), list.end());
  for (const std::string& kind : list) {
    const Standing coarse = standing(races, race_targets[0], kind), fine = standing(races, race_targets[1], kind);
    table.add({kind, std::to_string(coarse.judged), std::to_string(coarse.fam), std::to_string(coarse.shooting),
               spread_text(coarse.all), slow(coarse), spread_text(fine.all), slow(fine)});
  }
  return table.markdown();
}

std::string races_picture(const std::vector<RandomRace>& races) {
  const Axis ratio_axis{"time of RK4 shooting over that of fam solve", 0.01, 100, true};
  const Axis share_axis{"", 0, 1, false};
  const std::map<double, const char*> colours{{1e-3, "#0072b2"}, {1e-5, "#d55e00"}};
  const std::map<double, std::size_t> named_at{{1e-3, 80}, {1e-5, 40}};  // per cent of the points
  std::string text = "Share of the scenes on which the ratio is below the number along the axis.";
  Svg svg(890, 470, "Random scenes: how much longer shooting takes", text,
          "Left of 1 shooting is faster. The curves end below 1 by the share of scenes on which shooting fails.");
  Panel panel(svg, {74, 84}, 780, 320, ratio_axis, share_axis);
  panel.frame("Share of the scenes with a smaller ratio");
  panel.curve({{1, 0}, {1, 1}}, {"#888888", 1, "4 3"});
  for (const double target : race_targets) {
    std::vector<double> ratios;
    for (const RandomRace& race : races) {
      if (race.target == target && race.fam_is_right() && race.fam) ratios.push_back(race.ratio());
    }
    std::sort(ratios.begin(), ratios.end());
    std::vector<Point> points;
    for (std::size_t i = 0; i < ratios.size() && ratios[i] <= ratio_axis.high; ++i)
      points.push_back({std::max(ratios[i], ratio_axis.low), (i + 1.0) / static_cast<double>(ratios.size())});
    if (points.empty()) continue;
    panel.curve(points, {colours.at(target), 1.8, ""});
    panel.name(points[points.size() * named_at.at(target) / 100], target_text(target), colours.at(target));
  }
  panel.place_names();
  return svg.str();
}

}  // namespace studies
