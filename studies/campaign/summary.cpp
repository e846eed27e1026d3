#include "studies/campaign/summary.h"

#include "scene/scene_file.h"
#include "studies/report/output_file.h"
#include "studies/report/table.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <cmath>

namespace studies {
namespace {

constexpr std::size_t scenes_kept = 100;  // of failures, as files

std::string counts_csv(const Tally& tally) {
  Table table({"kind of scene", "outcome", "scenes"});
  for (const auto& [key, n] : tally.counts()) table.add({key.first, key.second, std::to_string(n)});
  return table.csv();
}

std::string histograms_csv(const Tally& tally) {
  Table table({"measure", "from", "to", "scenes"});
  for (const auto& [measure, bins] : tally.histograms()) {
    for (const auto& [bin, n] : bins) {
      table.add({measure, scientific(std::pow(10, bin / 2.0), 1), scientific(std::pow(10, (bin + 1) / 2.0), 1),
                 std::to_string(n)});
    }
  }
  return table.csv({"# half decades; the first bin holds zero, too, the last infinity"});
}

std::string worst_csv(const Tally& tally, std::uint64_t campaign) {
  Table table({"measure", "value", "kind of scene", "index", "seed"});
  for (const auto& [measure, list] : tally.worst()) {
    for (const Tally::Worst& w : list)
      table.add({measure, scientific(w.value, 2), w.kind, std::to_string(w.index),
                 std::to_string(campaign_seed(campaign, w.index))});
  }
  return table.csv({"# a scene again: fam-studies random scene SEED"});
}

std::string failures_csv(const Tally& tally, std::uint64_t campaign) {
  Table table({"outcome", "kind of scene", "index", "seed", "numbers"});
  for (const Tally::Failure& f : tally.failures())
    table.add(
        {f.outcome, f.kind, std::to_string(f.index), std::to_string(campaign_seed(campaign, f.index)), f.numbers});
  return table.csv({"# a scene again: fam-studies random scene SEED"});
}

}  // namespace

void write_summary(const Tally& tally, std::uint64_t campaign, const std::filesystem::path& folder) {
  std::set<std::uint64_t> indices;
  for (const Tally::Failure& f : tally.failures()) {
    if (indices.size() < scenes_kept) indices.insert(f.index);
  }
  for (const auto& [measure, list] : tally.worst()) {
    if (!list.empty()) indices.insert(list.begin()->index);
  }
  std::map<std::string, std::string> files{{"counts.csv", counts_csv(tally)},
                                           {"histograms.csv", histograms_csv(tally)},
                                           {"worst.csv", worst_csv(tally, campaign)},
                                           {"failures.csv", failures_csv(tally, campaign)}};
  for (const std::uint64_t index : indices) {
    files[fmt::format("scenes/{:012}.json", index)] = scene::write_scene(random_scene(campaign_seed(campaign, index)));
  }
  std::filesystem::remove_all(folder / "scenes");
  write_files(folder, files);
}

double rate_bound(std::uint64_t found, std::uint64_t asked) {
  if (found >= asked) return 1;
  // By bisection: GSL's inverse of the beta distribution fails beyond some 300 000 scenes.
  double low = 0, high = 1;
  for (int i = 0; i < 200 && low < high * (1 - 1e-12); ++i) {
    const double middle = low > 0 ? std::sqrt(low * high) : high / 2;
    const double fewer = gsl_cdf_binomial_P(static_cast<unsigned>(found), middle, static_cast<unsigned>(asked));
    (fewer > 0.05 ? low : high) = middle;
  }
  return high;
}

}  // namespace studies
