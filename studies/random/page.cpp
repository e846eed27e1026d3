#include "studies/random/page.h"

#include "studies/random/tables.h"
#include "studies/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace studies {
namespace {

// "0–4999, 100000–101999".
std::string ranges(const std::vector<RandomOutcome>& outcomes) {
  std::set<std::uint64_t> seeds;
  for (const RandomOutcome& o : outcomes) seeds.insert(o.seed);
  std::string text;
  for (auto seed = seeds.begin(); seed != seeds.end();) {
    const std::uint64_t first = *seed;
    std::uint64_t last = first;
    while (++seed != seeds.end() && *seed == last + 1) last = *seed;
    text += (text.empty() ? "" : ", ") + fmt::format("{}–{}", first, last);
  }
  return text;
}

struct Answered {
  int asked = 0, judged = 0, silent = 0, right = 0;
};

Answered answered(const std::vector<RandomOutcome>& outcomes, const std::string& method) {
  Answered sum;
  for (const RandomOutcome& o : outcomes) {
    if (method == "fam" && stopped_the_judge(o)) ++sum.asked;
    if (o.method != method) continue;
    ++sum.asked;
    sum.judged += o.outcome != "no judge" && o.outcome != "not converged either";
    sum.silent += o.outcome == "wrong and not flagged" || o.outcome == "wrong branch";
    sum.right += o.outcome.rfind("right", 0) == 0;
  }
  return sum;
}

std::string percent(int part, int all) {
  return fixed(100.0 * part / std::max(1, all), 2) + " %";
}

// None among n: the rate is below this with 95 % confidence (rule of three).
std::string bound(int silent, int judged) {
  return silent == 0 ? "below " + scientific(3.0 / std::max(1, judged), 0)
                     : scientific(static_cast<double>(silent) / judged, 0);
}

void set_outcomes(Page& page, const std::vector<RandomOutcome>& outcomes) {
  const Answered fam = answered(outcomes, "fam"), fem = answered(outcomes, "fem");
  page.set("scenes", std::to_string(fam.asked));
  page.set("seeds", ranges(outcomes));
  page.set("fam_judged", std::to_string(fam.judged));
  page.set("fam_silent", std::to_string(fam.silent));
  page.set("fam_right", percent(fam.right, fam.asked));
  page.set("fam_rate", for_reader(bound(fam.silent, fam.judged)));
  page.set("fem_silent", std::to_string(fem.silent));
  page.set("fem_asked", std::to_string(fem.asked));
  page.set("outcomes", outcomes_by_method(outcomes).markdown());
}

void set_promises(Page& page, const std::vector<Promise>& promises) {
  const PromiseCounts c = count(promises);
  const auto failed = static_cast<int>(
      std::count_if(promises.begin(), promises.end(), [](const Promise& p) { return p.status != "converged"; }));
  const auto alone = std::count_if(promises.begin(), promises.end(),
                                   [](const Promise& p) { return p.judged && p.status != "converged"; });
  page.set("promises", std::to_string(promises.size()));
  page.set("kept", std::to_string(c.kept));
  page.set("solved", std::to_string(c.solved));
  page.set("judged", std::to_string(c.scenes));
  page.set("kept_of_solved", percent(c.kept, c.solved));
  page.set("kept_of_judged", percent(c.kept, c.scenes));
  page.set("worst", fixed(c.worst, 2));
  page.set("wrenches", std::to_string(c.wrenches_kept));
  page.set("worst_wrench", fixed(c.worst_wrench, 2));
  page.set("other", std::to_string(c.other_branch));
  page.set("waste", fixed(c.median_waste, 2));
  page.set("waste_90", fixed(c.waste_90, 2));
  page.set("tolerances", by_tolerance(promises).markdown());
  page.set("kinds", by_kind(promises).markdown());
  page.set("failed", std::to_string(failed));
  page.set("failed_share", percent(failed, static_cast<int>(promises.size())));
  page.set("failed_alone", std::to_string(alone));
  page.set("unsolved", unsolved(promises).markdown());
}

void set_estimates(Page& page, const std::vector<Promise>& estimates) {
  page.set("estimates", std::to_string(estimates.size()));
  page.set("estimates_solved", std::to_string(count(estimates).solved));
  page.set("estimates_low", std::to_string(std::count_if(estimates.begin(), estimates.end(), is_low_estimate)));
}

Answers answers(const RandomData& data) {
  const Answered fam = answered(data.outcomes, "fam");
  const PromiseCounts c = count(data.promises);
  return {
      {"wrong_and_silent",
       fmt::format("{} of {} judged answers to random scenes are wrong without saying so (rate {} at 95 %)", fam.silent,
                   fam.judged, for_reader(bound(fam.silent, fam.judged)))},
      {"promise", fmt::format("the tolerance is kept along the whole rod on {} of {} random scenes ({}; {} of those "
                              "solved)",
                              c.kept, c.scenes, percent(c.kept, c.scenes), percent(c.kept, c.solved))}};
}

}  // namespace

std::map<std::string, std::string> random_files(const RandomData& data, const std::filesystem::path& page_md) {
  std::map<std::string, std::string> files = outcome_tables(data.outcomes);
  files.merge(promise_tables(data.promises));
  files.merge(estimate_tables(data.estimates));
  Page page;
  set_outcomes(page, data.outcomes);
  set_promises(page, data.promises);
  set_estimates(page, data.estimates);
  files["README.md"] = page.fill(page_md);
  files[answers_file] = answers_json(answers(data));
  return files;
}

}  // namespace studies
