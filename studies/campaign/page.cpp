#include "studies/report/page.h"
#include "studies/campaign/data.h"
#include "studies/campaign/summary.h"
#include "studies/report/chart.h"
#include "studies/report/table.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::uint64_t starting_with(const Tally& tally, const std::string& words, const std::string& kind = {}) {
  std::uint64_t sum = 0;
  for (const auto& [key, n] : tally.counts()) {
    if (key.second.rfind(words, 0) == 0 && (kind.empty() || key.first == kind)) sum += n;
  }
  return sum;
}

std::string share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "–" : fmt::format("{:.2f} %", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string bound_text(std::uint64_t found, std::uint64_t asked) {
  return for_reader(fmt::format("{:.1e}", rate_bound(found, asked)));
}

const std::vector<std::pair<std::string, std::string>>& outcomes_of_random() {
  static const std::vector<std::pair<std::string, std::string>> words{
      {"certified: the only equilibrium", "certified, the only equilibrium"},
      {"certified: path back", "certified, path back"},
      {"signs alone", "signs alone"},
      {"right", "right by the exact reference"},
      {"tolerance missed", "tolerance missed"},
      {"wrong but flagged", "wrong but flagged"},
      {"wrong and silent", "wrong and silent"},
      {"no judge", "no judge"},
      {"no answer", "no answer"},
      {"no answer but exact", "of these the exact reference has one"}};
  return words;
}

Table outcomes_table(const Tally& random) {
  std::vector<std::string> kinds{"general", "buckling"};
  kinds.insert(kinds.end(), families.begin(), families.end());
  std::vector<std::string> head{"kind of scene", "scenes"};
  for (const auto& [words, name] : outcomes_of_random()) head.push_back(name);
  Table table(head);
  kinds.push_back("");
  for (const std::string& kind : kinds) {
    std::vector<std::string> cells{kind.empty() ? "all" : kind, std::to_string(starting_with(random, "", kind))};
    for (const auto& [words, name] : outcomes_of_random())
      cells.push_back(std::to_string(starting_with(random, words, kind)));
    table.add(cells);
  }
  return table;
}

// What the certificate says of an answer, and the words for it.
const std::vector<std::pair<std::string, std::string>>& verdicts() {
  static const std::vector<std::pair<std::string, std::string>> words{
      {"doubted", "doubted"},
      {"certified: the only equilibrium", "certified, the only equilibrium"},
      {"certified: path back", "certified, path back"},
      {"signs alone", "signs alone"}};
  return words;
}

std::uint64_t judged_as(const Tally& audit, const std::string& right, const std::string& who = {}) {
  std::uint64_t sum = 0;
  for (const auto& [verdict, name] : verdicts()) sum += starting_with(audit, verdict + "; " + right, who);
  return sum;
}

Table audit_table(const Tally& audit) {
  std::vector<std::string> head{"answers of", "judged"};
  for (const std::string right : {"not right", "right"})
    for (const auto& [verdict, name] : verdicts()) head.push_back(right + ", " + name);
  Table table(head);
  for (const std::string who : {"FAM", "FAM on few arcs", "plain shooting"}) {
    std::vector<std::string> cells{who,
                                   std::to_string(judged_as(audit, "not right", who) + judged_as(audit, "right", who))};
    for (const std::string right : {"not right", "right"})
      for (const auto& [verdict, name] : verdicts())
        cells.push_back(std::to_string(starting_with(audit, verdict + "; " + right, who)));
    table.add(cells);
  }
  return table;
}

// Answers that are not right, one a row.
std::string failures_text(const Tally& random) {
  Table table({"what", "kind of scene", "numbers", "seed"});
  bool any = false;
  for (const Tally::Failure& failure : random.failures()) {
    const bool is_answer = failure.outcome.starts_with("wrong") || failure.outcome == "tolerance missed";
    if (!is_answer) continue;
    table.add({failure.outcome, failure.kind, failure.numbers, std::to_string(campaign_seed(1, failure.index))});
    any = true;
  }
  return any ? table.markdown() : "No answer of this run was wrong or missed its tolerance.\n";
}

std::string picture(const Tally& random) {
  const auto found = random.histograms().find("position");
  std::map<int, std::uint64_t> bins;
  if (found != random.histograms().end()) bins = found->second;
  double most = 1;
  for (const auto& [bin, n] : bins) most = std::max(most, static_cast<double>(n));
  constexpr double low = 1e-14, high = 1;
  Svg svg(700, 430, "How far from the exact rod?", "A histogram of errors over half decades.",
          "answers of fam solve to random scenes, asked for 1e-4 of the length");
  Panel panel(svg, {86, 66}, 560, 300, {"largest error of any place, over L", low, high, true},
              {"scenes in half a decade", 0.5, 3 * most, true});
  panel.frame();
  for (const auto& [bin, n] : bins) {
    const double from = std::max(std::pow(10, bin / 2.0), low), to = std::pow(10, (bin + 1) / 2.0);
    if (to <= low || from >= high) continue;
    const auto y = static_cast<double>(n);
    panel.curve({{from, 0.5}, {from, y}, {to, y}, {to, 0.5}}, {colour::blue, 1.8, ""});
  }
  panel.curve({{1e-4, 0.5}, {1e-4, 2 * most}}, {colour::orange, 1.4, "5 4"});
  panel.name({1e-4, 1.6 * most}, "asked for", colour::orange);
  panel.curve({{1e-2, 0.5}, {1e-2, 2 * most}}, {colour::black, 1.4, "5 4"});
  panel.name({1e-2, 1.6 * most}, "wrong", colour::black);
  panel.place_names();
  return svg.str();
}

}  // namespace

std::map<std::string, std::string> campaign_files(const CampaignData& data, const std::filesystem::path& page_md) {
  const Tally& random = data.random;
  const std::uint64_t scenes = random.scenes(), no_answer = starting_with(random, "no answer"),
                      no_judge = starting_with(random, "no judge"), by_signs = starting_with(random, "signs alone"),
                      judged = scenes - no_answer - no_judge - by_signs,
                      silent = starting_with(random, "wrong and silent"),
                      certified = starting_with(random, "certified"),
                      missed = starting_with(random, "tolerance missed"),
                      flagged = starting_with(random, "wrong but flagged");
  const std::uint64_t not_right = judged_as(data.audit, "not right"),
                      audited = not_right + judged_as(data.audit, "right"),
                      missed_by_signs = starting_with(data.audit, "signs alone; not right"),
                      escaped = not_right - starting_with(data.audit, "doubted; not right") - missed_by_signs;
  Page page;
  const auto set = [&](const char* name, std::uint64_t n) { page.set(name, std::to_string(n)); };
  set("scenes", scenes), set("judged", judged), set("silent", silent), set("missed", missed), set("flagged", flagged);
  set("no_answer", no_answer), set("no_judge", no_judge), set("not_right", not_right);
  set("audited", audited), set("missed_by_signs", missed_by_signs), set("escaped", escaped);
  const std::uint64_t signs_right = starting_with(data.audit, "signs alone; right", "FAM");
  set("by_signs", by_signs), set("signs_right", signs_right);
  set("signs_audited", signs_right + starting_with(data.audit, "signs alone; not right", "FAM"));
  set("lost", starting_with(random, "no answer but exact"));
  set("failures_judged", starting_with(random, "no answer but exact") + starting_with(random, "no answer nor exact"));
  page.set("silent_bound", bound_text(silent, judged));
  page.set("escaped_bound", bound_text(escaped, not_right));
  page.set("certified_share", share(certified, judged));
  page.set("no_answer_share", share(no_answer, scenes));
  page.set("outcomes", outcomes_table(random).markdown());
  page.set("audit", audit_table(data.audit).markdown());
  page.set("failures", failures_text(random));
  page.set_time("timing", data.timing);
  const std::string answer =
      fmt::format("of {} judged answers to {} random scenes {} are wrong without saying so (rate below {} at 95 %)",
                  judged, scenes, silent, bound_text(silent, judged));
  return {{"random.csv", random.text()},
          {"audit.csv", data.audit.text()},
          {"first.csv", data.first.text()},
          {"outcomes.csv", outcomes_table(random).csv()},
          {"audit_counts.csv", audit_table(data.audit).csv()},
          {"errors.svg", picture(random)},
          {"README.md", page.fill(page_md)},
          {answers_file, answers_json({{"million", answer}})}};
}

}  // namespace studies
