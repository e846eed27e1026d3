// fam-studies walks: 10 000 random walks of the loads of random scenes by a kept solver, every step judged.
#include "studies/report/page.h"
#include "studies/report/provenance.h"
#include "studies/report/table.h"
#include "studies/study.h"
#include "studies/walks/walk.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace studies {
namespace {

constexpr std::uint64_t walks_of_study = 10'000, walks_of_quick_study = 1000;

const char* const outcomes[] = {"as cold",          "as exact", "told by the estimate",
                                "tolerance missed", "wrong",    "no judge",
                                "stopped, rightly", "stopped",  "stopped, no judge"};

Table counts_table(const std::vector<WalkStep>& steps) {
  std::map<std::string, int> counts;
  for (const WalkStep& step : steps) ++counts[step.outcome];
  Table table({"outcome", "steps"});
  for (const char* outcome : outcomes) table.add({outcome, std::to_string(counts[outcome])});
  return table;
}

Table list_of(const std::vector<WalkStep>& steps) {
  Table table({"seed", "step", "status", "outcome", "error_over_L"});
  for (const WalkStep& step : steps) {
    if (step.outcome == "as cold") continue;
    table.add({std::to_string(step.seed), std::to_string(step.step), step.status, step.outcome,
               step.error > 0 ? scientific(step.error, 0) : ""});
  }
  return table;
}

int count(const std::vector<WalkStep>& steps, const std::string& outcome) {
  int sum = 0;
  for (const WalkStep& step : steps) sum += step.outcome == outcome;
  return sum;
}

}  // namespace

void walks(const StudyOptions& options) {
  const std::uint64_t asked = options.quick ? walks_of_quick_study : walks_of_study;
  const std::vector<WalkStep> steps = all_walks(asked, options.progress);
  std::set<std::uint64_t> begun;
  for (const WalkStep& step : steps) begun.insert(step.seed);
  Page page;
  page.set("walks", std::to_string(begun.size()));
  page.set("asked", std::to_string(asked));
  page.set("steps", std::to_string(steps.size()));
  for (const auto& [name, outcome] : {std::pair{"as_cold", "as cold"},
                                      {"as_exact", "as exact"},
                                      {"told", "told by the estimate"},
                                      {"missed", "tolerance missed"},
                                      {"wrong", "wrong"},
                                      {"rightly", "stopped, rightly"},
                                      {"stopped", "stopped"}}) {
    page.set(name, std::to_string(count(steps, outcome)));
  }
  page.set("counts", counts_table(steps).markdown());
  const std::string answer = fmt::format(
      "of {} steps of random walks {} end as a cold solve does, {} as the exact reference by the same way, {} elsewhere "
      "by it",
      steps.size(), count(steps, "as cold"), count(steps, "as exact"), count(steps, "wrong"));
  write_results(options.output / "walks", "fam-studies walks",
                {{"README.md", page.fill(options.pages / "walks" / "page.md")},
                 {"counts.csv", counts_table(steps).csv()},
                 {"steps.csv", list_of(steps).csv()},
                 {answers_file, answers_json({{"branch", answer}})}});
}

}  // namespace studies
