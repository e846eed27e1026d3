#include "studies/report/table.h"

#include "studies/compare/error_measures.h"
#include "studies/population/data.h"

#include <fmt/format.h>

#include <algorithm>

namespace studies {
namespace {

std::string four_digits(double value) {
  return significant(value, 4);
}

void add_verdict(Table& table, const Mechanism& m, const std::string& prior, const std::vector<StatisticVector>& sets,
                 const Targets& targets) {
  const PrintJudgement j = judge_print(sets, targets);
  table.add({m.key, prior, std::to_string(j.sets), four_digits(j.distance), four_digits(j.own_999),
             fixed(j.share_farther, 4), four_digits(j.nearest), std::to_string(j.within_20),
             std::to_string(j.within_50), name(j.verdict)});
}

const std::vector<std::string> verdict_columns = {
    "mechanism",         "prior",         "sets",        "distance",
    "own_99.9_percent",  "share_farther", "nearest_set", "within_20_percent",
    "within_50_percent", "verdict"};

const char* side_name(Side side) {
  static constexpr std::array<const char*, side_count> names = {"follower",        "follower_kirchhoff", "fixed",
                                                                "fixed_kirchhoff", "fixed_moment",       "fixed_force"};
  return names[static_cast<std::size_t>(side)];
}

}  // namespace

std::string verdicts_csv(const PopulationSample& sample, const Targets& targets) {
  Table table(verdict_columns);
  const std::vector<Mechanism>& mechanisms = all_mechanisms();
  for (std::size_t m = 0; m < mechanisms.size(); ++m) {
    add_verdict(table, mechanisms[m], "all", sample.sets_of(m), targets);
    for (const LoadPrior prior : all_load_priors)
      add_verdict(table, mechanisms[m], name(prior), sample.sets_of(m, prior), targets);
  }
  return table.csv(
      {"Distance of the printed statistics from the sets of each mechanism; sets within 20 and 50 % of all."});
}

std::string answer_csv(const PrintedStudy& study, std::uint64_t sets, Progress::Style progress) {
  return verdicts_csv(sample_population(study.rod, sets, progress), reconciled(study));
}

std::string distributions_csv(const PopulationSample& sample, const Targets& targets) {
  Table table({"mechanism", "statistic", "p2.5_mm", "p25_mm", "p50_mm", "p75_mm", "p97.5_mm", "share_below_printed",
               "share_above_printed"});
  const std::vector<Mechanism>& mechanisms = all_mechanisms();
  for (std::size_t m = 0; m < mechanisms.size(); ++m) {
    const std::vector<StatisticVector> sets = sample.sets_of(m);
    for (std::size_t i = 0; i < statistic_count; ++i) {
      std::vector<double> values;
      for (const StatisticVector& set : sets) values.push_back(set[i]);
      std::sort(values.begin(), values.end());
      std::vector<std::string> row = {mechanisms[m].key, statistic_name(i)};
      for (const double share : {0.025, 0.25, 0.5, 0.75, 0.975}) row.push_back(four_digits(quantile(values, share)));
      const auto share_where = [&](auto&& is) {
        const auto count = std::count_if(values.begin(), values.end(), is);
        return fixed(static_cast<double>(count) / static_cast<double>(values.size()), 4);
      };
      row.push_back(share_where([&](double v) { return v < targets.of[i]->low; }));
      row.push_back(share_where([&](double v) { return v > targets.of[i]->high; }));
      table.add(row);
    }
  }
  return table.csv();
}

std::string twins_csv(const std::vector<TwinTrial>& trials) {
  Table table({"trial", "mechanism", "traced_back", "mechanisms_left", "distance", "own_99.9_percent"});
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TwinTrial& t = trials[i];
    table.add({std::to_string(i), all_mechanisms()[t.mechanism].key, t.traced_back ? "1" : "0",
               std::to_string(t.survivors), four_digits(t.distance), four_digits(t.own_999)});
  }
  return table.csv({"Statistics of known mechanisms and loads, printed with two decimals (RMS: four), traced back."});
}

std::string trends_csv(const std::vector<TrendCount>& counts) {
  Table table({"mechanism", "sets", "under_3_mm_12_to_500", "minimum_near_12", "rises_beyond_500", "all_three",
               "grows_with_torque"});
  for (std::size_t m = 0; m < counts.size(); ++m) {
    const TrendCount& c = counts[m];
    std::vector<std::string> row = {all_mechanisms()[m].key};
    for (const int count : {c.sets, c.under_3_mm, c.minimum_near_12, c.rises, c.all_three, c.grows_with_torque})
      row.push_back(std::to_string(count));
    table.add(row);
  }
  return table.csv(
      {"Sets whose worst planar case has what is printed over N, whose first spatial one over the torque."});
}

std::string beam_csv(const std::vector<BeamCheck>& checks) {
  Table table({"set", "case", "loads", "status", "distance_mm"});
  for (const BeamCheck& c : checks)
    table.add({std::to_string(c.set), std::to_string(c.place), side_name(c.side), c.status,
               c.status == "converged" ? scientific(c.distance_mm, 1) : ""});
  return table.csv(
      {"Tip of the rod that stands in for finite elements, from that of the deal.II beam (50 quadratic)."});
}

std::string beam_statistics_csv(const std::vector<BeamStatistics>& checks) {
  Table table({"set", "statistic", "by_stand_in_mm", "by_deal.II_mm", "difference_mm"});
  for (const BeamStatistics& c : checks) {
    for (std::size_t i = 0; i < statistic_count; ++i)
      table.add({std::to_string(c.set), statistic_name(i), four_digits(c.by_stand_in[i]), four_digits(c.by_beam[i]),
                 scientific(std::abs(c.by_stand_in[i] - c.by_beam[i]), 1)});
  }
  return table.csv({"Statistics of the published law with 12 arcs against either."});
}

std::string redrawn_csv(const PopulationSample& sample) {
  Table table({"prior", "sets", "cases", "cases_redrawn"});
  for (std::size_t p = 0; p < all_load_priors.size(); ++p) {
    int sets = 0, redrawn = 0;
    for (std::size_t i = p; i < sample.redrawn.size(); i += all_load_priors.size()) {
      ++sets;
      redrawn += sample.redrawn[i];
    }
    table.add({name(all_load_priors[p]), std::to_string(sets), std::to_string(16 * sets), std::to_string(redrawn)});
  }
  return table.csv();
}

std::string printed_csv(const PrintedStudy& study, const Targets& targets) {
  Table table({"statistic", "printed_low_mm", "printed_high_mm", "taken_low_mm", "taken_high_mm"});
  for (std::size_t i = 0; i < statistic_count; ++i) {
    table.add({statistic_name(i), four_digits(study.printed[i]->low), four_digits(study.printed[i]->high),
               four_digits(targets.of[i]->low), four_digits(targets.of[i]->high)});
  }
  return table.csv({"Printed statistics within their rounding, and the intervals taken, which cover both readings."});
}

TextFiles shown_files(const PopulationRod& rod, const PopulationSample& sample) {
  Table loads({"set", "prior", "case", "plane", "force_x_N", "force_y_N", "force_z_N", "moment_x_Nmm", "moment_y_Nmm",
               "moment_z_Nmm", "tip_x_mm", "tip_y_mm", "tip_z_mm"});
  for (std::uint64_t i = 0; i < shown_sets; ++i) {
    const LoadSet set = load_set(rod, i);
    for (std::size_t k = 0; k < set.cases.size(); ++k) {
      const TipCase& c = set.cases[k];
      std::vector<std::string> row = {std::to_string(i), name(set.prior), std::to_string(k + 1),
                                      c.load.planar ? "planar" : "spatial"};
      for (const Eigen::Vector3d& v : {c.load.force_N, c.load.moment_Nmm, c.tip_of(Side::follower)}) {
        for (const double value : v) row.push_back(fixed(value, 4));
      }
      loads.add(row);
    }
  }
  std::vector<std::string> columns = {"mechanism", "set"};
  for (std::size_t i = 0; i < statistic_count; ++i) columns.push_back(statistic_name(i) + "_mm");
  Table statistics(columns);
  for (std::size_t m = 0; m < sample.of_mechanism.size(); ++m) {
    for (std::uint64_t i = 0; i < shown_sets; ++i) {
      std::vector<std::string> row = {all_mechanisms()[m].key, std::to_string(i)};
      const auto& set = sample.of_mechanism[m][i];
      for (std::size_t k = 0; k < statistic_count; ++k) row.push_back(set ? fixed((*set)[k], 4) : "");
      statistics.add(row);
    }
  }
  return {{"first_loads.csv", loads.csv({"The first sets of loads (seeded, none is the paper's)."})},
          {"first_sets.csv", statistics.csv({"What every mechanism makes of them."})}};
}

}  // namespace studies
