#include "studies/campaign/command.h"

#include "studies/campaign/engine.h"
#include "studies/campaign/kinds.h"
#include "studies/campaign/summary.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <memory>

namespace studies {
namespace {

struct CampaignArguments {
  std::uint64_t scenes = 0, seed = 0, chunk = 100;
  std::string folder;
  bool quiet = false;
};

int run_campaign(const CampaignKind& kind, const CampaignArguments& arguments, Progress::Style style) {
  const auto& [scenes, seed, chunk, folder, quiet] = arguments;
  const CampaignPlan plan{kind.name, fmt::format("seed {}", seed), scenes, chunk, folder};
  const auto work = [&](std::uint64_t from, std::uint64_t to, const std::function<void()>& help) {
    Tally tally;
    for (std::uint64_t index = from; index < to; ++index) {
      tally.add(kind.outcome(arguments.seed, index));
      help();
    }
    return tally.text();
  };
  Crew crew;
  if (!run_chunks(crew, plan, work, quiet ? Progress::Style::quiet : style)) return 1;
  if (!crew.leads()) return 0;
  Tally whole;
  read_chunks(plan, [&](const std::string& text) { whole.add(Tally::from_text(text)); });
  write_summary(whole, seed, folder);
  std::map<std::string, std::uint64_t> outcomes;
  for (const auto& [key, n] : whole.counts()) outcomes[key.second] += n;
  for (const auto& [outcome, n] : outcomes) fmt::print("{:>12}  {}\n", n, outcome);
  return 0;
}

}  // namespace

void add_campaign_commands(CLI::App& campaign, const Progress::Style& style, std::function<int()>& chosen) {
  for (const CampaignKind& kind : campaign_kinds()) {
    CLI::App* command = campaign.add_subcommand(kind.name, kind.question);
    const auto arguments = std::make_shared<CampaignArguments>();
    CampaignArguments& a = *arguments;
    command->add_option("--scenes", a.scenes, "Number of scenes")
        ->required()
        ->check(CLI::Range(std::uint64_t{1}, most_campaign_scenes));
    command->add_option("--seed", a.seed, "Of the campaign: each has scenes of its own (default: 0)")
        ->check(CLI::Range(std::uint64_t{0}, most_campaigns - 1));
    command->add_option("--output", a.folder, "Folder to write to, and to go on in")->required();
    command->add_option("--chunk", a.chunk, "Scenes a file; as many are lost where a process is killed (default: 100)")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000}));
    command->add_flag("--quiet", a.quiet, "Do not say what is done");
    command->callback([arguments, &kind, &style, &chosen] {
      chosen = [arguments, &kind, &style] { return run_campaign(kind, *arguments, style); };
    });
  }
}

}  // namespace studies
