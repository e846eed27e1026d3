// The page, from the CSV files of its folder.
#include "studies/report/page.h"

#include "studies/compare/data_file.h"
#include "studies/compare/error_measures.h"
#include "studies/population/data.h"
#include "studies/report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace studies {
namespace {

using Rows = std::vector<DataRow>;

// Of a mechanism's sets, beyond what is printed of one statistic alone: hardly any.
constexpr double out_of_reach = 0.001;

struct Standing {
  const Mechanism* mechanism;
  int unreached = 0;                        // statistics
  std::map<std::string, DataRow> by_prior;  // and "all"

  const std::string& verdict(const std::string& prior) const { return by_prior.at(prior).at("verdict"); }
  bool excluded(const std::string& prior) const { return verdict(prior) == "excluded"; }
  int priors_that_exclude() const {
    int count = 0;
    for (const LoadPrior prior : all_load_priors) count += excluded(name(prior));
    return count;
  }
  // Whatever the loads were drawn from.
  bool is_out() const { return excluded("all") && priors_that_exclude() == 3; }
  // Not in the sets of all priors together, but under one alone.
  bool depends() const { return !is_out() && priors_that_exclude() > 0; }
  double nearest() const { return std::stod(by_prior.at("all").at("nearest_set")); }
};

std::vector<Standing> standings_in(const std::filesystem::path& folder) {
  std::vector<Standing> standings;
  for (const Mechanism& m : all_mechanisms()) standings.push_back({&m, 0, {}});
  for (const DataRow& row : data_rows(folder / "verdicts.csv"))
    standings[mechanism_at(row.at("mechanism"))].by_prior[row.at("prior")] = row;
  for (const DataRow& row : data_rows(folder / "distributions.csv")) {
    const double rarer =
        1 - std::max(std::stod(row.at("share_below_printed")), std::stod(row.at("share_above_printed")));
    standings[mechanism_at(row.at("mechanism"))].unreached += rarer < out_of_reach;
  }
  return standings;
}

std::string keys_where(const std::vector<Standing>& standings, const std::function<bool(const Standing&)>& is) {
  std::string text;
  for (const Standing& s : standings) {
    if (is(s)) text += (text.empty() ? "`" : ", `") + s.mechanism->key + "`";
  }
  return text.empty() ? "none" : text;
}

long count_where(const std::vector<Standing>& standings, const std::function<bool(const Standing&)>& is) {
  return std::count_if(standings.begin(), standings.end(), is);
}

std::string share_percent(double share) {
  return fmt::format("{:.{}f}", 100 * share, share < 0.0995 ? 1 : 0);
}

std::string verdict_table(const std::vector<Standing>& standings) {
  Table table({"mechanism", "FAM", "FE", "all sets", "load", "deflection", "round", "own sets farther, %",
               "nearest set, % off", "out of reach"});
  for (const Standing& s : standings) {
    const DataRow& all = s.by_prior.at("all");
    const auto shown = [&](const std::string& prior) { return s.excluded(prior) ? "**excluded**" : s.verdict(prior); };
    table.add({"`" + s.mechanism->key + "`", s.mechanism->fam, s.mechanism->fe, shown("all"), shown("load"),
               shown("deflection"), shown("round"), share_percent(std::stod(all.at("share_farther"))),
               fmt::format("{:.0f}", 100 * s.nearest()), std::to_string(s.unreached)});
  }
  return table.markdown();
}

std::string trends_table(const Rows& trends) {
  Table table({"mechanism", "under 3 mm", "least near 12", "rises", "all three", "grows with torque"});
  for (const DataRow& row : trends) {
    const double sets = std::stod(row.at("sets"));
    std::vector<std::string> cells = {"`" + row.at("mechanism") + "`"};
    for (const char* column :
         {"under_3_mm_12_to_500", "minimum_near_12", "rises_beyond_500", "all_three", "grows_with_torque"})
      cells.push_back(sets > 0 ? fmt::format("{:.0f}", 100 * std::stod(row.at(column)) / sets) : "–");
    table.add(cells);
  }
  return table.markdown();
}

// Where the trend over N and the torque agree with the paper in this share of sets at least.
std::string with_trend(const Rows& trends, const std::vector<Standing>& standings, const char* column, double share) {
  std::set<std::string> keys;
  for (const DataRow& row : trends) {
    if (std::stod(row.at(column)) >= share * std::max(std::stod(row.at("sets")), 1.)) keys.insert(row.at("mechanism"));
  }
  return keys_where(standings, [&](const Standing& s) { return keys.count(s.mechanism->key) > 0; });
}

void set_twins(Page& page, const Rows& twins) {
  int traced = 0;
  std::vector<double> remaining;
  for (const DataRow& row : twins) {
    traced += row.at("traced_back") == "1";
    remaining.push_back(std::stod(row.at("mechanisms_left")));
  }
  page.set("trials", std::to_string(twins.size()));
  page.set("traced", std::to_string(traced));
  page.set("left_median", fmt::format("{:g}", quantile(remaining, 0.5)));
  page.set("left_least", fmt::format("{:g}", *std::min_element(remaining.begin(), remaining.end())));
  page.set("left_most", fmt::format("{:g}", *std::max_element(remaining.begin(), remaining.end())));
  page.check("traced_back", 100 * traced >= 95 * static_cast<int>(twins.size()));
}

void set_beam(Page& page, const Rows& cases, const Rows& statistics) {
  double largest = 0, largest_difference = 0;
  int solved = 0;
  std::set<std::string> sets;
  for (const DataRow& row : cases) {
    if (row.at("status") != "converged") continue;
    ++solved;
    largest = std::max(largest, std::stod(row.at("distance_mm")));
  }
  for (const DataRow& row : statistics) {
    sets.insert(row.at("set"));
    largest_difference = std::max(largest_difference, std::stod(row.at("difference_mm")));
  }
  page.check("beam_agrees",
             solved == static_cast<int>(cases.size()) && largest < beam_limit_mm && largest_difference < beam_limit_mm);
  page.set("beam_limit", for_reader(scientific(beam_limit_mm, 0)));
  page.set("beam_cases", std::to_string(cases.size()));
  page.set("beam_solved", std::to_string(solved));
  page.set("beam_largest", for_reader(scientific(largest, 1)));
  page.set("beam_sets", std::to_string(sets.size()));
  page.set("beam_statistics", for_reader(scientific(largest_difference, 1)));
}

void set_verdicts(Page& page, const std::vector<Standing>& standings) {
  const auto out = [](const Standing& s) { return s.is_out(); };
  const auto pooled = [](const Standing& s) { return s.excluded("all") && !s.is_out(); };
  const auto fits = [](const Standing& s) { return s.verdict("all") == "fits"; };
  const auto strained = [](const Standing& s) { return s.verdict("all") == "strained"; };
  page.set("mechanisms", std::to_string(standings.size()));
  page.set("unreached", keys_where(standings, [](const Standing& s) { return s.unreached > 0; }));
  page.set("out_count", std::to_string(count_where(standings, out)));
  page.set("out", keys_where(standings, out));
  page.set("pooled_out", keys_where(standings, pooled));
  page.set("each_out",
           keys_where(standings, [](const Standing& s) { return !s.excluded("all") && s.priors_that_exclude() == 3; }));
  page.set("strained_count", std::to_string(count_where(standings, strained)));
  page.set("strained", keys_where(standings, strained));
  page.set("fits_count", std::to_string(count_where(standings, fits)));
  page.set("fits", keys_where(standings, fits));
  page.set("depend_count", std::to_string(count_where(standings, [](const Standing& s) { return s.depends(); })));
  for (const LoadPrior prior : all_load_priors) {
    const std::string key = name(prior);
    page.set("left_under_" + key, keys_where(standings, [&](const Standing& s) { return s.verdict(key) == "fits"; }));
    page.set("out_under_" + key,
             std::to_string(count_where(standings, [&](const Standing& s) { return s.excluded(key); })));
  }
  long within_20 = 0, within_50 = 0;
  for (const Standing& s : standings) {
    within_20 += std::stol(s.by_prior.at("all").at("within_20_percent"));
    within_50 += std::stol(s.by_prior.at("all").at("within_50_percent"));
  }
  page.set("within_20", std::to_string(within_20));
  page.set("within_50", std::to_string(within_50));
  page.check("none_within", within_20 == 0 && within_50 == 0);
  const auto nearest = std::min_element(standings.begin(), standings.end(),
                                        [](const Standing& a, const Standing& b) { return a.nearest() < b.nearest(); });
  page.set("nearest", fmt::format("{:.0f}", 100 * nearest->nearest()));
  page.set("nearest_key", "`" + nearest->mechanism->key + "`");
}

}  // namespace

TextFiles population_page(const std::filesystem::path& folder, const std::filesystem::path& page_md) {
  const std::vector<Standing> standings = standings_in(folder);
  const Rows trends = data_rows(folder / "trends.csv");
  Page page;
  set_verdicts(page, standings);
  set_twins(page, data_rows(folder / "twins.csv"));
  set_beam(page, data_rows(folder / "beam_cases.csv"), data_rows(folder / "beam_statistics.csv"));
  page.set("sets", fmt::format("{} {:03}", population_sets / 1000, population_sets % 1000));
  page.set("trend_sets", std::to_string(trend_sets));
  page.set("bound", for_reader(scientific(3. / static_cast<double>(population_sets), 0)));
  page.set("verdict_table", verdict_table(standings));
  page.set("trend_table", trends_table(trends));
  page.set("trend_keys", with_trend(trends, standings, "all_three", 0.05));
  page.set("torque_keys", with_trend(trends, standings, "grows_with_torque", 0.5));
  long redrawn = 0, cases = 0;
  for (const DataRow& row : data_rows(folder / "redrawn.csv")) {
    redrawn += std::stol(row.at("cases_redrawn"));
    cases += std::stol(row.at("cases"));
  }
  page.set("redrawn", share_percent(static_cast<double>(redrawn) / static_cast<double>(cases + redrawn)));
  Table statistics({"statistic", "printed, mm", "taken, mm"});
  for (const DataRow& row : data_rows(folder / "printed.csv")) {
    const auto range = [&](const std::string& what) {
      return row.at(what + "_low_mm") + " … " + row.at(what + "_high_mm");
    };
    const std::string& key = row.at("statistic");
    statistics.add({"[" + key + "](" + key + ".svg)", range("printed"), range("taken")});
  }
  page.set("statistics_table", statistics.markdown());
  const std::string answer = fmt::format(
      "of {} mechanisms {} are excluded whatever our loads were drawn from; {} are not, and the *printed* numbers "
      "cannot "
      "tell them apart",
      standings.size(), count_where(standings, [](const Standing& s) { return s.is_out(); }),
      count_where(standings, [](const Standing& s) { return !s.is_out(); }));
  return {{"README.md", page.fill(page_md)}, {answers_file, answers_json({{"printed", answer}})}};
}

}  // namespace studies
