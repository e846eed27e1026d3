#include "studies/campaign/command.h"

#include "studies/campaign/kinds.h"
#include "studies/scenes/random_scene.h"

#include <fmt/format.h>

#include <memory>

namespace studies {
namespace {

struct CampaignArguments {
  CampaignSize size;
  std::string folder;
  bool quiet = false;
};

int run(const CampaignKind& kind, const CampaignArguments& arguments, Progress::Style style) {
  const Tally whole =
      run_campaign(kind, arguments.size, arguments.folder, arguments.quiet ? Progress::Style::quiet : style);
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
    command->add_option("--scenes", a.size.scenes, "Number of scenes")
        ->required()
        ->check(CLI::Range(std::uint64_t{1}, most_campaign_scenes));
    command->add_option("--seed", a.size.seed, "Of the campaign: each has scenes of its own (default: 0)")
        ->check(CLI::Range(std::uint64_t{0}, most_campaigns - 1));
    command->add_option("--output", a.folder, "Folder to write to, and to go on in")->required();
    command
        ->add_option("--chunk", a.size.chunk,
                     "Scenes a file; as many are lost where a process is killed (default: 100)")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000}));
    command->add_flag("--quiet", a.quiet, "Do not say what is done");
    command->callback([arguments, &kind, &style, &chosen] {
      chosen = [arguments, &kind, &style] { return run(kind, *arguments, style); };
    });
  }
}

}  // namespace studies
