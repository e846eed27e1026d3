// The population: what every mechanism makes of every set of loads, and what follows from it. The page is written from
// the CSV files alone, so that --quick, which reads most of them back, writes the same.
#pragma once

#include "studies/population/mechanisms.h"
#include "studies/population/targets.h"
#include "studies/report/progress.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace CLI {
class App;
}

namespace studies {

constexpr std::uint64_t population_sets = 10'000;
constexpr std::uint64_t shown_sets = 6;  // written out, and solved again by --quick
constexpr std::uint64_t trend_sets = 200, check_sets = 10, check_cases = 200, twin_trials = 100;
// Twins and the cases of the check are none of the population's.
constexpr std::uint64_t first_twin = 1'000'000, first_check = 2'000'000;

// By mechanism, then by set; empty where a mechanism has no answer.
struct PopulationSample {
  std::vector<std::vector<std::optional<StatisticVector>>> of_mechanism;
  std::vector<int> redrawn;  // cases of each set

  std::vector<StatisticVector> sets_of(std::size_t mechanism, std::optional<LoadPrior> prior = std::nullopt) const;
};
PopulationSample sample_population(const PopulationRod& rod, std::uint64_t sets, Progress::Style progress);

// Statistics made by a known mechanism from loads of the population's kind, printed with two decimals (the RMS: four):
// which mechanisms are not excluded?
struct TwinTrial {
  std::size_t mechanism = 0;
  bool traced_back = false;
  std::size_t survivors = 0;
  double distance = 0, own_999 = 0;
};
PrintedStudy as_printed(const StatisticVector& statistics);
std::vector<TwinTrial> trace_back(const PopulationSample& sample, std::uint64_t trials);

struct TrendCount {
  int sets = 0, under_3_mm = 0, minimum_near_12 = 0, rises = 0, all_three = 0, grows_with_torque = 0;
};
std::vector<TrendCount> count_trends(std::uint64_t sets, Progress::Style progress);

// The rod that stands in for finite elements, beside the deal.II beam of 50 quadratic elements.
struct BeamCheck {
  std::uint64_t set = 0;
  std::size_t place = 0;  // of the case in the set
  Side side = Side::follower;
  double distance_mm = 0;
  std::string status;  // of the beam
};
// Of their tips and of the statistics. Measured: 1.8e-5 mm on 200 cases, 3.2e-6 mm in ten sets.
constexpr double beam_limit_mm = 1e-4;
double beam_distance_mm(const PopulationRod& rod, const LoadSet& set, const TipCase& c, Side side, std::string& status,
                        Eigen::Vector3d& beam_tip_mm);
struct BeamStatistics {
  std::uint64_t set = 0;
  StatisticVector by_stand_in{}, by_beam{};  // of the published law, 12 arcs
};
std::vector<BeamCheck> check_against_beam(Progress::Style progress);
std::vector<BeamStatistics> check_statistics(Progress::Style progress);

// --- Files -----------------------------------------------------------------------------------------------------------
using TextFiles = std::map<std::string, std::string>;
std::string verdicts_csv(const PopulationSample& sample, const Targets& targets);
std::string distributions_csv(const PopulationSample& sample, const Targets& targets);
std::string twins_csv(const std::vector<TwinTrial>& trials);
std::string trends_csv(const std::vector<TrendCount>& counts);
std::string beam_csv(const std::vector<BeamCheck>& checks);
std::string beam_statistics_csv(const std::vector<BeamStatistics>& checks);
std::string redrawn_csv(const PopulationSample& sample);
std::string printed_csv(const PrintedStudy& study, const Targets& targets);
// Loads and statistics of the first sets.
TextFiles shown_files(const PopulationRod& rod, const PopulationSample& sample);

// Pictures and page from the CSV files of a folder.
TextFiles population_pictures(const std::filesystem::path& folder);
TextFiles population_page(const std::filesystem::path& folder, const std::filesystem::path& page_md);

// --- fam-studies population --statistic FILE -------------------------------------------------------------------------
PrintedStudy read_printed_study(const std::string& path);  // throws scene::SceneError; docs/population.md
// verdicts.csv for these statistics.
std::string answer_csv(const PrintedStudy& study, std::uint64_t sets, Progress::Style progress);
// Adds the option; parsing it sets `chosen` to its work. quick, quiet: read when that is done.
void add_statistic_option(CLI::App& population, const bool& quick, const bool& quiet, std::function<int()>& chosen);

}  // namespace studies
